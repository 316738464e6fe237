//! State shared by all strategies while one task is solved.

use crate::plan::{REFINABLE, Search, bare};
use crate::progress::Instant;

use super::adaptive_verify::Verification;
use super::all_budgets::AllBudgets;
use super::attempts::{Attempt, Attempts};
use super::candidates::Candidates;
use super::grade::Class;
use super::progress::Reporter;
use super::query::Query;
use super::refiner::Refiner;
use super::solution::LeverStatistics;
use super::{PlanStatus, Timing};

/// Current state of the solution of one task. A strategy reads it to decide its next step.
pub(super) struct Blackboard<'a> {
    pub query: Query<'a>,
    /// Search for plans with one grip; `None` for tasks that leave the plane.
    pub search: Option<Search<'a>>,
    /// Results of the last search, until they have been hardened.
    pub searched: Option<Candidates>,
    pub refiner: Refiner<'a>,
    pub verification: Verification<'a>,
    pub attempts: Attempts,
    pub reporter: Reporter<'a>,
    pub timing: Timing,
    /// Search with all budgets, after a first attempt with fewer.
    pub all: AllBudgets<'a>,
    /// Costs of lever-ups, if the task leaves the plane.
    pub levers: Option<LeverStatistics>,
}

impl<'a> Blackboard<'a> {
    /// Creates the state before the search for pushes.
    pub fn for_pushes(query: Query<'a>, search: Search<'a>) -> Self {
        let perturbed = query.settings.replays;
        let first = (query.settings != *query.planner.settings()).then_some(query.settings);
        let all = AllBudgets::after(first);
        Self { search: Some(search), all, ..Self::new(query, perturbed) }
    }

    /// Creates the state before the search for lever-ups.
    pub fn for_levers(query: Query<'a>) -> Self {
        let perturbed = query.settings.levers.replays;
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
            reporter: Reporter::new(query.progress),
            timing: Timing::default(),
            all: AllBudgets::after(None),
            levers: None,
        }
    }

    /// Tries the plan without steps, and verifies it if the goal is met at the start.
    pub fn try_idle(&mut self) {
        let idle = self.attempts.push(Attempt::idle(&self.query));
        if self.query.task.reached(&self.query.situation.start) {
            self.verification.verify(&mut self.attempts, &[idle]);
        }
    }

    /// Returns `true` if plans of more than `depth` pushes are wanted. Longer plans are no better
    /// than a passing one, but one more push is better than an end near the edge of the tolerance.
    pub fn wants_longer(&self, depth: usize) -> bool {
        if self.attempts.all_too_heavy() {
            return false;
        }
        let wanted = self.attempts.best.is_none_or(|(grade, k)| match grade.class {
            Class::Fails | Class::Fragile => true,
            Class::Forced | Class::Edge => depth <= self.attempts.list[k].plan.steps.len(),
            Class::Passes | Class::Safe => false,
        });
        wanted && self.verification.promising != Some(true) && !self.query.progress.cancelled()
    }

    /// Searches for plans with one more push.
    pub fn deepen(&mut self, search: &mut Search<'a>) -> Candidates {
        let (began, pushes) = (Instant::now(), search.depth() + 1);
        self.reporter.stage_of("search", pushes);
        let mut found = search.deepen(&mut self.refiner.rollouts, self.query.progress);
        // A plan that ignores one of several goals is not yet a candidate.
        if self.query.task.goals.len() > 1 {
            found.retain(|one| bare(one.score) <= REFINABLE);
        }
        self.timing.search += began.elapsed().as_secs_f64();
        self.reporter.found(&found, self.query.tools);
        Candidates { found, pushes, hardenable: true }
    }

    /// Returns the status that follows from the attempts so far.
    pub fn status(&self) -> PlanStatus {
        match self.attempts.best_class() {
            Class::Fails if self.attempts.any_refuted() => PlanStatus::FailedVerification,
            Class::Fails => PlanStatus::NoPlan,
            class => class.status(),
        }
    }
}
