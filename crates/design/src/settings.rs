//! Budgets of designing a tool.

use serde::{Deserialize, Serialize};

/// Budgets of tool design, all as counts, none in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DesignSettings {
    /// Maximum number of parts of a tool.
    pub parts: usize,
    /// Number of screened tools.
    pub candidates: usize,
    /// Maximum number of screened tools whose handles are routed through free space.
    pub traced: usize,
    /// Number of screened tools that are sampled before the best are varied.
    pub drawn: usize,
    /// Number of best tools with which the task is solved in full, with verification.
    pub solved: usize,
}

impl DesignSettings {
    /// Default number of parts: enough for a J, or for a hook of two thirds of a metre.
    pub const PARTS: usize = 3;

    /// Default number of candidates: three to eleven seconds on two busy cores.
    pub const CANDIDATES: usize = 1000;

    /// Numbers of routed and of sampled tools per thousand candidates.
    const TRACED: usize = 150;
    const DRAWN: usize = 300;

    /// Maximum number of parts of a form.
    pub const MOST_PARTS: usize = 7;

    /// Returns settings that screen this many tools.
    pub fn looking_at(candidates: usize) -> Self {
        let [traced, drawn] = [Self::TRACED, Self::DRAWN].map(|share| candidates * share / 1000);
        Self { parts: Self::PARTS, candidates, traced, drawn, solved: 8 }
    }

    /// Returns settings that only sample as many tools at random: the baseline of a search.
    pub fn at_random(self) -> Self {
        Self { traced: 0, drawn: self.candidates, ..self }
    }
}

impl Default for DesignSettings {
    fn default() -> Self {
        Self::looking_at(Self::CANDIDATES)
    }
}
