//! Search with all budgets of the effort, where the budgets of a first attempt do not suffice.
//!
//! A draft's budgets solve most tasks. A search with all budgets follows only for numbers of pushes
//! whose plans come near the goals and are not safe, and for the others if nothing works.

use crate::plan::{Search, is_behind};
use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::grade::Class;
use crate::solve::retry::replayed_error;
use crate::solve::solving::{Batch, Strategy};

/// Maximum error of the replays of a plan near the goals, in units of the tolerances.
const NEAR: f64 = 1.25;

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
        let Some(usual) = &board.search else { return Ok(None) };
        // One more push is cheaper to find, unless a plan of this length passes.
        let fails = board.attempts.best_class() < Class::Forced;
        let longer = fails && usual.can_deepen() && usual.depth() < super::push::LONGEST;
        let pushes = usual.depth().saturating_sub(usize::from(longer));
        let wanted = pushes > board.all.search.as_ref().map_or(0, Search::depth)
            && is_near(board, pushes)
            && board.wants_longer(pushes - 1);
        Ok(if wanted { all_budgets(board, pushes) } else { None })
    }
}

/// Returns `true` if the replays of a plan of `pushes` pushes end near the goals.
fn is_near(board: &Blackboard, pushes: usize) -> bool {
    let (task, start) = (board.query.task, &board.query.situation.start);
    // A push rarely meets two goals.
    if task.goals.iter().filter(|goal| !goal.reached(start)).count() > pushes {
        return false;
    }
    board.attempts.list.iter().any(|one| {
        let tried = one.plan.steps.len() == pushes && one.verdict.is_some();
        tried && !is_behind(one.score) && replayed_error(task, one) <= NEAR
    })
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
