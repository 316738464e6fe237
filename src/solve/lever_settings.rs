//! Budgets of lever-ups.

use serde::{Deserialize, Serialize};

/// Budgets of lever-ups, as counts and not in seconds, so that results do not depend on the
/// machine. A lever-up costs about 0.2 ms of one core in the analytic model, 1.8 ms in coarse and 7
/// ms in fine simulation. Among the parts of a drive, it costs 1, 2.5 and 9 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeverSettings {
    /// Number of candidates simulated coarsely.
    pub simulated: usize,
    /// Number of simulations of each candidate with small errors.
    pub doubts: usize,
    /// Number of plans verified together.
    pub verified_at_once: usize,
    /// Maximum number of batches verified.
    pub verify_batches: usize,
    /// Number of perturbed replays of every plan that works as written.
    pub replays: usize,
    /// Number of lever-ups followed by a search for pushes, and of places to push to before a
    /// lever-up, if the task allows both.
    pub followed: usize,
}

impl LeverSettings {
    /// Budgets of a quick draft.
    pub const DRAFT: Self = Self {
        simulated: 12,
        doubts: 0,
        verified_at_once: 4,
        verify_batches: 1,
        replays: 4,
        followed: 2,
    };
    /// Default budgets.
    pub const STANDARD: Self = Self {
        simulated: 32,
        doubts: 4,
        verified_at_once: 8,
        verify_batches: 3,
        replays: 16,
        followed: 4,
    };
    /// Budgets of a thorough search.
    pub const THOROUGH: Self =
        Self { simulated: 128, doubts: 8, verify_batches: 4, followed: 8, ..Self::STANDARD };
}

impl Default for LeverSettings {
    /// Returns [`LeverSettings::STANDARD`].
    fn default() -> Self {
        Self::STANDARD
    }
}
