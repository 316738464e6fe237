//! Lever-ups predicted side by side, step by step.

use pushplan::internals::geometry::Pose3;
use pushplan::internals::network::{Buffers, Forward};
use pushplan::internals::outcome::{
    Ending, LEVER_FRAMES, LeverTrajectory, LeverWarning, has_slipped,
};

use super::course::LeverCourse;
use super::graphs::PartGraphs;
use super::state::PartState;

/// Gap below which a body lies on the blade, metres: predictions are not more accurate.
const HELD: f64 = 1e-3;

/// Displacement in a step below which a body away from the blade is at rest, metres.
const CALM: f64 = 3e-4;

/// Number of successive steps at rest, because a body on edge is slow for a moment.
const CALM_STEPS: usize = 2;

/// A rollout of a lever-up in progress.
#[derive(Clone, Debug)]
pub struct Walk<'a> {
    course: &'a LeverCourse,
    /// State of the body.
    pub state: PartState,
    /// Next step.
    pub step: usize,
    lift: Vec<Pose3>,
    held: Vec<bool>,
    calm: usize,
    over: bool,
}

impl<'a> Walk<'a> {
    /// Starts a rollout.
    pub fn new(course: &'a LeverCourse) -> Self {
        let (lift, held) = (Vec::new(), Vec::new());
        Self { course, state: course.start(), step: 0, lift, held, calm: 0, over: false }
    }

    /// Returns `true` if everything rests or the time is over.
    pub fn is_over(&self) -> bool {
        self.over
    }

    fn describe(&mut self, graphs: &mut PartGraphs) {
        let Self { course, state, step, .. } = self;
        let blade = course.describe(state, *step, graphs);
        let turning = course.clock.turning();
        if *step > 0 && *step <= turning && step.is_multiple_of(course.clock.a_frame) {
            self.held.push(blade <= HELD);
        }
        let calm = state.fastest(course.bodies.reach) < CALM;
        let rests = calm && blade.is_infinite() && *step > turning;
        self.calm = if rests { self.calm + 1 } else { 0 };
    }

    fn go_on(&mut self, predicted: (&[f32], &[f32])) {
        let Self { course, state, step, .. } = self;
        let next = course.moved(state, *step, predicted);
        if next.is_finite() {
            *state = next;
        }
        *step += 1;
        let frame = step.is_multiple_of(course.clock.a_frame);
        if frame && *step <= course.clock.turning() {
            self.lift.push(course.bodies.pose((state.centre, state.turn)));
        }
        self.over = self.calm >= CALM_STEPS || course.clock.is_over(*step);
    }

    /// Returns the predicted trajectory.
    pub(super) fn trajectory(self) -> LeverTrajectory {
        let Self { course, state, lift, held, .. } = self;
        let pose = |at| course.bodies.pose(at);
        let (start, rest) = (pose(course.bodies.start()), pose((state.centre, state.turn)));
        debug_assert!(lift.len() == LEVER_FRAMES && held.len() == LEVER_FRAMES);
        let slipped = has_slipped(&start, &lift, &held);
        let warnings = if slipped { vec![LeverWarning::Slipped] } else { Vec::new() };
        LeverTrajectory { lift, held, rest, ending: Ending::of(&rest), warnings }
    }
}

/// Predictor of the motion of bodies by a network, with reused buffers.
#[derive(Clone, Debug)]
pub struct Walker<'a> {
    forward: &'a Forward,
    buffers: Buffers,
    graphs: PartGraphs,
}

impl<'a> Walker<'a> {
    /// Creates a walker with a network of parts.
    pub fn new(forward: &'a Forward) -> Self {
        Self { forward, buffers: Buffers::default(), graphs: PartGraphs::default() }
    }

    /// Advances all unfinished rollouts by a step. Returns `false` if there was none.
    pub fn step(&mut self, walks: &mut [Walk<'_>]) -> bool {
        self.graphs.clear();
        walks.iter_mut().filter(|walk| !walk.over).for_each(|walk| walk.describe(&mut self.graphs));
        let (even, odd) = self.forward.read(self.graphs.rows(), &mut self.buffers);
        let firsts = self.graphs.firsts();
        for (walk, first) in walks.iter_mut().filter(|walk| !walk.over).zip(firsts) {
            let at = 3 * *first as usize;
            walk.go_on((&even[at..at + 3], &odd[at..at + 3]));
        }
        !firsts.is_empty()
    }
}
