//! What happens where a model should not be trusted.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::scene::{Frame, Job, Record, Scene, State, ToolMotion, Trajectory, Warning};
use crate::sim::Simulator;

use super::{EffectModel, Simulated, model::fill};

/// What to do outside of what a model was trained on, and where its own rollout shows that it
/// went wrong (see [`Warning::questions_model`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outside {
    /// Simulate in the plane instead: as dear as the planar engine, where it is needed.
    Simulate,
    /// Predict, and say so.
    #[default]
    Warn,
    /// Give no prediction.
    Refuse,
}

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Outside::Simulate => "simulate",
            Outside::Warn => "warn",
            Outside::Refuse => "refuse",
        })
    }
}

/// A model that is used only where it can be trusted.
pub struct Guarded<M> {
    model: M,
    outside: Outside,
    planar: Simulated,
}

impl<M: EffectModel> Guarded<M> {
    /// `model`, and what happens where it should not be trusted.
    pub fn new(model: M, outside: Outside) -> Self {
        Self { model, outside, planar: Simulated::new(Simulator::planar()) }
    }
}

/// How far the planar engine ends from what is predicted for `job`, as a warning, for the object
/// on which the two differ most: what a model's being outside its range means for this motion.
pub fn consequence(scene: &Scene, job: &Job, predicted: &State) -> Option<Warning> {
    let run = Simulator::planar().run(scene, job, Record::Outcome);
    let apart = |k: usize| (run.outcome().poses[k].position - predicted.poses[k].position).norm();
    let far = (0..scene.objects.len()).max_by(|&a, &b| apart(a).total_cmp(&apart(b)))?;
    Some(Warning::Differs { object: scene.objects[far].name.clone(), distance: apart(far) })
}

impl<M: EffectModel> EffectModel for Guarded<M> {
    fn name(&self) -> &str {
        self.model.name()
    }

    fn name_for(&self, scene: &Scene, motion: &ToolMotion) -> &str {
        self.model.name_for(scene, motion)
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        let found = self.model.warnings(scene, motion);
        match self.outside {
            Outside::Simulate => found.into_iter().map(simulated).collect(),
            Outside::Warn | Outside::Refuse => found,
        }
    }

    fn error_p95(&self) -> f64 {
        self.model.error_p95()
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        if self.outside == Outside::Warn {
            return self.model.rollout(scene, jobs, record);
        }
        let work = (scene, jobs, record);
        let before: Vec<Vec<Warning>> =
            jobs.iter().map(|job| self.model.warnings(scene, &job.motion)).collect();
        let inside: Vec<bool> = before.iter().map(Vec::is_empty).collect();
        let mut places = vec![Trajectory::default(); jobs.len()];
        fill(&self.model, work, &inside, &mut places);
        // What the model itself got wrong on the way counts as well.
        let doubts: Vec<Option<Warning>> = places
            .iter()
            .map(|place| place.warnings.iter().find(|w| w.questions_model()).cloned())
            .collect();
        let out: Vec<bool> =
            inside.iter().zip(&doubts).map(|(inside, doubt)| !inside || doubt.is_some()).collect();
        match self.outside {
            Outside::Simulate => {
                fill(&self.planar, work, &out, &mut places);
                for (place, doubt) in places.iter_mut().zip(doubts) {
                    place.warnings.extend(doubt.map(simulated));
                }
            }
            Outside::Warn | Outside::Refuse => {
                for (k, place) in places.iter_mut().enumerate().filter(|(k, _)| out[*k]) {
                    let mut warnings = std::mem::take(&mut place.warnings);
                    warnings.extend(before[k].iter().cloned());
                    warnings.push(Warning::Refused);
                    *place = Trajectory { warnings, ..unmoved(&jobs[k]) };
                }
            }
        }
        places
    }
}

fn simulated(reason: Warning) -> Warning {
    Warning::Simulated { reason: Box::new(reason) }
}

/// The start alone.
fn unmoved(job: &Job) -> Trajectory {
    let tool = job.motion.strokes.first().map(|stroke| stroke.from).unwrap_or_default();
    let frame = Frame { time: 0.0, stroke: 0, tool, state: job.start.clone() };
    Trajectory { frames: vec![frame], ..Trajectory::default() }
}
