//! A first look at what a tool can do: a small search and refinement with the model that screens.
//! Nothing is verified.

use std::cmp::Ordering;
use std::sync::Arc;

use pushplan::effect::EffectModel;
use pushplan::plan::{
    CostToGo, FOUND_RADIUS, REFINABLE, RefineSettings, RefineStatistics, Refined, Rollouts, Search,
    Uncertainty, Workspace, refine,
};
use pushplan::scene::{Situation, Tool};
use pushplan::task::Task;
use pushplan::watch::{Quiet, Watch};

use pushplan::solve::{LeverSettings, Settings, WELL_INSIDE, distinct};

/// Settings of screening: about half a thousand rollouts where three pushes are allowed.
const SETTINGS: Settings = Settings {
    offsets: 3,
    beam: 4,
    search_rollouts: 120,
    refined: 2,
    refine_rounds: 2,
    refine_extra: 0,
    decided_rounds: 0,
    short_list: 0,
    verified_at_once: 1,
    verify_batches: 0,
    disturbed: 0,
    levers: LeverSettings::DRAFT,
};

/// Screening result of a tool; compared in this order, less being better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// How far off the best plan ends, in units of the tolerance, on the support and with the small errors
    /// that are worst for it; 0 where that is well inside, and the way that is left where the goal is not
    /// reached.
    pub misses: f64,
    /// Pushes of that plan.
    pub pushes: usize,
    /// Pieces of the tool, flush parts taken together, and parts.
    pub pieces: usize,
    pub parts: usize,
    /// Area of its parts together, square metres.
    pub size: f64,
    /// Rollouts that it took.
    pub rollouts: usize,
}

impl Look {
    /// What is preferred, less being better: what ends near, with few pushes and a simple, small tool, as
    /// plans are ranked.
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
    pub watch: &'a dyn Watch,
}

impl Looking<'_> {
    /// Looks at a tool.
    pub fn at(&self, tool: Tool) -> Look {
        // Many tools are looked at side by side.
        let watch = &Quiet(self.watch);
        let size = tool.parts().iter().map(|part| part.footprint().area()).sum();
        let (pieces, parts) = (tool.outline().len(), tool.parts().len());
        let tools = [Arc::new(tool)];
        let workspace = Workspace { task: self.task, tools: &tools };
        let mut rollouts = Rollouts::new(self.model, self.situation.clone());
        let laid = (self.field.clone(), self.spread.clone());
        let mut search = Search::laid(workspace, self.situation, SETTINGS.search(0.0), laid);
        let (mut misses, mut pushes) = (f64::INFINITY, 0);
        while search.can_deepen() && misses > 0.0 && !self.watch.cancelled() {
            let found = search.deepen(&mut rollouts, watch);
            let candidates = distinct(&found, SETTINGS.refined, 0);
            let refinable = found.first().is_some_and(|one| one.score <= REFINABLE);
            let refined = refine(
                &workspace,
                &mut rollouts,
                &candidates,
                RefineSettings {
                    rounds: if refinable { SETTINGS.refine_rounds } else { 0 },
                    extra: SETTINGS.refine_extra,
                    seed: 0,
                    enough: 1,
                    rollouts: usize::MAX,
                    short_list: usize::MAX,
                    radius: FOUND_RADIUS,
                },
                &mut RefineStatistics::default(),
                watch,
            );
            for one in refined.iter().filter(|one| one.best.is_sound()) {
                let missed = self.missed(&workspace, &mut rollouts, one);
                if missed < misses {
                    (misses, pushes) = (missed, search.depth());
                }
            }
        }
        Look { misses, pushes, pieces, parts, size, rollouts: rollouts.used() }
    }

    /// Returns the error of a plan in the worst of the cases that are tried.
    fn missed(&self, workspace: &Workspace, rollouts: &mut Rollouts, one: &Refined) -> f64 {
        let worst = one.worst.max(one.best.score);
        if worst > 1.0 {
            // Around what stands there, where the distance misleads.
            let left = self.field.cost(&one.best.outcome);
            return worst.max(if left.is_finite() { left } else { 0.0 });
        }
        let worst = worst.max(self.spread.worst(workspace, rollouts, &one.best));
        if worst <= WELL_INSIDE { 0.0 } else { worst }
    }
}
