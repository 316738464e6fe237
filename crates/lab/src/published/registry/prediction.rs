//! Tables of predicted pushes.

use super::super::table::{ALL, Published, table};
use super::inputs::{PLANS, PUSHES};

/// Errors of predictors.
const ERRORS: &[&str] = &["model", "mean", "median", "p95", "heading median", "mean against 3-D"];

/// Rows of models without trivial ones.
const FEW_MODELS: &[&str] = &["planar", "network", "3d", "prior", "still"];

/// Tables of predicted pushes.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("prediction", "prediction.md", (10, 2000, "pushes of each kind"), PUSHES,
        "pushplan-lab evaluate", &[
            ("one object, 20 cm at 0.1 m/s", ERRORS, ALL),
            ("one object, 20 cm at 0.03", ERRORS, FEW_MODELS),
            ("two or three touching", ERRORS, FEW_MODELS),
        ]),
    table("crowds", "crowds.md", (20, 100, "trajectories a set"), PUSHES,
        "pushplan-lab evaluate --on sparse dense --count 100 --summary --out \
         runs/crowds --markdown && cp runs/crowds/*.svg crates/lab/results/", &[
            ("", &["set", "motion", "of motion", "median", "prior", "joints none",
            "joints guessed", "friction 70 %", "friction 130 %", "own spread"], ALL),
        ]),
    table("real-pushes", "real-pushes.md", (1, 50, "recorded pushes"), PUSHES,
        "pushplan predict tests/it/assets/real-pushes", &[
            ("50 recordings", &["model", "mean", "median", "p95", "heading", "of motion",
            "95 % interval"], ALL),
            ("share of the mean true motion", &["set", "motion", "mean", "95 % interval", "median",
            "heading", "prior"], ALL),
        ]),
    table("bullet", "bullet.md", (15, 239, "pushes"), PLANS,
        "crates/lab/benches/mujoco runs/mujoco 300 7 && python3 \
         crates/lab/benches/bullet.py runs/mujoco --out runs/bullet && pushplan predict \
         runs/bullet --markdown", &[
            ("", &["model", "mean", "median", "p95", "of motion", "95 % interval"], ALL),
        ]),
];
