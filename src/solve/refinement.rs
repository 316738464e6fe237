//! Refined candidates as attempts, and selection of the attempts worth verifying.

use crate::plan::{Candidate, Refined, in_order};
use crate::task::{Goal, Job};

use super::arm_feasibility::arm_fault;
use super::attempts::Attempt;
use super::blackboard::Blackboard;
use super::rank::is_worth_verifying;
use super::typical::error_p95;

/// Refines candidates towards `aims` (the task's goals or shifted ones) and stores the results as
/// attempts. Returns the indices of the attempts worth verifying, best first.
pub(super) fn refined(
    board: &mut Blackboard,
    candidates: &[Candidate],
    aims: &[Goal],
    pushes: usize,
) -> Vec<usize> {
    board.reporter.stage_of("refine", pushes);
    let refined = board.refiner.refine(&board.query, candidates, aims, pushes);
    keep(board, refined, aims)
}

/// Stores candidates refined towards `aims` and returns the indices of the attempts worth
/// verifying, best first.
fn keep(board: &mut Blackboard, mut refined: Vec<Refined>, aims: &[Goal]) -> Vec<usize> {
    let query = board.query;
    let (workspace, situation, model) = (query.workspace(), query.situation, query.planner.model());
    in_order(&mut refined, &workspace, situation);
    let aimed = query.task.with_goals(aims);
    let mut worth = Vec::new();
    for refined in refined {
        // Error predicted by the network for this push, otherwise the measured error of many
        // pushes.
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
