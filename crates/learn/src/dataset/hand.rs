//! Round hand that pushes crowds, and the simulation of its strokes one by one.

use std::sync::Arc;

use pushplan::internals::geometry::{Pose, Shape, Vector};
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Frame, Record},
    scene::{Body, Part, Ranges, Scene, State, Tool},
    task::{COAST_FRAME, Job, Stroke, ToolMotion},
};
use rand_pcg::Pcg64;

use super::aim::{SET_DOWN, tool_clearance};
use super::distributions::uniform;

/// Radius of the hand, metres.
pub const HAND_RADIUS: f64 = 0.05;

/// Height of the hand, metres.
const HAND_HEIGHT: f64 = 0.10;

/// Height of the hand's underside above the table, metres.
const LIFT: f64 = 0.002;

/// Scene pushed stroke after stroke by a hand of random friction.
pub(super) struct HandPlay<'a> {
    scene: &'a Scene,
    motion: ToolMotion,
    frames: Vec<Frame>,
    touched: Vec<bool>,
}

impl<'a> HandPlay<'a> {
    /// Creates the play before the first stroke.
    pub(super) fn new(rng: &mut Pcg64, scene: &'a Scene, ranges: &Ranges) -> Self {
        let shape = Shape::Cylinder { radius: HAND_RADIUS, height: HAND_HEIGHT };
        let hand =
            Tool::assembled("hand", vec![Part::new("hand", shape, Pose::default())], Vec::new())
                .described("A round hand.")
                .friction(uniform(rng, ranges.friction.low, ranges.friction.high));
        Self {
            scene,
            motion: ToolMotion { tool: Arc::new(hand), lift: LIFT, strokes: Vec::new() },
            frames: Vec::new(),
            touched: vec![false; scene.objects.len()],
        }
    }

    /// Returns the current state.
    pub(super) fn state(&self) -> State {
        self.frames.last().map_or_else(|| self.scene.start(), |frame| frame.state.clone())
    }

    /// Returns whether the hand has touched each object.
    pub(super) fn touched(&self) -> &[bool] {
        &self.touched
    }

    /// Returns the straight stroke from `from` until all objects rest; `None` if the hand cannot be
    /// set down there.
    pub(super) fn stroke(
        &self,
        state: &State,
        from: Vector,
        travel: Vector,
        speed: f64,
    ) -> Option<Stroke> {
        let at = |position| Pose { position, heading: 0.0 };
        let free = self.scene.objects.iter().zip(&state.poses).all(|(object, pose)| {
            let other = (&object.shape.footprint(), pose);
            tool_clearance(&self.motion.tool, &at(from), other) >= SET_DOWN
        });
        free.then(|| Stroke {
            from: at(from),
            to: at(from + travel),
            duration: travel.norm() / speed,
            settle: true,
        })
    }

    /// Simulates one more stroke; `None` if the simulation has a warning, which ends the play.
    ///
    /// The simulator starts a fresh world after a settled stroke, so strokes simulated one by one
    /// and together yield identical bits.
    pub(super) fn play(mut self, stroke: Stroke) -> Option<Self> {
        let one = ToolMotion { strokes: vec![stroke], ..self.motion.clone() };
        let job = Job { start: self.state(), ..Job::stated(self.scene, one) };
        let trajectory = Simulator::planar().run(self.scene, &job, Record::Frames);
        if !trajectory.warnings.is_empty() {
            return None;
        }
        for contact in &trajectory.contacts {
            if let Body::Part(_) = contact.with {
                self.touched[contact.object] = true;
            }
        }
        let number = self.motion.strokes.len();
        let mut time = self.frames.last().map_or(0.0, |frame| frame.time);
        let known = usize::from(number > 0);
        for (k, frame) in trajectory.frames.into_iter().enumerate().skip(known) {
            if k > 0 {
                // Times are summed in the simulator's order for identical rounding.
                let moving = k <= stroke.frames();
                time += if moving { stroke.frame(k - 1).duration } else { COAST_FRAME };
            }
            self.frames.push(Frame { time, stroke: number, ..frame });
        }
        self.motion.strokes.push(stroke);
        Some(self)
    }

    /// Returns the motion and its frames.
    pub(super) fn finish(self) -> (ToolMotion, Vec<Frame>) {
        (self.motion, self.frames)
    }
}
