//! Statistics of planning: costs and reasons for dropped candidates.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Infeasible, QpProblem, QpStatus};

/// Statistics of one search, summed over the sequence lengths.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SearchStatistics {
    /// Number of pushes considered.
    pub considered: usize,
    /// Number of infeasible pushes, by reason.
    pub infeasible: BTreeMap<Infeasible, usize>,
    /// Number of pushes that repeat another placement.
    pub repeated: usize,
    /// Number of feasible pushes beyond the budget of rollouts.
    pub beyond_budget: usize,
    /// Number of rollouts.
    pub rollouts: usize,
    /// Improvements of the best score: the number of rollouts made and the score (error in units of
    /// the tolerance).
    pub best: Vec<(usize, f64)>,
}

impl SearchStatistics {
    pub(super) fn refuse(&mut self, reason: Infeasible) {
        *self.infeasible.entry(reason).or_default() += 1;
    }

    /// Adds the cost of another search, whose improvements are not kept if there are own ones.
    pub fn add(&mut self, other: &Self) {
        self.considered += other.considered;
        for (reason, count) in &other.infeasible {
            *self.infeasible.entry(*reason).or_default() += count;
        }
        self.repeated += other.repeated;
        self.beyond_budget += other.beyond_budget;
        self.rollouts += other.rollouts;
        if self.best.is_empty() {
            self.best.clone_from(&other.best);
        }
    }

    pub(super) fn improve(&mut self, rollouts: usize, score: f64) {
        if self.best.last().is_none_or(|&(_, best)| score < best) && score.is_finite() {
            self.best.push((rollouts, score));
        }
    }
}

/// Statistics of one refinement.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RefineStatistics {
    /// Number of rollouts of single candidates.
    pub rollouts: usize,
    /// Number of solved quadratic programmes.
    pub solved: usize,
    /// Unsolved quadratic programmes with their status, for analysis.
    pub failures: Vec<(QpStatus, QpProblem)>,
}
