//! The interface of an engine's scene for the playback of motions.

use crate::geometry::Pose;
use crate::{
    scene::{Body, Physics, Scene, State},
    task::{FrameStep, ToolMotion},
};

use super::violations::Overlap;

/// A scene in one of the engines.
pub(super) trait World: Sized {
    /// Speed below which tool motions are accelerated to this speed, m/s, with finer steps. In an
    /// engine whose friction is only exact above a speed, friction is viscous below it. At such
    /// speeds inertia is negligible, and the result does not depend on the speed.
    const SLOWEST: f64 = 0.0;

    /// Multiplies the velocities of all objects by `factor`.
    fn hurry(&mut self, _factor: f64) {}

    /// Builds the scene in `state`, with the tool at rest at `tool`.
    fn build(
        scene: &Scene,
        state: &State,
        physics: &Physics,
        motion: &ToolMotion,
        tool: &Pose,
    ) -> Self;

    /// Sets the tool to `frame.from` and gives it the velocity that leads to `frame.to`; later
    /// steps last `step` seconds each.
    fn begin_frame(&mut self, frame: &FrameStep, step: f64);

    /// Advances by one time step.
    fn step(&mut self);

    /// Returns poses and velocities of the objects; headings count full turns from the start.
    fn state(&self) -> State;

    /// Calls `found` with every object in contact and the body that it touches.
    fn touches(&self, found: &mut dyn FnMut(usize, Body));

    /// Returns the objects that no longer stand upright.
    fn toppled(&self) -> Vec<usize>;

    /// Returns whether this object has fallen off the table, or `None` if falling is not simulated.
    fn has_fallen(&self, _object: usize) -> Option<bool> {
        None
    }

    /// Calls `found` with every overlap of an object with another body, with its depth before the
    /// last step.
    fn overlaps(&self, found: &mut dyn FnMut(Overlap));

    /// Returns the force of the objects that `of` selects on the tool in the last step, newtons.
    fn force_on_tool(&self, of: &dyn Fn(usize) -> bool) -> f64;
}
