//! Hints of a failed search at the cause: they order the finders, and leave out limits that no push
//! has met.

use std::collections::BTreeMap;

use crate::outcome::{Verdict, Warning};
use crate::plan::{Infeasible, SearchStatistics};

/// Share of the considered pushes above which a reason is a hint.
const FREQUENT: f64 = 0.2;

/// Reasons why pushes were infeasible and plans failed.
#[derive(Default)]
pub(in crate::solve) struct Hints {
    considered: usize,
    infeasible: BTreeMap<Infeasible, usize>,
    failures: Vec<Warning>,
}

impl Hints {
    /// Collects the hints of a search and of the verdicts on its plans.
    pub fn of<'v>(search: &SearchStatistics, verdicts: impl Iterator<Item = &'v Verdict>) -> Self {
        let faults = verdicts.flat_map(|verdict| {
            let replayed = verdict.evidence.iter().flat_map(|evidence| &evidence.warnings);
            verdict.forbidden.iter().chain(replayed).cloned()
        });
        Self {
            considered: search.considered,
            infeasible: search.infeasible.clone(),
            failures: faults.filter(Warning::forbids_success).collect(),
        }
    }

    /// Returns `true` if any push was infeasible for this reason.
    pub fn any(&self, reason: Infeasible) -> bool {
        self.infeasible.contains_key(&reason)
    }

    /// Returns `true` if many pushes were infeasible for this reason.
    pub fn often(&self, reason: Infeasible) -> bool {
        let count = self.infeasible.get(&reason).copied().unwrap_or(0);
        count as f64 > FREQUENT * self.considered as f64
    }

    /// Returns `true` if a plan failed for such a reason.
    pub fn failed(&self, is_reason: impl Fn(&Warning) -> bool) -> bool {
        self.failures.iter().any(is_reason)
    }
}
