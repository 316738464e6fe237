//! Plans that change the tool or the grip between pushes.

use crate::plan::Search;
use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};

/// Search for tasks in which no plan with one grip is even predicted to reach the goal.
#[derive(Default)]
pub(super) struct ChangeTool<'a> {
    begun: bool,
    search: Option<Search<'a>>,
}

impl<'a> Strategy<'a> for ChangeTool<'a> {
    fn name(&self) -> &'static str {
        "change tool"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        if !self.begun {
            self.begun = true;
            let usual = board.search.as_ref().filter(|_| !board.attempts.any_refuted());
            self.search = usual.and_then(Search::changing);
        }
        let Some(search) = &mut self.search else { return Ok(None) };
        let wanted = board.wants_longer(search.depth()) && search.can_deepen();
        Ok(wanted.then(|| Batch::Pushes(board.deepen(search))))
    }
}
