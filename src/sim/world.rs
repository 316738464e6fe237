//! A scene in an engine: what the drive of a motion asks of it.

use crate::geometry::Pose;
use crate::{
    scene::{Body, Physics, Scene, State},
    task::{FrameStep, ToolMotion},
};

use super::strain::Overlap;

/// A scene in one of the engines.
pub(super) trait World: Sized {
    /// Slower motions of the tool are played at this speed, m/s, in finer steps: to an engine whose
    /// friction is only exact above a speed, the table is like honey below it. At such speeds
    /// inertia does not matter, and what happens does not depend on the speed.
    const SLOWEST: f64 = 0.0;

    /// Multiplies the velocities of all objects by `factor`.
    fn hurry(&mut self, _factor: f64) {}

    /// Builds the scene in `state`, the tool at `tool`, not moving.
    fn build(
        scene: &Scene,
        state: &State,
        physics: &Physics,
        motion: &ToolMotion,
        tool: &Pose,
    ) -> Self;

    /// Puts the tool at `frame.from` and gives it the velocity that brings it to `frame.to`;
    /// later steps last `step` seconds each.
    fn begin_frame(&mut self, frame: &FrameStep, step: f64);

    /// One time step.
    fn step(&mut self);

    /// Poses and velocities of the objects, headings counted on from the start.
    fn state(&self) -> State;

    /// Calls `found` with every object that touches something, and what it touches.
    fn touches(&self, found: &mut dyn FnMut(usize, Body));

    /// The objects that no longer stand upright.
    fn toppled(&self) -> Vec<usize>;

    /// Returns `true` if this object is off the table, where falling is simulated.
    fn has_fallen(&self, _object: usize) -> Option<bool> {
        None
    }

    /// Calls `found` with every object inside something else, as deep as it was before the last
    /// step.
    fn overlaps(&self, found: &mut dyn FnMut(Overlap));

    /// Force with which the objects that `of` holds of pressed against the tool during the last step,
    /// newtons.
    fn force_on_tool(&self, of: &dyn Fn(usize) -> bool) -> f64;
}
