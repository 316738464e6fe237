//! Tables of beliefs and closed loops.

use super::super::table::{ALL, Published, table};
use super::inputs::{BELIEFS, RUNS};

/// Rows with noise of 1 mm and 0.5 degrees.
const NOISY: &[&str] = &["| 1 mm, 0.5 deg |"];

/// Shares of joint types.
const TYPES: &[&str] =
    &["set", "seen", "pairs", "filter, %", "regulator, %", "regulator: joined, %"];

/// Accuracy of inferred masses.
const MASSES: &[&str] = &[
    "scenes",
    "seen",
    "objects",
    "correct, %",
    "unknown, %",
    "ratio error",
    "heavier, %",
    "within, %",
];

/// Results of closed loops.
const RUN_COLUMNS: &[&str] = &[
    "kind",
    "tasks",
    "reached, closed loop",
    "planned once",
    "planned once, all known",
    "error, median",
    "p95",
    "pushes, mean",
    "time, median",
];

/// Tables of beliefs and closed loops.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("joints", "joints.md", (20, 50, "trajectories a row"), BELIEFS,
        "pushplan-lab joints --types-only --count 50", &[
            ("Types at the end", &["set", "seen", "pairs", "none, %", "residuals, %", "filter, %",
            "regulator, %", "regulator: joined, %"], ALL),
            ("Probabilities", &["set", "seen", "nll", "calibration, %", "all ordered pairs, %",
            "anchor, median", "axis, median"], &["| regulator |"]),
        ]),
    table("joint-errors", "joint-errors.md", (8, 40, "trajectories a row"), BELIEFS,
        "pushplan-lab joints --seen fine --count 40", &[
            ("Remaining motion", &["set", "after", "true joints", "none", "filter", "regulator",
            "regulator: median", "filter: gap closed, %", "regulator: gap closed, %"], NOISY),
        ]),
    table("joints-misled", "joint-conditions.md", (8, 50, "trajectories a row"), BELIEFS,
        "pushplan-lab joints --types-only --count 50 --seen exact --seen fine --misled", &[
            ("Types at the end", TYPES, ALL),
        ]),
    table("joints-3d", "joint-conditions.md", (10, 50, "trajectories a row"), BELIEFS,
        "pushplan-lab joints --types-only --count 50 --seen exact --seen fine --engine 3d", &[
            ("Types at the end", TYPES, ALL),
        ]),
    table("joints-sizes", "joint-conditions.md", (6, 100, "trajectories a row"), BELIEFS,
        "pushplan-lab joints --types-only --on sparse --seen exact --objects 6 12 --count 100", &[
            ("Types at the end", TYPES, ALL),
        ]),
    table("joints-mujoco", "joint-conditions.md", (10, 100, "scenes"), BELIEFS,
        "python crates/lab/benches/mujoco-joints runs/mujoco-joints --count 100 --jobs 2", &[]),
    table("masses", "masses.md", (8, 100, "trajectories a row"), BELIEFS,
        "pushplan-lab masses --count 100", &[
            ("", MASSES, ALL),
        ]),
    table("masses-crowd", "masses.md", (14, 24, "trajectories a row"), BELIEFS,
        "pushplan-lab masses --touching --crowds 9 --count 24", &[
            ("", MASSES, NOISY),
        ]),
    table("masses-controlled", "mass-conditions.md", (10, 100, "trajectories a row"), BELIEFS,
        "pushplan-lab masses --touching --controlled rows wedges --count 100", &[
            ("", MASSES, NOISY),
        ]),
    table("masses-friction", "mass-conditions.md", (8, 100, "trajectories a row"), BELIEFS,
        "pushplan-lab masses --frictions --seen exact --seen fine --count 100", &[
            ("", MASSES, NOISY),
        ]),
    table("hidden-scenes", "hidden-scenes.md", (3, 200, "tasks"), RUNS,
        "pushplan-lab run --count 200", &[
            ("", RUN_COLUMNS, ALL),
        ]),
    table("hidden-clusters", "hidden-scenes.md", (5, 40, "tasks"), RUNS,
        "pushplan-lab run --kind cluster --count 40", &[
            ("", RUN_COLUMNS, ALL),
        ]),
    table("hidden-3d", "hidden-scenes.md", (3, 30, "tasks"), RUNS,
        "pushplan-lab run --count 30 --engine 3d", &[
            ("", RUN_COLUMNS, &["| all |"]),
        ]),
    table("probe-rules", "probes.md", (10, 12, "worlds a task"), RUNS,
        "crates/lab/benches/probe-rules runs/rules", &[]),
    table("probes", "probes.md", (15, 100, "scenes"), BELIEFS,
        "pushplan-lab probes --count 100", &[
            ("", &["rule", "probes", "correct, %", "nll", "test push, median", "mean"], &["| 1 |",
            "| 3 |"]),
        ]),
];
