//! The loop of solving: the first strategy that has something to try has its turn, until none has.

use super::SolveError;
use super::blackboard::{Blackboard, Candidates};
use super::lever_batch::{LeverBatch, verify_plans};
use super::try_out::try_out;

/// A way to come to plans. Strategies share nothing but the blackboard.
pub(super) trait Strategy<'a> {
    /// Returns its name in progress reports.
    fn name(&self) -> &'static str;

    /// Returns what to try next, or `None` as long as it has nothing to add to the board.
    ///
    /// # Errors
    /// [`SolveError`] for bad input only.
    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError>;
}

/// Plans to try together.
pub(super) enum Batch {
    /// Pushes, to be refined first.
    Pushes(Candidates),
    /// Complete plans that leave the plane.
    Levers(LeverBatch),
}

/// Tries the batches of `strategies`, which stand in order of precedence.
///
/// # Errors
/// [`SolveError`] for bad input only.
pub(super) fn run<'a>(
    board: &mut Blackboard<'a>,
    strategies: &mut [Box<dyn Strategy<'a> + 'a>],
) -> Result<(), SolveError> {
    while let Some(batch) = next(board, strategies)? {
        match batch {
            Batch::Pushes(candidates) => try_out(board, candidates),
            Batch::Levers(batch) => verify_plans(board, batch),
        }
    }
    Ok(())
}

fn next<'a>(
    board: &mut Blackboard<'a>,
    strategies: &mut [Box<dyn Strategy<'a> + 'a>],
) -> Result<Option<Batch>, SolveError> {
    for strategy in strategies {
        board.progress.strategy = strategy.name();
        if let Some(batch) = strategy.next(board)? {
            return Ok(Some(batch));
        }
    }
    Ok(None)
}
