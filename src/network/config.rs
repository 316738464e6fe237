//! The size of a network.

use serde::{Deserialize, Serialize};

/// What fixes the shapes of all parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Config {
    /// Hidden width: half of it even, half odd under mirroring.
    pub width: usize,
    /// Propagation steps L. Two carry a push through a chain of three objects in both
    /// directions, since the relation encoder already sees each pair.
    pub steps: usize,
}

impl Config {
    /// Width of each parity half.
    pub fn half(&self) -> usize {
        self.width / 2
    }
}

impl Default for Config {
    fn default() -> Self {
        Self { width: 128, steps: 2 }
    }
}
