//! Tables from other engines and programs.

use super::super::table::{ALL, Published, table};
use super::inputs::{LEVERS, PLANS};

/// Tables from other engines and programs.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("mujoco", "mujoco.md", (16, 300, "tasks"), PLANS,
        "crates/lab/benches/mujoco runs/mujoco 300 7", &[]),
    table("mujoco-levers", "mujoco.md", (12, 48, "lever-ups a family"), LEVERS,
        "crates/lab/benches/mujoco-levers runs/mujoco-levers", &[]),
    table("imported-files", "imported-files.md", (8, 50, "objects"), PLANS,
        "python3 crates/lab/benches/meshes.py assets --out runs/meshes", &[
            ("", ALL, &["reach their goals"]),
        ]),
    table("imported-meshes", "imported-files.md", (3, 50, "meshes"), PLANS,
        "python crates/lab/benches/own_meshes.py --program pushplan --out runs/own-meshes", &[]),
];
