//! Hardening of plans against unknown support, if the best plan works, but not nearly always.

use crate::plan::{HardenSettings, harden};
use crate::progress::Instant;
use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::candidates::Candidates;
use crate::solve::grade::{Class, Grade};
use crate::solve::solving::{Batch, Strategy};

/// Seed bit that separates the samples of hardening from the samples of refinement.
const HARDENING: u64 = 1 << 14;

/// Maximum number of rollouts for each one of the search.
const ROLLOUTS: usize = 10;

/// Strategy that varies the results of the last search once.
pub(super) struct Harden;

impl<'a> Strategy<'a> for Harden {
    fn name(&self) -> &'static str {
        "harden"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(Candidates { found, pushes, .. }) = board.searched.take() else { return Ok(None) };
        let shaky = |(grade, _): &(Grade, usize)| grade.class > Class::Fails && !grade.is_steady();
        let query = board.query;
        if query.progress.cancelled() || !board.attempts.best.as_ref().is_some_and(shaky) {
            return Ok(None);
        }
        board.reporter.stage_of("search", pushes);
        let began = Instant::now();
        let settings = HardenSettings {
            kinds: 2 * query.settings.refined,
            rollouts: query.refine_rollouts().min(ROLLOUTS * query.settings.search_rollouts),
            seed: query.refine_settings(pushes).seed ^ HARDENING,
        };
        let rollouts = &mut board.refiner.rollouts;
        let found = harden(&query.workspace(), rollouts, &found, settings, query.progress);
        board.timing.search += began.elapsed().as_secs_f64();
        Ok(Some(Batch::Pushes(Candidates { found, pushes, hardenable: false })))
    }
}
