//! Who says what is true.

use serde::{Deserialize, Serialize};

/// What plays the pushes of tools. Crowds are always played by the planar engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    /// Our 3-D engine in four of five episodes, else the planar one.
    #[default]
    Both,
    /// Our planar engine, at a stated height of push.
    Planar,
    /// Our 3-D engine.
    Spatial,
    /// MuJoCo, which needs Python; see `PUSHPLAN_PYTHON`. Only it is asked about obstacles where it is
    /// chosen: at walls both of ours are farther from it than the prior.
    Mujoco,
}
