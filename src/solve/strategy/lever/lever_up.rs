//! Single lever-ups.

use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};

use super::prefix::Prefix;
use super::search::lever_ups;

/// Strategy that searches lever-ups of the task once.
#[derive(Default)]
pub(in crate::solve::strategy) struct LeverUp {
    begun: bool,
}

impl<'a> Strategy<'a> for LeverUp {
    fn name(&self) -> &'static str {
        "lever up"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        if self.begun {
            return Ok(None);
        }
        self.begun = true;
        Ok(Some(Batch::Levers(lever_ups(board, board.query.task, &Prefix::default()))))
    }
}
