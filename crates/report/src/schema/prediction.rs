//! Schemas of predictions and of exported poses.

use super::shape::{Shape, list, number, plan, state, text, unsigned, warnings};
use super::solution::moves;

/// Returns the schema of the prediction of a motion.
pub(super) fn shape() -> Shape {
    let effect = Shape::new()
        .key("model", "Effect model.", text())
        .key("state", "Final poses of all objects.", state())
        .key("goal_error", "Distance of the first goal's object from its goal, metres.", number())
        .key("warnings", "Warnings about the prediction.", warnings())
        .key("seconds", "Wall-clock time of the rollout, seconds.", unsigned());
    Shape::new()
        .key("task", "Name of the task.", text())
        .key("plan", "Steps of the plan.", plan())
        .key("moves", "Objects that each step moves, by the first model.", moves())
        .key("objects", "Names of the objects, in the order of poses.", list(text()))
        .key("effects", "Predictions, one for each model.", effect.list())
}

/// Returns the schema of exported poses.
pub(super) fn poses() -> Shape {
    let pose = Shape::new()
        .key("name", "Name of the recording or task.", text())
        .key("by", "Effect model, or `recorded`.", text())
        .key("object", "Name of the object.", text())
        .key("time", "Time since the start, seconds.", unsigned())
        .key("x", "Position of the centre, metres.", number())
        .key("y", "Position of the centre, metres.", number())
        .key("heading", "Rotation about the vertical, radians.", number());
    Shape::new().key("poses", "Poses of all objects at all instants.", pose.list())
}
