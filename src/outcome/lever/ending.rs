//! Warnings of lever-ups.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Event that lowers the trust in a lever-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverWarning {
    /// The plate slid off the blade during the rotation.
    Slipped,
    /// Forces grew as in a jam.
    Jammed,
    /// The plate still moved at the time limit.
    Moving,
}

impl fmt::Display for LeverWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Slipped => "the plate slipped off the blade",
            Self::Jammed => "an object is jammed",
            Self::Moving => "the plate did not come to rest",
        })
    }
}
