//! Refinement of candidates with the models of a planner, and its rollouts.

use crate::plan::{
    Candidate, RefineSettings, RefineStatistics, Refined, Rollouts, Workspace, refine,
};
use crate::task::Goal;

use super::query::Query;

/// Seed bit that separates the samples of the final model from the samples of the screening model.
const DECIDING: u64 = 1 << 15;

/// Trust radius for candidates refined by another model, in steps: the usual distance between the
/// optima of two models.
pub(super) const SCREENED_RADIUS: f64 = 1.0;

/// Counted access to the effect models of a planner.
pub(super) struct Refiner<'a> {
    /// Rollouts of the screening model.
    pub screening: Rollouts<'a>,
    /// Rollouts of the final model, if it differs.
    pub deciding: Option<Rollouts<'a>>,
    pub statistics: RefineStatistics,
}

impl<'a> Refiner<'a> {
    /// Creates the access with counts of zero.
    pub fn new(query: &Query<'a>) -> Self {
        let rollouts = |model| Rollouts::new(model, query.situation.clone());
        let planner = query.planner;
        Self {
            screening: rollouts(planner.screen()),
            deciding: planner.is_screened().then(|| rollouts(planner.model())),
            statistics: RefineStatistics::default(),
        }
    }

    /// Refines candidates towards `aims`, the task's goals or shifted copies of them. If the
    /// screening model differs from the final model, the final model makes the last rounds.
    pub fn refine(
        &mut self,
        query: &Query,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<Refined> {
        let settings = query.planner.settings();
        let last = if self.deciding.is_some() { settings.decided_rounds } else { 0 };
        let all = query.refine_settings(pushes);
        let task = query.task.with_goals(aims);
        let screened = refine(
            &Workspace { task: &task, ..query.workspace() },
            &mut self.screening,
            candidates,
            RefineSettings { rounds: settings.refine_rounds.saturating_sub(last), ..all },
            &mut self.statistics,
            query.progress,
        );
        if self.deciding.is_none() {
            return screened;
        }
        let candidates: Vec<Candidate> =
            screened.iter().map(|one| one.best.candidate.clone()).collect();
        let decided = self.decide(query, &candidates, aims, pushes);
        decided.into_iter().map(|one| continued(&screened[one.index], one)).collect()
    }

    /// Counts rollouts made elsewhere by the screening and the final model.
    pub fn count(&mut self, [screened, decided]: [usize; 2]) {
        self.screening.count(screened);
        self.deciding.as_mut().unwrap_or(&mut self.screening).count(decided);
    }

    /// Predicts candidates with the final model and refines the best of them with it. Returns no
    /// candidates if a single model is both screening and final model.
    pub fn decide(
        &mut self,
        query: &Query,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<Refined> {
        let settings = query.planner.settings();
        let all = query.refine_settings(pushes);
        let task = query.task.with_goals(aims);
        let Some(rollouts) = &mut self.deciding else { return Vec::new() };
        refine(
            &Workspace { task: &task, ..query.workspace() },
            rollouts,
            candidates,
            RefineSettings {
                rounds: settings.decided_rounds.min(settings.refine_rounds),
                seed: all.seed ^ DECIDING,
                short_list: settings.short_list,
                radius: SCREENED_RADIUS,
                ..all
            },
            &mut self.statistics,
            query.progress,
        )
    }
}

/// Joins the refinements by the screening model and by the final model.
fn continued(screened: &Refined, decided: Refined) -> Refined {
    let mut rounds = screened.rounds.clone();
    rounds.extend(decided.rounds);
    Refined { off: [screened.off[0], decided.off[1]], rounds, ..decided }
}
