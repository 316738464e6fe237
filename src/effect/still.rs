//! A model in which no object moves.

use crate::{
    outcome::{Frame, Record, Trajectory},
    scene::{ModelKind, ModelSpec, Scene, State},
    task::Job,
};

use super::{EffectModel, Trust};

/// A baseline model in which objects never move.
#[derive(Clone, Copy, Debug, Default)]
pub struct Still;

static SPEC: ModelSpec = ModelSpec::of(ModelKind::Still);

impl EffectModel for Still {
    fn spec(&self) -> &ModelSpec {
        &SPEC
    }

    fn trust(&self, _: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return Trust::NotMine;
        }
        Trust::Mine { error: None, warnings: Vec::new() }
    }

    fn rollout(&self, _: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.iter().map(|job| standing(job, record)).collect()
    }
}

/// Returns the motion of the tool alone. Contacts are not recorded, because nothing reacts to them.
fn standing(job: &Job, record: Record) -> Trajectory {
    let motion = job.motion.slide();
    let tool = motion.strokes.first().map(|stroke| stroke.from).unwrap_or_default();
    let mut trajectory = Trajectory::standing(SPEC.clone(), tool, job.start.clone());
    let mut time = 0.0;
    for (index, stroke) in motion.strokes.iter().enumerate() {
        for step in (0..stroke.frames()).map(|k| stroke.frame(k)) {
            time += step.duration;
            let state = State::at_rest(job.start.poses.clone());
            trajectory.frames.push(Frame {
                time,
                stroke: index,
                tool: step.to,
                state,
                blade: None,
            });
        }
    }
    if record == Record::Outcome {
        trajectory.frames.drain(..trajectory.frames.len() - 1);
    }
    trajectory
}
