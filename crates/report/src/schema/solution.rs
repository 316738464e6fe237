//! Schema of the solution of a task.

use serde_json::Value as Json;

use super::shape::{
    Shape, count, flag, list, map, nullable, number, of_plan_file, outcome, plan, row, share, text,
    unsigned, variant, warnings, words,
};

/// Words of the status of a solution.
const STATUS: [&str; 5] = ["solved", "fragile", "partial", "no_plan", "failed_verification"];

/// Returns the schema of a solution.
pub(super) fn shape() -> Shape {
    Shape::new()
        .key("task", "Name of the task.", text())
        .key("model", "Effect model of the plan to use; null without a plan.", nullable(text()))
        .key("status", "Status; only `solved` means a plan that meets all goals.", status())
        .key(
            "stopped",
            "Whether a time limit or Ctrl-C ended the search early, so that the plans are the \
             best found until then.",
            flag(),
        )
        .key(
            "best",
            "Index into `plans` of the plan to use, or of the nearest one unless `status` is \
             `solved`; null without a plan.",
            nullable(count()),
        )
        .key("partial", "Goals that are met, if not all of several are.", nullable(partial()))
        .key("cause", "Cause of a missing plan, in words, if one was found.", nullable(text()))
        .key("reason", "Verdict on the plan to use, in words.", nullable(text()))
        .key("moved", "Other objects that the plan to use moves.", nullable(bystanders()))
        .key("plans", "Plans, best first.", list(ranked()))
        .key("statistics", "Cost of the solution.", statistics())
        .key("warnings", "Warnings about the prediction of the plan to use.", warnings())
}

/// Returns the schema of a status.
pub(super) fn status() -> Json {
    words(&STATUS)
}

/// Returns the schema of the objects that each step moves.
pub(super) fn moves() -> Json {
    let moved = Shape::new()
        .key("object", "Name of the object.", text())
        .key("moved", "Displacement of its centre during the step, metres.", unsigned())
        .key("turned", "Rotation during the step, radians, at most half a turn.", unsigned());
    let step = Shape::new()
        .key("object", "Object that the step is for; null if none moves.", nullable(moved.clone()))
        .key("also", "Other moved objects, farthest first.", moved.list());
    step.list()
}

/// Returns the schema of objects that no goal is for.
pub(super) fn bystanders() -> Json {
    let moved = Shape::new()
        .key("object", "Name of the object.", text())
        .key("moved", "Displacement in the replay that moves it most, metres.", unsigned())
        .key("turned", "Rotation in this replay, radians.", unsigned())
        .key("fell", "Whether the object falls or topples.", flag());
    moved.list()
}

fn ranked() -> Shape {
    Shape::new()
        .key("plan", "Steps of the plan, with the names of their tools.", plan())
        .key("moves", "Objects that each step moves.", moves())
        .key("predicted", "End of the plan as predicted by the effect model.", outcome())
        .key("verdict", "Verdict of the replays; null without replays.", of_plan_file("verdict"))
        .key("refinement", "Effect of the refinement.", refinement())
}

fn refinement() -> Shape {
    let about = "Distance from the aim to the centre of the predicted ends";
    Shape::new()
        .key("before", &format!("{about} before refinement, metres."), unsigned())
        .key("after", &format!("{about} after refinement, metres."), unsigned())
        .maybe("aimed_at", "Position aimed at instead of the goal, metres.", row(number(), 2))
        .key(
            "rounds",
            "Score of this centre after each round: the error in units of the tolerance.",
            list(unsigned()),
        )
}

fn partial() -> Shape {
    let goal = Shape::new()
        .key("object", "Names of the objects that may be moved for the goal.", text())
        .key("met", "Whether the plan meets the goal.", flag());
    Shape::new().key("goals", "Goals in the order of the task.", goal.list()).key(
        "robustness",
        "Share of the perturbed replays that meet these goals; null without such replays.",
        nullable(share()),
    )
}

fn statistics() -> Shape {
    let search = Shape::new()
        .key("considered", "Number of pushes considered.", count())
        .key("infeasible", "Number of infeasible pushes by reason.", map(count()))
        .key("repeated", "Number of pushes that repeat another placement.", count())
        .key("beyond_budget", "Number of feasible pushes beyond the budget.", count())
        .key("rollouts", "Number of rollouts.", count())
        .key(
            "best",
            "Improvements of the best score: number of rollouts made, and score (error in units \
             of the tolerance).",
            list(row(unsigned(), 2)),
        );
    let refinement = Shape::new()
        .key("rollouts", "Number of rollouts of single candidates.", count())
        .key("solved", "Number of solved quadratic programmes.", count())
        .key("failures", "Unsolved quadratic programmes, with their status.", list(programme()));
    let timing = ["search", "refinement", "verification", "total"]
        .into_iter()
        .fold(Shape::new(), |shape, key| shape.key(key, "Wall-clock time, seconds.", unsigned()));
    Shape::new()
        .key("search", "Statistics of the search.", search)
        .key("refinement", "Statistics of the refinement.", refinement)
        .key("rollouts", "Number of rollouts of the effect model.", count())
        .key("verified", "Number of plans replayed.", count())
        .key("depth", "Number of pushes of the longest plans searched.", count())
        .maybe("escalated", "Whether the budgets of a first attempt did not suffice.", flag())
        .key("timing", "Wall-clock times.", timing)
        .maybe("levers", "Cost of lever-ups, if the task allows them.", levers())
}

/// Returns the schema of a status and a problem: a pair of a word and an object.
fn programme() -> Json {
    let anything = serde_json::json!({"anyOf": [variant(), {"type": "object"}]});
    row(anything, 2)
}

fn levers() -> Shape {
    let search = Shape::new()
        .key("considered", "Number of candidates on the grid.", count())
        .key("refused", "Number of infeasible candidates by reason.", map(count()))
        .key("rollouts", "Number of predicted candidates.", count())
        .key("promising", "Number of candidates predicted to reach the goal.", count());
    Shape::new()
        .key("search", "Statistics of the last search.", search)
        .key("simulated", "Number of candidates simulated coarsely.", count())
        .key("verified", "Number of verified plans.", count())
        .key("followed", "Number of lever-ups followed by a search for pushes.", count())
}
