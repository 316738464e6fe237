//! Schema of the verdict on a plan.

use super::shape::{Shape, flag, list, nullable, number, of_plan_file, plan, text, unsigned};
use super::solution::{bystanders, moves};

/// Returns the schema of a verdict.
pub(super) fn shape() -> Shape {
    let replay = Shape::new().key("timestep", "Time step, seconds.", unsigned()).key(
        "failure",
        "Reason why the replay does not work; null if it works.",
        reason(),
    );
    let second = Shape::new()
        .key("engine", "Name and version of the engine.", text())
        .key("passed", "Whether the plan keeps the rules of its task and works.", flag())
        .key("failure", "Reason why the replay does not work; null if it works.", reason())
        .key("error", "Position error of the first goal, metres.", nullable(number()))
        .key("heading_error", "Heading error of the first goal, radians.", nullable(number()))
        .key(
            "difference",
            "Distance between the ends of this replay and of the nominal 3-D replay, metres.",
            nullable(unsigned()),
        )
        .key("runs", "Replays with different time steps; the last one decides.", list(replay));
    Shape::new()
        .key("task", "Name of the task.", text())
        .key("plan", "Steps of the plan.", plan())
        .key("moves", "Objects that each step moves.", moves())
        .key("verdict", "Verdict with all replays.", of_plan_file("verdict")["anyOf"][0].clone())
        .key("reason", "Verdict in words.", text())
        .key("moved", "Other objects that the plan moves.", bystanders())
        .maybe("second_opinion", "Verdict of another engine, with `--engine mujoco`.", second)
        .maybe("files", "Paths of the written files.", list(text()))
}

fn reason() -> serde_json::Value {
    nullable(text())
}
