//! Trial of a batch of candidates: refinement, verification of the best in small groups, and
//! retries.

use crate::plan::is_behind;
use crate::progress::Instant;

use super::blackboard::Blackboard;
use super::candidates::Candidates;
use super::grade::Class;
use super::refinement::refined;
use super::retry::retry;

/// Maximum share of the plans of one length that are replayed with perturbations. If this many
/// plans work and none is safe, the task is fragile and these replays are most of its cost.
const PERTURBED_SHARE: f64 = 0.375;

/// Refines and verifies candidates until one is safe, then replays the best until its verdict is
/// clear.
pub(super) fn try_out(board: &mut Blackboard, candidates: Candidates) {
    refine_and_verify(board, &candidates);
    let began = Instant::now();
    board.verification.settle(&mut board.attempts, Class::Forced);
    board.timing.verification += began.elapsed().as_secs_f64();
    if candidates.hardenable {
        board.searched = Some(candidates);
    }
}

fn refine_and_verify(board: &mut Blackboard, candidates: &Candidates) {
    let Candidates { found, pushes, .. } = candidates;
    let (query, settings) = (board.query, board.query.settings);
    let began = Instant::now();
    let at_once = query.at_once();
    let most = settings.verified_at_once.max(1) * settings.verify_batches;
    let chosen = board.attempts.choose(found, settings.refined, &[], at_once);
    let most_perturbed = (PERTURBED_SHARE * most as f64).ceil() as usize;
    let before = board.verification.perturbed;
    let first = board.attempts.list.len();
    let mut queue = refined(board, &chosen, &query.goals(), *pushes);
    board.timing.refinement += began.elapsed().as_secs_f64();
    board.reporter.refined(queue.first().map(|&k| &board.attempts.list[k]));

    let mut failed = Vec::new();
    for batch in 0..most.div_ceil(at_once) {
        if batch > 0 {
            let began = Instant::now();
            retry(board, &mut queue, &failed, candidates, first);
            board.timing.refinement += began.elapsed().as_secs_f64();
        }
        let indices: Vec<usize> = queue.drain(..queue.len().min(at_once)).collect();
        let Some(&leader) = indices.first() else { break };
        if query.progress.cancelled() {
            break;
        }
        let began = Instant::now();
        board.reporter.stage_of("verify", *pushes);
        query.progress.update((batch * at_once) as u64, most as u64);
        board.verification.verify(&mut board.attempts, &indices);
        board.timing.verification += began.elapsed().as_secs_f64();
        board.reporter.replayed(&board.attempts);
        let safe = board.attempts.best_class() == Class::Safe;
        let enough = board.verification.perturbed - before >= most_perturbed;
        // If even the most promising plan is blocked, a few attempts suffice.
        let behind = is_behind(board.attempts.list[leader].score);
        let heavy = board.attempts.all_too_heavy();
        if board.verification.promising.is_some() || safe || enough || behind || heavy {
            break;
        }
        failed = indices;
    }
}
