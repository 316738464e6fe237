//! What is told while a task is solved: what is being done, and the best plan so far.

use crate::plan::SearchResult;
use crate::task::Plan;

use super::grade::Class;
use super::solving::Solving;

/// What is known of a plan, least first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Milestone {
    /// The model that screens says that it reaches the goal.
    SearchResult,
    /// So does the one that decides, after refinement.
    Refined,
    /// It works as written in both engines, in some of the disturbed replays.
    Works,
    /// It passes.
    Passes,
}

impl Milestone {
    fn words(self) -> &'static str {
        match self {
            Milestone::SearchResult => "a first look says that it reaches the goal",
            Milestone::Refined => "predicted to reach the goal",
            Milestone::Works => "works as written in both engines",
            Milestone::Passes => "passes",
        }
    }
}

impl Solving<'_> {
    /// Says what is done to plans of a number of pushes.
    pub(super) fn tell(&self, stage: &str, pushes: usize) {
        let s = if pushes == 1 { "" } else { "es" };
        self.watch.stage(&format!("{stage}, plans of {pushes} push{s}"));
    }

    /// Tells of the best of what the search found, all of it with one tool.
    pub(super) fn tell_found(&mut self, found: &[SearchResult]) {
        let best = found.first().filter(|best| best.score <= 1.0).map(|best| &best.candidate);
        if let Some((candidate, (tool, _))) = best.and_then(|one| Some((one, one.grip()?))) {
            let name = &self.workspace.tools[tool].name;
            self.tell_known(Milestone::SearchResult, named(&[name], candidate.pushes.len()));
        }
    }

    /// Tells of the first of these plans, the best one, that it is predicted to reach the goal.
    pub(super) fn tell_refined(&mut self, indices: &[usize]) {
        let best = indices.first().map(|&k| &self.tried[k]).filter(|tried| tried.score <= 1.0);
        if let Some(tried) = best {
            self.tell_known(Milestone::Refined, of(&tried.plan));
        }
    }

    /// Tells of the best of those that were replayed.
    pub(super) fn tell_replayed(&mut self) {
        let Some((grade, k)) = self.best else { return };
        let known = match grade.class {
            Class::Fails => return,
            Class::Fragile => Milestone::Works,
            Class::Edge | Class::Passes | Class::Safe => Milestone::Passes,
        };
        let plan = of(&self.tried[k].plan);
        self.tell_known(known, plan);
    }

    /// Tells it unless as much is known of a plan that was told before.
    fn tell_known(&mut self, known: Milestone, plan: String) {
        if self.known.is_none_or(|before| known > before) {
            self.known = Some(known);
            self.watch.so_far(&format!("{plan}: {}", known.words()));
        }
    }
}

fn of(plan: &Plan) -> String {
    named(&plan.tools(), plan.steps.len())
}

fn named(tools: &[&str], pushes: usize) -> String {
    let s = if pushes == 1 { "" } else { "es" };
    format!("{}, {pushes} push{s}", tools.join(" and "))
}
