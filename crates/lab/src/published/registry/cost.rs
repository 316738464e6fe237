//! Tables of costs, and of limits.

use super::super::table::{ALL, Input, Published, table};
use super::inputs::{PLANS, PUSHES};

/// Tables of costs, and of limits.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("cost", "cost.md", (3, 8, "pushes"), PUSHES,
        "pushplan-lab cost tasks/diagonal.yaml --offsets 9 --pushes 8", &[
            ("The network alone", &["candidate-steps", "graph a step", "fused network",
            "fused of GEMM peak", "with its graph"], ALL),
            ("One push", ALL, ALL),
            ("A search", ALL, ALL),
        ]),
    table("cost-crowds", "cost-crowds.md", (4, 11, "settings"), &[Input::Predictions],
        "pushplan-lab cost --equations", &[
            ("", &["objects", "joints", "prior", "of planar at 1/120 s", "systems", "updates each",
            "iterated", "of peak"], ALL),
        ]),
    table("cost-far", "cost-crowds.md", (3, 8, "pushes"), PUSHES,
        "pushplan-lab cost --far --pushes 8 --out crates/lab/results", &[
            ("", &["objects out of reach", "network, 64 at a time", "planar, 1 at a time",
            "difference of final poses#1"], ALL),
        ]),
    table("tradeoff", "tradeoff.md", (80, 120, "tasks a level"), PLANS,
        "pushplan-lab tradeoff --pushes 500 --rounds 3 --tasks 120 --tolerance 0.25 \
         --markdown --out runs/tradeoff && cp runs/tradeoff/tradeoff*.svg \
         runs/tradeoff/tradeoff.json crates/lab/results/", &[
            ("Predictors", &["predictor", "mean", "median", "touching, mean", "mean against 3-D",
            "a push", "alone"], &["| network |", "network,frame", "| prior", "| planar", "| 3d"]),
            ("Efforts", ALL, ALL),
        ]),
    table("solve-cost", "solve-cost.md", (4, 5, "tasks"), PLANS,
        "pip install -q . mujoco && python3 crates/lab/benches/sampler.py", &[]),
    table("first-plan", "solve-cost.md", (3, 51, "tasks"), PLANS,
        "python3 crates/lab/benches/so_far.py", &[
            ("", ALL, &["tasks: median"]),
        ]),
    table("python-solve", "python-cost.md", (2, 6, "tasks"), PLANS,
        "pip install -q . && python3 crates/lab/benches/python.py solve", &[
            ("", &["task", "command", "in a running Python", "with the start of Python"], ALL),
        ]),
    table("python-rollouts", "python-cost.md", (10, 1000, "pushes a task"), PUSHES,
        "pip install -q . mujoco && python3 crates/lab/benches/python.py rollout --rounds 1", &[
            ("", &["task", "model", "per push", "factor to usual MuJoCo",
            "distance to exact MuJoCo, median"],
            ALL),
        ]),
    table("extremes", "extremes.md", (20, 22, "pushes a cell"), PUSHES,
        "rm -f target/extremes.md; cargo test --release -p pushplan-lab -- --ignored \
         the_extremes_hide_no_defect; cat target/extremes.md", &[
            ("Ordinary pushes", ALL, ALL),
            ("Cells by extreme", ALL, ALL),
        ]),
    table("extremes-wrong", "extremes-wrong.md", (1, 22, "pushes a cell"), PUSHES,
        "cat target/extremes.md", &[
            ("All cells", &["extreme", "value", "on", "motion", "error, mean", "wrong", "flagged",
            "verdict"], &["wrong, flagged", "DEFECT"]),
        ]),
];
