//! A lever-up, ready to be predicted step by step.

use pushplan::internals::effect::LeverPrior;
use pushplan::internals::geometry::{Pose3, Turn3, Vector3};
use pushplan::internals::task::LeverJob;

use super::bodies::LeverBodies;
use super::clock::LeverClock;
use super::describe::{Step, describe};
use super::graphs::PartGraphs;
use super::state::{Motion, PartState};

/// The bodies of a lever-up, its steps, and how the prior would have it move.
#[derive(Clone, Debug)]
pub struct LeverCourse {
    pub(super) bodies: LeverBodies,
    pub(super) clock: LeverClock,
    /// Where the prior has the body when a step begins, until it rests there; empty without a prior.
    prior: Vec<(Vector3, Turn3)>,
}

impl LeverCourse {
    /// That of a job, with a `prior` that is corrected or without; none if its body is not alone or not
    /// made of cuboids.
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

    /// When step `k` begins, seconds from the start of the turn.
    pub fn time(&self, k: usize) -> f64 {
        self.clock.time(k)
    }

    /// At the start.
    pub fn start(&self) -> PartState {
        PartState::at(self.bodies.start())
    }

    /// A pose of the body's frame in the world as it is seen here: centre of mass and turn.
    pub fn see(&self, pose: &Pose3) -> (Vector3, Turn3) {
        self.bodies.see(pose)
    }

    /// Appends the graph of step `k` from `state`; gives the blade's distance, metres, infinite where it
    /// is not near.
    pub fn describe(&self, state: &PartState, k: usize, graphs: &mut PartGraphs) -> f64 {
        let (from, to) = (self.clock.time(k), self.clock.time(k + 1));
        let last = k.checked_sub(1).map_or(to - from, |last| from - self.clock.time(last));
        let aside = self.prior_at(k).map_or([Vector3::zeros(); 2], |(centre, turn)| {
            [state.centre - centre, (state.turn * turn.inverse()).scaled_axis()]
        });
        let step = Step { from, to, last, base: self.base(k), aside };
        describe(&self.bodies, state, &step, graphs)
    }

    /// The state after step `k`, of which the network said this: see `PARTS`.
    pub fn moved(&self, state: &PartState, k: usize, (even, odd): (&[f32], &[f32])) -> PartState {
        state.moved(&self.base(k), even, odd)
    }

    /// What the network would have to say of step `k` so that it ends there: even numbers, then odd ones.
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
