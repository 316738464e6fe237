//! Verification of complete plans with lever-ups, in groups of different kinds, until a plan
//! passes.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::outcome::Verdict;
use crate::progress::Instant;
use crate::task::Task;

use super::attempts::{Attempt, Replays};
use super::blackboard::Blackboard;

/// Plans to verify, best first.
pub(super) type LeverBatch = Vec<LeverPlan>;

/// Plan that contains a lever-up.
pub(super) struct LeverPlan {
    pub attempt: Attempt,
    pub kind: Kind,
    /// Whether the prediction makes the plan worth verifying.
    pub promising: bool,
}

/// Tool, edge, axis and angle of a lever-up. Candidates that share them are likely to fail
/// together.
pub(super) type Kind = (usize, usize, usize, usize);

/// Verifies a batch for the task's goal, and stores all its plans as attempts.
pub(super) fn verify_plans(board: &mut Blackboard, mut batch: LeverBatch) {
    verify_in_groups(board, board.query.task, &mut batch);
    board.attempts.list.extend(batch.into_iter().map(|plan| plan.attempt));
    board.attempts.best = board.attempts.graded_best();
}

/// Verifies the promising plans in groups for the goal of `task`, until one passes.
pub(super) fn verify_in_groups(board: &mut Blackboard, task: &Task, plans: &mut [LeverPlan]) {
    let began = Instant::now();
    board.reporter.stage("verify lever-ups");
    let settings = board.query.settings.levers;
    let kinds: Vec<Kind> = plans.iter().map(|plan| plan.kind).collect();
    let mut promising: Vec<usize> = (0..plans.len()).filter(|&k| plans[k].promising).collect();
    let mut verified: Vec<usize> = Vec::new();
    let at_once = settings.verified_at_once.max(1);
    for round in 1..=settings.verify_batches {
        // The cause of a failure is often common to its kind.
        let group = mixed(&promising, &kinds, &verified, 2 * round, at_once);
        if group.is_empty() || board.query.progress.cancelled() {
            break;
        }
        promising.retain(|k| !group.contains(k));
        verified.extend(&group);
        let verification = &board.verification;
        let verdicts: Vec<Verdict> =
            group.par_iter().map(|&k| verification.verdict(task, &plans[k].attempt)).collect();
        board.verification.verified += group.len();
        let passed = verdicts.iter().any(|verdict| verdict.passed);
        for (&k, verdict) in group.iter().zip(verdicts) {
            let attempt = &mut plans[k].attempt;
            (attempt.verdict, attempt.replays) = (Some(verdict), Replays::InBoth);
        }
        if passed {
            break;
        }
    }
    board.timing.verification += began.elapsed().as_secs_f64();
}

/// Returns the first `wanted` plans of `from`. As long as there are other kinds, no kind has more
/// than `most` plans, including the plans in `verified`.
pub(super) fn mixed(
    from: &[usize],
    kinds: &[Kind],
    verified: &[usize],
    most: usize,
    wanted: usize,
) -> Vec<usize> {
    let mut counts: HashMap<Kind, usize> = HashMap::new();
    for &k in verified {
        *counts.entry(kinds[k]).or_default() += 1;
    }
    let (mut first, mut later) = (Vec::new(), Vec::new());
    for &k in from {
        let count = counts.entry(kinds[k]).or_default();
        *count += 1;
        if *count <= most { first.push(k) } else { later.push(k) }
    }
    first.extend(later);
    first.truncate(wanted);
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_of_different_kinds_while_there_are_some() {
        let kinds = [0, 0, 0, 1, 0, 2].map(|turn| (0, 0, 0, turn));
        let all = [0, 1, 2, 3, 4, 5];
        assert_eq!(mixed(&all, &kinds, &[], 2, 4), [0, 1, 3, 5]);
        assert_eq!(mixed(&[2, 4, 5], &kinds, &[0, 1, 3], 2, 2), [5, 2]);
        assert_eq!(mixed(&all, &kinds, &[], 1, 9), [0, 3, 5, 1, 2, 4]);
    }
}
