//! Progress reports while a task is solved: the current stage, and the best plan so far.

use std::sync::Arc;

use crate::plan::SearchResult;
use crate::progress::Progress;
use crate::scene::Tool;
use crate::task::Plan;

use super::attempts::{Attempt, Attempts};
use super::grade::Class;

/// Evidence for the best plan so far, weakest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Milestone {
    /// The search predicts success.
    Found,
    /// Success is predicted after refinement.
    Refined,
    /// The plan works as written in both engines, and in some of the perturbed replays.
    Works,
    /// The plan passes.
    Passes,
}

impl Milestone {
    fn words(self) -> &'static str {
        match self {
            Milestone::Found => "the search predicts success",
            Milestone::Refined => "success is predicted after refinement",
            Milestone::Works => "the nominal replays succeed in both engines",
            Milestone::Passes => "passes",
        }
    }
}

/// Progress reports to an observer, each milestone once.
pub(super) struct Reporter<'a> {
    progress: &'a dyn Progress,
    /// Name of the current strategy.
    pub strategy: &'static str,
    reported: Option<Milestone>,
}

impl<'a> Reporter<'a> {
    /// Creates reports to `progress`.
    pub fn new(progress: &'a dyn Progress) -> Self {
        Self { progress, strategy: "", reported: None }
    }

    /// Reports a stage of the current strategy.
    pub fn stage(&self, stage: &str) {
        match self.strategy {
            "" => self.progress.stage(stage),
            strategy => self.progress.stage(&format!("{strategy}: {stage}")),
        }
    }

    /// Reports a stage of work on plans of a number of pushes.
    pub fn stage_of(&self, stage: &str, pushes: usize) {
        let s = if pushes == 1 { "" } else { "es" };
        self.stage(&format!("{stage}, plans of {pushes} push{s}"));
    }

    /// Reports the best search result, if it reaches the goal with one tool.
    pub fn found(&mut self, found: &[SearchResult], tools: &[Arc<Tool>]) {
        let best = found.first().filter(|best| best.score <= 1.0).map(|best| &best.candidate);
        if let Some((candidate, (tool, _))) = best.and_then(|one| Some((one, one.grip()?))) {
            self.report(Milestone::Found, named(&[&tools[tool].name], candidate.pushes.len()));
        }
    }

    /// Reports the best refined plan if it is predicted to reach the goal.
    pub fn refined(&mut self, best: Option<&Attempt>) {
        if let Some(attempt) = best.filter(|attempt| attempt.score <= 1.0) {
            self.report(Milestone::Refined, summary(&attempt.plan));
        }
    }

    /// Reports the best of the replayed plans.
    pub fn replayed(&mut self, attempts: &Attempts) {
        let Some((grade, k)) = attempts.best else { return };
        let milestone = match grade.class {
            Class::Fails => return,
            Class::Fragile => Milestone::Works,
            Class::Forced | Class::Edge | Class::Passes | Class::Safe => Milestone::Passes,
        };
        self.report(milestone, summary(&attempts.list[k].plan));
    }

    /// Reports `plan` if its evidence is stronger than for the last plan reported.
    fn report(&mut self, milestone: Milestone, plan: String) {
        if self.reported.is_none_or(|before| milestone > before) {
            self.reported = Some(milestone);
            self.progress.so_far(&format!("{plan}: {}", milestone.words()));
        }
    }
}

fn summary(plan: &Plan) -> String {
    named(&plan.tools(), plan.steps.len())
}

fn named(tools: &[&str], pushes: usize) -> String {
    let s = if pushes == 1 { "" } else { "es" };
    format!("{}, {pushes} push{s}", tools.join(" and "))
}
