//! Main loop of the planner: in each turn, the first strategy with a next step proposes a batch,
//! until no strategy has one.

use super::SolveError;
use super::blackboard::Blackboard;
use super::candidates::Candidates;
use super::lever_batch::{LeverBatch, verify_plans};
use super::try_out::try_out;

/// Strategy that proposes plans. Strategies share only the blackboard.
pub(super) trait Strategy<'a> {
    /// Returns the strategy's name in progress reports.
    fn name(&self) -> &'static str;

    /// Returns the next batch to try, or `None` while the strategy has no next step for this state
    /// of the board.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError>;
}

/// Batch of plans to try together.
pub(super) enum Batch {
    /// Pushes that need refinement first.
    Pushes(Candidates),
    /// Complete plans that leave the plane.
    Levers(LeverBatch),
}

/// Tries the batches of `strategies`, which are in order of precedence.
///
/// # Errors
/// Returns [`SolveError`] for invalid input only.
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
        board.reporter.strategy = strategy.name();
        if let Some(batch) = strategy.next(board)? {
            return Ok(Some(batch));
        }
    }
    Ok(None)
}
