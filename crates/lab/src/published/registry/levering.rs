//! Tables of lever-ups.

use super::super::table::{ALL, Input, Published, table};
use super::inputs::LEVERS;

/// Errors by time step.
const STEPS: &[&str] = &["step", "lift, mean", "median", "rest, mean", "endings differ", "time"];

/// Rows of two time steps.
const TWO_STEPS: &[&str] = &["1/60", "1/240"];

/// Errors of lever models.
const LEVER_COLUMNS: &[&str] =
    &["model", "lift, mean", "median", "rest, mean", "slip correct", "ending correct", "time"];

/// Rows of some numbers of frames.
const SOME_FRAMES: &[&str] = &["| 1 |", "| 2 |", "| 3 |", "| 5 |", "| 8 |"];

/// Tables of lever-ups.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("lever-truth", "lever-truth.md", (2, 256, "lever-ups a family"), &[Input::LeverUps],
        "pushplan-lab convergence", &[
            ("levers: ", STEPS, TWO_STEPS),
            ("levers-varied: ", STEPS, TWO_STEPS),
            ("hdd: ", STEPS, TWO_STEPS),
        ]),
    table("lever-models", "lever-models.md", (2, 2000, "lever-ups a family"), LEVERS,
        "pushplan-lab levers", &[
            ("levers: ", LEVER_COLUMNS, &["no motion", "1-NN", "prior", "3d"]),
            ("levers-varied: ", LEVER_COLUMNS, &["support points", "prior", "3d"]),
        ]),
    table("boards", "boards.md", (1, 993, "lever-ups"), LEVERS,
        "pushplan-lab hdd", &[
            ("lever-ups on", &["model", "lift, mean", "p95", "rotation, mean", "rest, mean",
            "in/out correct", "time"], ALL),
        ]),
    table("lever-points", "lever-points.md", (10, 100, "lever-ups a family"), &[Input::LeverUps],
        "pushplan-lab lever-points", &[
            ("disc: ", &["frames seen", "angle, mean", "p95", "rest, mean", "point known"],
            SOME_FRAMES),
            ("pcb: ", &["frames seen", "angle, mean", "p95", "rest, mean", "point known"],
            SOME_FRAMES),
        ]),
    table("levering", "levering.md", (3, 50, "tasks"), LEVERS,
        "pushplan-lab lever-tasks --count 50", &[]),
];
