//! Search with all budgets of the effort, where the budgets of a first attempt do not suffice.
//!
//! A draft's budgets solve most tasks. A search with all budgets follows only for numbers of pushes
//! whose plans come near the goals and are not safe, and for the others if nothing works.

use crate::plan::{Search, is_behind};
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::retry::replayed_error;
use crate::solve::solving::{Batch, Strategy};

/// Maximum predicted error of a plan near the goals, in units of the tolerances.
const NEAR: f64 = 2.0;

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
