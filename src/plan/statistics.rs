//! Cost of planning, and reasons why candidates were dropped.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Infeasible, QpProblem, QpStatus};

/// Numbers of one search, added up over the lengths of sequence that it went through.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SearchStatistics {
    /// Pushes that were considered.
    pub considered: usize,
    /// Of these, how many could not be made, by reason.
    pub infeasible: BTreeMap<Infeasible, usize>,
    /// Of these, how many repeat another placement.
    pub repeated: usize,
    /// Of these, how many could be made but were beyond the budget of rollouts.
    pub beyond_budget: usize,
    /// Rollouts made.
    pub rollouts: usize,
    /// Every time the best score improved: rollouts made by then, and the score (error in units
    /// of the tolerance).
    pub best: Vec<(usize, f64)>,
}

impl SearchStatistics {
    pub(super) fn refuse(&mut self, reason: Infeasible) {
        *self.infeasible.entry(reason).or_default() += 1;
    }

    pub(super) fn improve(&mut self, rollouts: usize, score: f64) {
        if self.best.last().is_none_or(|&(_, best)| score < best) && score.is_finite() {
            self.best.push((rollouts, score));
        }
    }
}

/// Numbers of one refinement.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RefineStatistics {
    /// Rollouts of single candidates made.
    pub rollouts: usize,
    /// Quadratic programmes solved.
    pub solved: usize,
    /// Those that were not, with the status, to be looked at.
    pub failures: Vec<(QpStatus, QpProblem)>,
}
