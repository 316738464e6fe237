//! One batch of candidates: refinement, verification of the best in small groups, and retries.

use crate::plan::{Candidate, Refined, in_order, is_behind};
use crate::task::{Goal, Job};
use crate::watch::Instant;

use super::arm_feasibility::arm_fault;
use super::attempts::Attempt;
use super::blackboard::{Blackboard, Candidates};
use super::grade::Class;
use super::rank::is_worth_verifying;
use super::retry::retry;
use super::typical::error_p95;

/// Maximum share of the plans of one length that are replayed with perturbations: where so many work and
/// none is safe, the task is a fragile one, and these replays are most of its cost.
const PERTURBED_SHARE: f64 = 0.375;

/// Refines and verifies candidates until one is safe, then replays the best until its verdict is clear.
pub(super) fn try_out(board: &mut Blackboard, candidates: Candidates) {
    refine_and_verify(board, &candidates);
    let began = Instant::now();
    board.verification.settle(&mut board.attempts, Class::Edge);
    board.timing.verification += began.elapsed().as_secs_f64();
    if candidates.hardenable {
        board.searched = Some(candidates);
    }
}

fn refine_and_verify(board: &mut Blackboard, candidates: &Candidates) {
    let Candidates { found, pushes, .. } = candidates;
    let (query, settings) = (board.query, *board.query.planner.settings());
    let began = Instant::now();
    let at_once = query.at_once();
    let most = settings.verified_at_once.max(1) * settings.verify_batches;
    let chosen = board.attempts.choose(found, settings.refined, &[], at_once);
    let most_perturbed = (PERTURBED_SHARE * most as f64).ceil() as usize;
    let before = board.verification.perturbed;
    let first = board.attempts.list.len();
    let mut queue = refined(board, &chosen, &query.goals(), *pushes);
    board.timing.refinement += began.elapsed().as_secs_f64();
    board.progress.refined(queue.first().map(|&k| &board.attempts.list[k]));

    let mut failed = Vec::new();
    for batch in 0..most.div_ceil(at_once) {
        if batch > 0 {
            let began = Instant::now();
            retry(board, &mut queue, &failed, candidates, first);
            board.timing.refinement += began.elapsed().as_secs_f64();
        }
        let indices: Vec<usize> = queue.drain(..queue.len().min(at_once)).collect();
        let Some(&leader) = indices.first() else { break };
        if query.watch.cancelled() {
            break;
        }
        let began = Instant::now();
        board.progress.stage_of("verify", *pushes);
        query.watch.progress((batch * at_once) as u64, most as u64);
        board.verification.verify(&mut board.attempts, &indices);
        board.timing.verification += began.elapsed().as_secs_f64();
        board.progress.replayed(&board.attempts);
        let safe = board.attempts.best_class() == Class::Safe;
        let enough = board.verification.perturbed - before >= most_perturbed;
        // Where even the most promising plan leads through a wall, a few attempts are enough.
        let behind = is_behind(board.attempts.list[leader].score);
        if board.verification.promising.is_some() || safe || enough || behind {
            break;
        }
        failed = indices;
    }
}

/// Refines candidates towards `aims`, the task's goals or some next to them, keeps the results as attempts,
/// and returns the indices of those worth verifying, best first.
pub(super) fn refined(
    board: &mut Blackboard,
    candidates: &[Candidate],
    aims: &[Goal],
    pushes: usize,
) -> Vec<usize> {
    board.progress.stage_of("refine", pushes);
    let refined = board.refiner.refine(&board.query, candidates, aims, pushes);
    keep(board, refined, aims)
}

/// Refines changed candidates of plans that were replayed already, as [`refined`] does.
pub(super) fn refined_again(
    board: &mut Blackboard,
    candidates: &[Candidate],
    aims: &[Goal],
    pushes: usize,
) -> Vec<usize> {
    board.progress.stage_of("refine", pushes);
    let refined = board.refiner.refine_again(&board.query, candidates, aims, pushes);
    keep(board, refined, aims)
}

/// Keeps what was refined towards `aims`; the indices of those worth verifying, best first.
fn keep(board: &mut Blackboard, mut refined: Vec<Refined>, aims: &[Goal]) -> Vec<usize> {
    let query = board.query;
    let (workspace, situation, model) = (query.workspace(), query.situation, query.planner.model());
    in_order(&mut refined, &workspace, situation);
    let aimed = query.task.aiming(aims);
    let mut worth = Vec::new();
    for refined in refined {
        // The network's prediction for this very push, or else what was measured of many.
        let spread = refined.best.spread.map(|spread| spread.within_90().position);
        let error = spread.or_else(|| {
            let motions = refined.best.motions(&workspace);
            let jobs = Job::sequence(situation, &motions).into_iter();
            let errors = jobs.map(|job| error_p95(model, situation, &job));
            errors.collect::<Option<Vec<f64>>>().map(|all| all.into_iter().fold(0.0, f64::max))
        });
        let mut is_worth = is_worth_verifying(&aimed, &refined.best, error);
        if is_worth && let Some(fault) = arm_fault(&query, &refined.best) {
            board.attempts.arm_fault.get_or_insert(fault);
            is_worth = false;
        }
        let k = board.attempts.push(Attempt::refined(&query, refined, aims));
        if is_worth {
            worth.push(k);
        }
    }
    worth
}
