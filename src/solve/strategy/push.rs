//! Plans with one grip: of one push, then of one more.

use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};

/// Plans of more pushes are not searched for, only made after legs: they cost more with every push.
const LONGEST: usize = 8;

/// Deepens the search on the blackboard.
pub(super) struct Push;

impl<'a> Strategy<'a> for Push {
    fn name(&self) -> &'static str {
        "push"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(mut search) = board.search.take() else { return Ok(None) };
        let depth = search.depth();
        let wanted = board.wants_longer(depth) && search.can_deepen() && depth < LONGEST;
        let batch = wanted.then(|| Batch::Pushes(board.deepen(&mut search)));
        board.search = Some(search);
        Ok(batch)
    }
}
