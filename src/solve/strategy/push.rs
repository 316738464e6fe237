//! Plans with one grip, one push longer in each turn.

use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};

/// Maximum number of pushes of searched plans, because the cost grows with every push. Longer plans
/// are only made along legs of transport.
pub(super) const LONGEST: usize = 8;

/// Strategy that deepens the search on the blackboard.
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
