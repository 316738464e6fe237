//! The state that all strategies share while one task is solved.

use crate::plan::{REFINABLE, Search, SearchResult, bare};
use crate::watch::Instant;

use super::adaptive_verify::Verification;
use super::attempts::{Attempt, Attempts};
use super::grade::Class;
use super::progress::Progress;
use super::query::Query;
use super::refiner::Refiner;
use super::solution::LeverStatistics;
use super::{PlanStatus, Timing};

/// Everything that is known so far of one task. A strategy reads it to decide what to try next.
pub(super) struct Blackboard<'a> {
    pub query: Query<'a>,
    /// The search for plans with one grip; `None` for tasks that leave the plane.
    pub search: Option<Search<'a>>,
    /// Results of the last search, until they are hardened.
    pub searched: Option<Candidates>,
    pub refiner: Refiner<'a>,
    pub verification: Verification<'a>,
    pub attempts: Attempts,
    pub progress: Progress<'a>,
    pub timing: Timing,
    /// Costs of lever-ups, where the task leaves the plane.
    pub levers: Option<LeverStatistics>,
}

/// Candidates of one length, best first.
#[derive(Clone)]
pub(super) struct Candidates {
    pub found: Vec<SearchResult>,
    pub pushes: usize,
    /// Whether others like these may be made more robust.
    pub hardenable: bool,
}

impl<'a> Blackboard<'a> {
    /// The state before pushes are searched for.
    pub fn for_pushes(query: Query<'a>, search: Search<'a>) -> Self {
        let perturbed = query.planner.settings().disturbed;
        Self { search: Some(search), ..Self::new(query, perturbed) }
    }

    /// The state before lever-ups are searched for.
    pub fn for_levers(query: Query<'a>) -> Self {
        let perturbed = query.planner.settings().levers.disturbed;
        Self { levers: Some(LeverStatistics::default()), ..Self::new(query, perturbed) }
    }

    fn new(query: Query<'a>, perturbed: usize) -> Self {
        Self {
            query,
            search: None,
            searched: None,
            refiner: Refiner::new(&query),
            verification: Verification::new(query, perturbed),
            attempts: Attempts::default(),
            progress: Progress::new(query.watch),
            timing: Timing::default(),
            levers: None,
        }
    }

    /// Tries the plan without steps, which is verified where the goal is met at the start.
    pub fn try_idle(&mut self) {
        let idle = self.attempts.push(Attempt::idle(&self.query));
        if self.query.task.reached(&self.query.situation.start) {
            self.verification.verify(&mut self.attempts, &[idle]);
        }
    }

    /// Returns `true` if plans of more than `depth` pushes are wanted: longer ones are no better than one that
    /// passes, but one push more is better than an end near the edge of the tolerance.
    pub fn wants_longer(&self, depth: usize) -> bool {
        let wanted = self.attempts.best.is_none_or(|(grade, k)| match grade.class {
            Class::Fails | Class::Fragile => true,
            Class::Edge => depth <= self.attempts.list[k].plan.steps.len(),
            Class::Passes | Class::Safe => false,
        });
        wanted && self.verification.promising != Some(true) && !self.query.watch.cancelled()
    }

    /// Searches plans of one push more.
    pub fn deepen(&mut self, search: &mut Search<'a>) -> Candidates {
        let (began, pushes) = (Instant::now(), search.depth() + 1);
        self.progress.stage_of("search", pushes);
        let mut found = search.deepen(&mut self.refiner.screening, self.query.watch);
        // A plan that leaves one of several goals behind is no candidate yet.
        if self.query.task.goals.len() > 1 {
            found.retain(|one| bare(one.score) <= REFINABLE);
        }
        self.timing.search += began.elapsed().as_secs_f64();
        self.progress.found(&found, self.query.tools);
        Candidates { found, pushes, hardenable: true }
    }

    /// Returns the status that the attempts so far amount to.
    pub fn status(&self) -> PlanStatus {
        match self.attempts.best_class() {
            Class::Fails if self.attempts.any_verified() => PlanStatus::FailedVerification,
            Class::Fails => PlanStatus::NoPlan,
            class => class.status(),
        }
    }
}
