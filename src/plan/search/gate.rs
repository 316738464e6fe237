//! End of a level of the search, once its best kinds of candidates no longer change.
//!
//! Pushes are rolled out in order of their promise. In that order all of the eight best kinds are
//! found after 14 % of the rollouts in the median of the shipped and random tasks.

use crate::plan::{SearchResult, kinds};

/// Share of a level's pushes in a batch.
const SHARE: f64 = 0.125;

/// Minimum number of pushes in a batch.
const LEAST: usize = 16;

/// Number of consecutive batches without a change of the best kinds that end a level.
const QUIET: usize = 2;

/// Best kinds of a level so far.
pub(super) struct Gate {
    /// Number of kinds that must be certain.
    wanted: usize,
    /// Indices of the best pushes of different kinds, best first.
    best: Vec<usize>,
    /// Number of batches since they changed.
    quiet: usize,
}

impl Gate {
    /// Creates the gate of a level before its first batch.
    pub fn new(wanted: usize) -> Self {
        Self { wanted, best: Vec::new(), quiet: 0 }
    }

    /// Returns the number of pushes in a batch of a level of `count` pushes.
    pub fn batch(count: usize) -> usize {
        ((SHARE * count as f64) as usize).max(LEAST)
    }

    /// Compares the best kinds with those before the last batch. `found` holds all candidates with
    /// the indices of their pushes, best first.
    pub fn look(&mut self, found: &[(usize, SearchResult)]) {
        let results: Vec<SearchResult> = found.iter().map(|(_, one)| one.clone()).collect();
        let best: Vec<usize> =
            kinds(&results, self.wanted).into_iter().map(|k| found[k].0).collect();
        let same = best.len() == self.wanted && best == self.best;
        self.quiet = if same { self.quiet + 1 } else { 0 };
        self.best = best;
    }

    /// Returns `true` if the best kinds have not changed in the last batches.
    pub fn is_closed(&self) -> bool {
        self.quiet >= QUIET
    }
}
