//! Schema of a run of the closed loop.

use super::shape::{
    Shape, count, flag, list, nullable, number, row, share, state, text, unsigned, variant, words,
};

/// Returns the schema of a run.
pub(super) fn shape() -> Shape {
    let ends = ["reached", "budget_exhausted", "no_improving_push", "rule_broken"];
    Shape::new()
        .key("task", "Name of the task.", text())
        .key("end", "Reason for the end; null if it was stopped.", nullable(words(&ends)))
        .key("broken", "Rule that an object broke, if any.", nullable(variant()))
        .key("pushes", "Number of pushes made.", count())
        .key("probes", "Number of exploratory steps.", count())
        .key("seen_error", "Error of the first goal as observed, metres.", nullable(number()))
        .key("real_error", "True error of the first goal, metres.", nullable(number()))
        .key("really_reached", "Whether the first goal is truly reached.", nullable(flag()))
        .key("steps", "Steps in order.", list(step()))
}

fn step() -> Shape {
    let whys = ["plan", "rest", "best", "approach", "probe"];
    let push = Shape::new()
        .key("start", "Position of the tool frame at the start, metres.", row(number(), 2))
        .key("direction", "Direction of the motion, radians.", number())
        .key("length", "Length, metres.", unsigned())
        .key("speed", "Speed, m/s.", unsigned());
    let chance = Shape::new()
        .key("share", "Share of the samples in which the plan reaches the goal.", share())
        .key("score", "Mean final error in units of the tolerance.", unsigned());
    Shape::new()
        .key("why", "Reason for the push.", words(&whys))
        .key("tool", "Name of the tool.", text())
        .key("pushes", "Pushes carried out.", nullable(push.list()))
        .key("grip_yaw", "Rotation of the end effector, radians.", number())
        .key("chance", "Expected outcome of the plan.", chance)
        .key("notes", "Corrections made to the observations.", list(variant()))
        .key("state", "Estimated state after the step.", state())
        .key(
            "probabilities",
            "Probabilities of no, a fixed, a revolute and a prismatic joint, for each pair.",
            list(row(share(), 4)),
        )
        .key("numbers", "Belief about masses, frictions and supports.", numbers())
}

/// Returns the schema of means and standard deviations.
fn numbers() -> Shape {
    let pair = || row(number(), 2);
    let each = |what: &str| format!("{what} of every object: mean and standard deviation.");
    let of_objects = |shape: Shape, key, what: &str| shape.key(key, &each(what), list(pair()));
    let shape = of_objects(Shape::new(), "masses", "Mass in kg");
    let shape = of_objects(shape, "frictions", "Friction value");
    let about = "Friction value of the table: mean and standard deviation.";
    let shape = shape.key("table_friction", about, pair());
    of_objects(shape, "spreads", "Support radius relative to its corners' distance")
}
