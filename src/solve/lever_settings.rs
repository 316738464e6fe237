//! Budgets of lever-ups.

use serde::{Deserialize, Serialize};

/// Budgets, all counted and none in seconds, so that results do not depend on the machine. A
/// lever-up costs about 0.2 ms of one core in the prior, 1.8 ms in coarse and 7 ms in fine
/// simulation; among the parts of a drive 1, 2.5 and 9 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeverSettings {
    /// Candidates that are simulated coarsely.
    pub simulated: usize,
    /// Number of simulations of each with small errors.
    pub doubts: usize,
    /// Plans verified together.
    pub verified_at_once: usize,
    /// Batches verified before giving up.
    pub verify_batches: usize,
    /// Disturbed replays of every plan that works as written.
    pub disturbed: usize,
    /// Lever-ups after which pushes are looked for, and places to push to before one, where a task
    /// allows them.
    pub followed: usize,
}

impl LeverSettings {
    /// A look.
    pub const DRAFT: Self = Self {
        simulated: 12,
        doubts: 0,
        verified_at_once: 4,
        verify_batches: 1,
        disturbed: 4,
        followed: 2,
    };
    /// The usual.
    pub const STANDARD: Self = Self {
        simulated: 32,
        doubts: 4,
        verified_at_once: 8,
        verify_batches: 3,
        disturbed: 16,
        followed: 4,
    };
    /// A careful one.
    pub const THOROUGH: Self =
        Self { simulated: 128, doubts: 8, verify_batches: 4, followed: 8, ..Self::STANDARD };
}

impl Default for LeverSettings {
    /// [`LeverSettings::STANDARD`].
    fn default() -> Self {
        Self::STANDARD
    }
}
