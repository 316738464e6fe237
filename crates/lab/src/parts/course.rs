//! A lever-up, prepared for step-by-step prediction.

use pushplan::internals::effect::LeverPrior;
use pushplan::internals::geometry::{Pose3, Turn3, Vector3};
use pushplan::internals::task::LeverJob;

use super::bodies::LeverBodies;
use super::clock::LeverClock;
use super::describe::{Step, describe};
use super::graphs::PartGraphs;
use super::state::{Motion, PartState};

/// The bodies of a lever-up, its steps, and the analytic model's prediction.
#[derive(Clone, Debug)]
pub struct LeverCourse {
    pub(super) bodies: LeverBodies,
    pub(super) clock: LeverClock,
    /// Pose predicted by the analytic model when a step begins, until rest; empty without it.
    prior: Vec<(Vector3, Turn3)>,
}

impl LeverCourse {
    /// Returns the course of a job, with a `prior` to correct or without. Returns `None` if there
    /// are other plates, or a part of the plate is no cuboid.
    pub fn new(job: &LeverJob, prior: Option<&LeverPrior>) -> Option<Self> {
        let bodies = LeverBodies::new(job)?;
        let clock = LeverClock::new(&job.lever);
        let times = (1..).map(|k| clock.time(k)).take_while(|time| *time <= clock.end());
        let follow = |prior: &LeverPrior| {
            let poses = prior.follow(job, times);
            std::iter::once(bodies.start()).chain(poses.iter().map(|at| bodies.see(at))).collect()
        };
        let prior = prior.map_or_else(Vec::new, follow);
        Some(Self { bodies, clock, prior })
    }

    /// Returns the time at which step `k` begins, seconds from the start of the rotation.
    pub fn time(&self, k: usize) -> f64 {
        self.clock.time(k)
    }

    /// Returns the initial state.
    pub fn start(&self) -> PartState {
        PartState::at(self.bodies.start())
    }

    /// Returns a world pose of the body's frame as centre of mass and rotation in the lever frame.
    pub fn see(&self, pose: &Pose3) -> (Vector3, Turn3) {
        self.bodies.see(pose)
    }

    /// Appends the graph of step `k` from `state`. Returns the distance to the blade, metres, or
    /// infinity if the blade is not near.
    pub fn describe(&self, state: &PartState, k: usize, graphs: &mut PartGraphs) -> f64 {
        let (from, to) = (self.clock.time(k), self.clock.time(k + 1));
        let last = k.checked_sub(1).map_or(to - from, |last| from - self.clock.time(last));
        let aside = self.prior_at(k).map_or([Vector3::zeros(); 2], |(centre, turn)| {
            [state.centre - centre, (state.turn * turn.inverse()).scaled_axis()]
        });
        let step = Step { from, to, last, base: self.base(k), aside };
        describe(&self.bodies, state, &step, graphs)
    }

    /// Returns the state after step `k` with this network output: see `PARTS`.
    pub fn moved(&self, state: &PartState, k: usize, (even, odd): (&[f32], &[f32])) -> PartState {
        state.moved(&self.base(k), even, odd)
    }

    /// Returns the network output for which step `k` ends at the given pose: even numbers, then odd
    /// ones.
    pub fn wanted(&self, state: &PartState, k: usize, there: (Vector3, Turn3)) -> [f32; 6] {
        state.wanted(&self.base(k), there)
    }

    fn base(&self, k: usize) -> Motion {
        match (self.prior_at(k), self.prior_at(k + 1)) {
            (Some(from), Some(to)) => Motion::between(from, to),
            _ => Motion::none(),
        }
    }

    fn prior_at(&self, k: usize) -> Option<(Vector3, Turn3)> {
        self.prior.get(k).or(self.prior.last()).copied()
    }
}
