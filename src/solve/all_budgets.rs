//! State of the search with all budgets of the effort, which follows a first attempt with fewer.

use std::collections::VecDeque;

use crate::plan::{Search, SearchStatistics};

use super::candidates::Candidates;
use super::settings::Settings;

/// State of the search with all budgets.
pub(super) struct AllBudgets<'a> {
    /// Budgets of the first attempt; `None` once all budgets have replaced them.
    pub first: Option<Settings>,
    pub search: Option<Search<'a>>,
    /// Results for numbers of pushes that were not near the goals, to be tried last.
    pub skipped: VecDeque<Candidates>,
    /// Cost of the first attempt's search, once all budgets have replaced it.
    pub spent: SearchStatistics,
    /// Whether more than the first attempt was needed.
    pub used: bool,
}

impl<'a> AllBudgets<'a> {
    /// Creates the state before the search. `first` are the budgets of a first attempt, if there is
    /// one.
    pub fn after(first: Option<Settings>) -> Self {
        let (skipped, spent) = (VecDeque::new(), SearchStatistics::default());
        Self { first, search: None, skipped, spent, used: false }
    }

    /// Returns the statistics of all searches; `usual` is the search on the blackboard.
    pub fn statistics(&self, usual: Option<&Search<'a>>) -> SearchStatistics {
        let mut all = self.spent.clone();
        for search in [usual, self.search.as_ref()].into_iter().flatten() {
            all.add(search.statistics());
        }
        all
    }
}
