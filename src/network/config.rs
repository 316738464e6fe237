//! The size of a network.

use serde::{Deserialize, Serialize};

/// Network size, which fixes the shapes of all parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Config {
    /// Hidden width: one half even, one half odd under mirroring.
    pub width: usize,
    /// Number of propagation steps, L. Two carry a push through a chain of three objects in both
    /// directions, because the relation encoder already sees each pair.
    pub steps: usize,
}

impl Config {
    /// Returns the width of each parity half.
    pub fn half(&self) -> usize {
        self.width / 2
    }
}

impl Default for Config {
    fn default() -> Self {
        Self { width: 128, steps: 2 }
    }
}
