//! All budgets of the effort, where the budgets of a first attempt do not suffice.
//!
//! Most tasks are solved by a draft's budgets. A search with all budgets follows only for numbers of
//! pushes whose plans come near the goals and are not safe, and for the others if nothing works.

use std::collections::VecDeque;

use crate::plan::{Search, SearchStatistics, is_behind};
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::{Blackboard, Candidates};
use crate::solve::retry::replayed_error;
use crate::solve::settings::Settings;
use crate::solve::solving::{Batch, Strategy};

/// Maximum predicted error of a plan near the goals, in units of the tolerances.
const NEAR: f64 = 2.0;

/// State of the search with all budgets.
pub(in crate::solve) struct AllBudgets<'a> {
    /// Budgets of the first attempt; `None` once all budgets have replaced them.
    first: Option<Settings>,
    search: Option<Search<'a>>,
    /// Results for numbers of pushes that were not near the goals, to be tried last.
    skipped: VecDeque<Candidates>,
    /// Cost of the first attempt's search, once all budgets have replaced it.
    spent: SearchStatistics,
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

/// Returns the candidates of `pushes` pushes of the search with all budgets.
fn all_budgets(board: &mut Blackboard, pushes: usize) -> Option<Batch> {
    board.query.settings = *board.query.planner.settings();
    board.all.used = true;
    let mut search = board.all.search.take().unwrap_or_else(|| board.query.search());
    let mut found = None;
    while search.depth() < pushes && search.can_deepen() {
        board.all.skipped.extend(found.take());
        found = Some(board.deepen(&mut search));
    }
    board.all.search = Some(search);
    found.map(Batch::Pushes)
}

/// Strategy that searches plans of as many pushes as the last ones with all budgets.
pub(super) struct SameLength;

impl<'a> Strategy<'a> for SameLength {
    fn name(&self) -> &'static str {
        "push"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(first) = board.all.first else { return Ok(None) };
        board.query.settings = first;
        let depth = |search: &Option<Search>| search.as_ref().map_or(0, Search::depth);
        let pushes = depth(&board.search);
        let wanted = pushes > depth(&board.all.search)
            && is_near(board, pushes)
            && board.wants_longer(pushes - 1);
        Ok(if wanted { all_budgets(board, pushes) } else { None })
    }
}

/// Returns `true` if plans of `pushes` pushes come near the goals: in their predictions, and in the
/// replays if there are any.
fn is_near(board: &Blackboard, pushes: usize) -> bool {
    let (task, start) = (board.query.task, &board.query.situation.start);
    // A push rarely meets two goals.
    if task.goals.iter().filter(|goal| !goal.reached(start)).count() > pushes {
        return false;
    }
    let near = |one: &&Attempt| {
        one.plan.steps.len() == pushes && !is_behind(one.score) && one.score <= NEAR
    };
    let mut near = board.attempts.list.iter().filter(near).peekable();
    let any = near.peek().is_some();
    let mut replayed = near.filter(|one| one.verdict.is_some()).peekable();
    match replayed.peek() {
        Some(_) => replayed.any(|one| replayed_error(task, one) <= NEAR),
        None => any,
    }
}

/// Strategy that continues with all budgets if no plan of the first attempt works.
pub(super) struct Remaining;

impl<'a> Strategy<'a> for Remaining {
    fn name(&self) -> &'static str {
        "push"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        if board.all.first.is_none() || !board.wants_longer(usize::MAX) {
            return Ok(None);
        }
        board.query.settings = *board.query.planner.settings();
        board.all.used = true;
        if let Some(skipped) = board.all.skipped.pop_front() {
            return Ok(Some(Batch::Pushes(skipped)));
        }
        board.all.first = None;
        let search = board.all.search.take().unwrap_or_else(|| board.query.search());
        if let Some(first) = board.search.replace(search) {
            board.all.spent.add(first.statistics());
        }
        // The usual strategy continues from here.
        super::push::Push.next(board)
    }
}
