//! Budgets of designing a tool.

use serde::{Deserialize, Serialize};

/// Budgets, all counted and none in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DesignSettings {
    /// The most parts of a tool.
    pub parts: usize,
    /// Tools that are looked at.
    pub candidates: usize,
    /// Maximum number of these that run where there is room for a handle.
    pub traced: usize,
    /// Number of these that are drawn by chance before the best are varied.
    pub drawn: usize,
    /// Number of the best that are solved with in full, plans verified.
    pub solved: usize,
}

impl DesignSettings {
    /// Three parts make a J, or a hook of two thirds of a metre.
    pub const PARTS: usize = 3;

    /// Default number of candidates: three to eleven seconds of two busy cores.
    pub const CANDIDATES: usize = 1000;

    /// Share that is drawn, of a thousand candidates.
    const TRACED: usize = 150;
    const DRAWN: usize = 300;

    /// The most parts that a form has.
    pub const MOST_PARTS: usize = 7;

    /// Looks at this many tools.
    pub fn looking_at(candidates: usize) -> Self {
        let [traced, drawn] = [Self::TRACED, Self::DRAWN].map(|share| candidates * share / 1000);
        Self { parts: Self::PARTS, candidates, traced, drawn, solved: 8 }
    }

    /// As many drawn by chance, and none that is traced or varied: what a search is measured against.
    pub fn at_random(self) -> Self {
        Self { traced: 0, drawn: self.candidates, ..self }
    }
}

impl Default for DesignSettings {
    fn default() -> Self {
        Self::looking_at(Self::CANDIDATES)
    }
}
