//! Plans with lateral offsets between infeasible ones, if no other plan works.

use crate::plan::Search;
use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::grade::Class;
use crate::solve::solving::{Batch, Strategy};

/// Maximum number of pushes of searched plans: each level costs as much as the usual search.
const LONGEST: usize = 2;

/// Strategy that searches again with fine offsets.
#[derive(Default)]
pub(super) struct FineOffsets<'a> {
    search: Option<Search<'a>>,
    begun: bool,
}

impl<'a> Strategy<'a> for FineOffsets<'a> {
    fn name(&self) -> &'static str {
        "fine offsets"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(usual) = &board.search else { return Ok(None) };
        // The task allows no push if the usual search has not begun.
        if board.attempts.best_class() > Class::Fails || usual.depth() == 0 {
            return Ok(None);
        }
        if !std::mem::replace(&mut self.begun, true) {
            self.search = usual.with_fine_offsets();
        }
        let Some(search) = &mut self.search else { return Ok(None) };
        let depth = search.depth();
        let wanted = board.wants_longer(depth) && search.can_deepen() && depth < LONGEST;
        Ok(wanted.then(|| Batch::Pushes(board.deepen(search))))
    }
}
