//! Screening of tools: a small search and refinement with the screening model, without
//! verification.

use std::cmp::Ordering;
use std::sync::Arc;

use pushplan::effect::EffectModel;
use pushplan::plan::{
    CostToGo, REFINABLE, RefineSettings, RefineStatistics, Refined, Rollouts, Search, Uncertainty,
    Workspace, refine,
};
use pushplan::progress::{Progress, Quiet};
use pushplan::scene::{Situation, Tool};
use pushplan::task::Task;

use pushplan::solve::{LeverSettings, Settings, WELL_INSIDE, distinct};

/// Settings of screening: about 500 rollouts for up to three pushes.
const SETTINGS: Settings = Settings {
    offsets: 3,
    beam: 4,
    search_rollouts: 120,
    refined: 2,
    refine_rounds: 2,
    refine_extra: 0,
    verified_at_once: 1,
    verify_batches: 0,
    replays: 0,
    levers: LeverSettings::DRAFT,
};

/// Screening result of a tool; compared in this order, less being better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// Error of the best plan, in units of the tolerance, for the worst support model and
    /// perturbation. The error is 0 well within the tolerance. If the goal is not reached, it is at
    /// least the cost-to-go.
    pub misses: f64,
    /// Number of pushes of that plan.
    pub pushes: usize,
    /// Number of pieces of the tool, with flush parts merged, and number of parts.
    pub pieces: usize,
    pub parts: usize,
    /// Total area of the parts, square metres.
    pub size: f64,
    /// Number of rollouts used.
    pub rollouts: usize,
}

impl Look {
    /// Compares two results as plans are ranked, less being better: the error, then the number of
    /// pushes, then simplicity and size of the tool.
    pub fn compare(&self, other: &Self) -> Ordering {
        let near = self.misses.total_cmp(&other.misses);
        let counts = |look: &Self| (look.pushes, look.pieces, look.parts);
        let simple = counts(self).cmp(&counts(other));
        near.then(simple).then(self.size.total_cmp(&other.size))
    }
}

/// Task and model of screening.
pub(super) struct Looking<'a> {
    pub task: &'a Task,
    pub situation: &'a Situation,
    pub model: &'a dyn EffectModel,
    pub field: CostToGo<'a>,
    pub spread: Uncertainty,
    pub progress: &'a dyn Progress,
}

impl Looking<'_> {
    /// Screens a tool.
    pub fn at(&self, tool: Tool) -> Look {
        let size = tool.parts().iter().map(|part| part.footprint().area()).sum();
        let (pieces, parts) = (tool.outline().len(), tool.parts().len());
        let tools = [Arc::new(tool)];
        let workspace = Workspace { task: self.task, tools: &tools };
        let mut rollouts = Rollouts::new(self.model, self.situation.clone());
        let laid = (self.field.clone(), self.spread.clone());
        let mut search = Search::laid(workspace, self.situation, SETTINGS.search(0.0), laid);
        let mut best = (f64::INFINITY, 0);
        self.deepen(&mut search, usize::MAX, &mut rollouts, &mut best);
        // A window may lie between the offsets of a single push.
        if best.0 > 1.0
            && let Some(mut search) = search.with_fine_offsets()
        {
            self.deepen(&mut search, 1, &mut rollouts, &mut best);
        }
        let (misses, pushes) = best;
        Look { misses, pushes, pieces, parts, size, rollouts: rollouts.used() }
    }

    /// Searches for plans of up to `most` pushes until one ends well within the tolerance. `best`
    /// holds the smallest error so far and the number of pushes of its plan.
    fn deepen(
        &self,
        search: &mut Search,
        most: usize,
        rollouts: &mut Rollouts,
        best: &mut (f64, usize),
    ) {
        let workspace = search.workspace();
        // Many tools are screened in parallel.
        let progress = &Quiet(self.progress);
        while search.can_deepen()
            && search.depth() < most
            && best.0 > 0.0
            && !self.progress.cancelled()
        {
            let found = search.deepen(rollouts, progress);
            let candidates = distinct(&found, SETTINGS.refined, 0);
            let refinable = found.first().is_some_and(|one| one.score <= REFINABLE);
            let refined = refine(
                &workspace,
                rollouts,
                &candidates,
                RefineSettings {
                    rounds: if refinable { SETTINGS.refine_rounds } else { 0 },
                    extra: SETTINGS.refine_extra,
                    seed: 0,
                    enough: 1,
                    rollouts: usize::MAX,
                },
                &mut RefineStatistics::default(),
                progress,
            );
            for one in refined.iter().filter(|one| one.best.is_sound()) {
                let missed = self.missed(&workspace, rollouts, one);
                if missed < best.0 {
                    *best = (missed, search.depth());
                }
            }
        }
    }

    /// Returns the error of a plan in the worst of the evaluated cases.
    fn missed(&self, workspace: &Workspace, rollouts: &mut Rollouts, one: &Refined) -> f64 {
        let worst = one.worst.max(one.best.score);
        if worst > 1.0 {
            // The cost-to-go includes detours around obstacles, which the distance ignores.
            let left = self.field.cost(&one.best.outcome);
            return worst.max(if left.is_finite() { left } else { 0.0 });
        }
        let worst = worst.max(self.spread.worst(workspace, rollouts, &one.best));
        if worst <= WELL_INSIDE { 0.0 } else { worst }
    }
}
