//! One rollout to compute: what an effect model takes.

use std::sync::Arc;

use super::{Motion, Physics, Record, Scene, Situation, State, ToolMotion, Trajectory};

/// One rollout to compute.
#[derive(Clone, Debug)]
pub struct Job {
    /// Poses and velocities at the start.
    pub start: State,
    /// What the tool does.
    pub motion: Motion,
    /// Under which physical parameters.
    pub physics: Arc<Physics>,
}

impl Job {
    /// `motion`, beginning in `situation`.
    pub fn new(situation: &Situation, motion: impl Into<Motion>) -> Self {
        let Situation { start, physics, .. } = situation;
        Self { start: start.clone(), motion: motion.into(), physics: Arc::clone(physics) }
    }

    /// `motion` in the scene exactly as it is stated.
    pub fn stated(scene: &Scene, motion: impl Into<Motion>) -> Self {
        Self {
            start: scene.start(),
            motion: motion.into(),
            physics: Arc::new(Physics::stated(scene)),
        }
    }

    /// `motions` in turn, the first beginning in `situation`: see [`in_turn`].
    pub fn sequence(situation: &Situation, motions: &[ToolMotion]) -> Vec<Self> {
        motions.iter().map(|motion| Self::new(situation, motion.clone())).collect()
    }

    /// Whether it leaves the plane, or begins out of it: for models in space.
    pub fn in_space(&self) -> bool {
        self.motion.is_lever() || self.start.space.is_some()
    }
}

/// Rolls out sequences of jobs, none of them empty, with `run`, as one trajectory each: of every sequence a job begins as the one
/// before has left everything.
pub fn in_turn(
    sequences: &[Vec<Job>],
    record: Record,
    mut run: impl FnMut(&[Job]) -> Vec<Trajectory>,
) -> Vec<Trajectory> {
    let longest = sequences.iter().map(Vec::len).max().unwrap_or(0);
    let mut made: Vec<Option<Trajectory>> = vec![None; sequences.len()];
    for turn in 0..longest {
        let (indices, jobs): (Vec<usize>, Vec<Job>) = (0..sequences.len())
            .filter_map(|k| {
                let job = sequences[k].get(turn)?.clone();
                let start = made[k].as_ref().map(|before| before.outcome().clone());
                Some((k, Job { start: start.unwrap_or(job.start), ..job }))
            })
            .unzip();
        for (k, next) in indices.into_iter().zip(run(&jobs)) {
            made[k] = Some(match made[k].take() {
                None => next,
                Some(before) => {
                    let strokes = |job: &Job| job.motion.slide().strokes.len();
                    before.then(next, record, sequences[k][..turn].iter().map(strokes).sum())
                }
            });
        }
    }
    made.into_iter().flatten().collect()
}
