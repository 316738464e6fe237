//! Sources of the ground truth.

use serde::{Deserialize, Serialize};

/// Engine that simulates pushes with tools. Crowds are always simulated by the 2-D engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    /// Our 3-D engine in four of five episodes, otherwise our 2-D engine.
    #[default]
    Both,
    /// Our 2-D engine, at a stated height of contact.
    Planar,
    /// Our 3-D engine.
    Spatial,
    /// MuJoCo, which needs Python; see `PUSHPLAN_PYTHON`.
    ///
    /// Obstacles occur in MuJoCo episodes but not in sets of a single engine of ours, because at
    /// walls both engines differ more from MuJoCo than the analytic model does.
    Mujoco,
}
