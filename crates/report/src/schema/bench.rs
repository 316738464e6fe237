//! Schemas of benchmarks.

use super::shape::{
    Shape, count, flag, list, map, nullable, number, plan, row, share, span, text, unsigned,
    warnings, words,
};
use super::solution;

/// Methods of choosing an action.
const METHODS: [&str; 6] = ["nothing", "random", "oracle", "planar", "first", "planned"];

/// Returns the schema of solved task files.
pub(super) fn tasks() -> Shape {
    let end = Shape::new()
        .key("error", "Distance from the goal, metres.", unsigned())
        .key("heading_error", "Heading error, radians.", nullable(unsigned()))
        .key("reached", "Whether the goal is reached at rest.", flag());
    let task = Shape::new()
        .key("task", "Name of the task.", text())
        .key("status", "Status of the solution.", solution::status())
        .key("tolerance", "Largest distance that counts as success, metres.", nullable(unsigned()))
        .key("plan", "Chosen plan, or the nearest one.", nullable(plan()))
        .key("predicted", "Predicted end.", nullable(end.clone()))
        .key("planar", "End in the 2-D engine.", nullable(end.clone()))
        .key("spatial", "End in the 3-D engine.", nullable(end))
        .key("robustness", "Share of perturbed replays that succeed.", nullable(share()))
        .key("attempts", "Number of plans replayed.", count())
        .key("rollouts", "Number of rollouts of the effect model.", count())
        .key("warnings", "Warnings about the prediction.", warnings());
    Shape::new().key("run", "Settings that determine the results.", run()).key(
        "tasks",
        "Results, one for each task.",
        timed(task).list(),
    )
}

/// Returns the schema of the comparison of tool choices.
pub(super) fn tools() -> Shape {
    let executed = Shape::new().key("error", "Distance from the goal, metres.", unsigned()).key(
        "sound",
        "Whether the object is at rest at its end.",
        flag(),
    );
    let trial = Shape::new()
        .key("method", "Method of the choice.", words(&METHODS))
        .maybe("pose", "Index of the prescribed tool pose.", nullable(count()))
        .maybe("taken", "Index of the chosen tool pose.", nullable(count()))
        .maybe("predicted", "Predicted distance from the goal, metres.", nullable(unsigned()))
        .key("planar", "Result in the 2-D engine.", executed.clone())
        .key("spatial", "Result in the 3-D engine.", executed)
        .key("pushes", "Number of pushes.", count())
        .key("travel", "Travel of the tool, metres.", unsigned())
        .maybe("attempts", "Number of plans replayed.", nullable(count()));
    let task = Shape::new()
        .key("start", "Index of the start.", count())
        .key("goal", "Position of the goal, metres.", row(number(), 2))
        .key("trials", "Trials of every method.", trial.list());
    Shape::new()
        .key("run", "Settings that determine the results.", run())
        .key("summary", "Results of each method over all tasks.", list(method()))
        .key("tasks", "Results, one for each task.", timed(task).list())
}

/// Returns the schema of the single-push benchmark.
pub(super) fn single() -> Shape {
    let counted = [
        ("tasks", "Number of tasks."),
        ("near", "Number of tasks with the goal within reach of a push."),
        ("nothing", "Number of tasks solved without a push."),
        ("solvable", "Number of tasks that some push solves in 2-D."),
        ("predicted", "Number of tasks that the model predicts to solve."),
        ("planar", "Number of tasks that its choice solves in 2-D."),
        ("spatial", "Number of tasks that its choice solves in 3-D."),
        ("missed", "Number of solvable tasks that its choice does not solve in 2-D."),
    ];
    let single = Shape::new().key("model", "Effect model.", text()).key(
        "seed",
        "Seed of the tasks.",
        count(),
    );
    let single =
        counted.into_iter().fold(single, |shape, (key, meaning)| shape.key(key, meaning, count()));
    Shape::new().key("single", "Numbers of tasks.", single)
}

fn method() -> Shape {
    let summary = || {
        let shape = Shape::new().key("count", "Number of values.", count()).key(
            "mean_interval",
            "95 % bootstrap interval of the mean.",
            span(),
        );
        let numbers = ["mean", "median", "p90", "p95", "max"];
        numbers.into_iter().fold(shape, |shape, key| shape.key(key, "Metres.", unsigned()))
    };
    let engine = || {
        Shape::new()
            .key("errors", "Distances from the goal, metres.", nullable(summary()))
            .key("fine", "Number of tasks that end within 5 cm.", count())
            .key("coarse", "Number of tasks that end within 10 cm.", count())
    };
    Shape::new()
        .key("method", "Method of the choice.", words(&METHODS))
        .key("pose", "Prescribed tool pose; null for a free choice.", nullable(text()))
        .key("tasks", "Number of tasks.", count())
        .key("predicted", "Predicted distances from the goal, metres.", nullable(summary()))
        .key("planar", "Results in the 2-D engine.", engine())
        .key("spatial", "Results in the 3-D engine.", engine())
        .key("pushes", "Mean number of pushes.", unsigned())
        .key("travel", "Mean travel of the tool, metres.", unsigned())
        .key("attempts", "Mean number of plans replayed.", nullable(unsigned()))
}

/// Adds the index of a task and its times.
fn timed(task: Shape) -> Shape {
    task.key("index", "Index of the task in the suite.", count()).key(
        "seconds",
        "Times by stage, seconds.",
        map(unsigned()),
    )
}

fn run() -> Shape {
    let shard = Shape::new().key("number", "Number of the shard, from 1.", count()).key(
        "of",
        "Number of shards.",
        count(),
    );
    Shape::new()
        .key("format_version", "Version of the folder's layout.", count())
        .key("program", "Name and version of the program.", text())
        .key("suite", "Name of the benchmark.", text())
        .key("tasks", "Number of tasks of all shards.", count())
        .key("seed", "Seed of the tasks.", count())
        .key("model", "Effect model.", text())
        .maybe("weights", "Digest of the weights of a network.", nullable(text()))
        .key("settings", "Other settings of the results.", serde_json::json!({"type": "object"}))
        .maybe("shard", "Shard; absent for a whole run.", nullable(shard))
}
