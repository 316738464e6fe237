//! Budgets of the planner of lever-ups.

use serde::{Deserialize, Serialize};

use crate::solve::Effort;

/// Budgets, all counted and none in seconds, so that results do not depend on the machine. A
/// lever-up costs about 0.2 ms of one core in the prior, 1.8 ms in coarse and 7 ms in fine
/// simulation; among the parts of a drive 1, 2.5 and 9 ms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeverSettings {
    /// Candidates that are simulated coarsely.
    pub simulated: usize,
    /// How often each of them is simulated with small errors as well.
    pub doubts: usize,
    /// Plans verified together.
    pub verified_at_once: usize,
    /// Batches verified before giving up.
    pub verify_batches: usize,
    /// Disturbed replays of every plan that works as written.
    pub disturbed: usize,
    /// Lever-ups after which pushes are looked for, where a task allows them.
    pub followed: usize,
}

impl LeverSettings {
    /// What an effort means.
    pub fn for_effort(effort: Effort) -> Self {
        let usual = Self {
            simulated: 32,
            doubts: 4,
            verified_at_once: 8,
            verify_batches: 3,
            disturbed: 16,
            followed: 4,
        };
        match effort {
            Effort::Draft => Self {
                simulated: 12,
                doubts: 0,
                verified_at_once: 4,
                verify_batches: 1,
                disturbed: 4,
                followed: 2,
            },
            Effort::Standard => usual,
            Effort::Thorough => {
                Self { simulated: 128, doubts: 8, verify_batches: 4, followed: 8, ..usual }
            }
        }
    }
}
