//! Refinement of candidates with the model of a planner, and its rollouts.

use crate::plan::{Candidate, RefineStatistics, Refined, Rollouts, Workspace, refine};
use crate::task::Goal;

use super::query::Query;

/// Counted access to the effect model of a planner.
pub(super) struct Refiner<'a> {
    pub rollouts: Rollouts<'a>,
    pub statistics: RefineStatistics,
}

impl<'a> Refiner<'a> {
    /// Creates the access with counts of zero.
    pub fn new(query: &Query<'a>) -> Self {
        let rollouts = Rollouts::new(query.planner.model(), query.situation.clone());
        Self { rollouts, statistics: RefineStatistics::default() }
    }

    /// Refines candidates towards `aims`, the task's goals or shifted copies of them.
    pub fn refine(
        &mut self,
        query: &Query,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<Refined> {
        let task = query.task.with_goals(aims);
        refine(
            &Workspace { task: &task, ..query.workspace() },
            &mut self.rollouts,
            candidates,
            query.refine_settings(pushes),
            &mut self.statistics,
            query.progress,
        )
    }
}
