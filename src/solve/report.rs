//! Solution from ranked attempts.

use std::sync::Arc;

use crate::outcome::{Verdict, Warning};
use crate::plan::{Search, bare};
use crate::progress::Instant;
use crate::scene::{Engine, Tool};
use crate::sim::LeverSimulator;
use crate::task::{Plan, Step};

use super::arm_feasibility::joints;
use super::attempts::Attempt;
use super::blackboard::Blackboard;
use super::infeasibility::Cause;
use super::query::Query;
use super::solution::{LeverStatistics, PlanStatus, RankedPlan, Solution, Statistics};

/// Maximum number of returned plans: as many as a reader examines.
const REPORTED: usize = 8;

/// Minimum improvement of the distance to the goal by a reported plan without success, metres:
/// simulations differ by as much.
const NEARER: f64 = 0.01;

/// Minimum improvement of the heading by a reported plan without success, radians.
const TURNED: f64 = 0.1;

/// Returns the solution with the ranked attempts of a blackboard. `began` is the time at which
/// solving began.
pub(super) fn solution(mut board: Blackboard, began: Instant) -> Solution {
    let (query, status) = (board.query, board.status());
    let attempts = match board.levers {
        None => ranked_pushes(&mut board, status),
        Some(_) => ranked_levers(&mut board),
    };
    let (plans, warnings) = predicted(&query, attempts);
    let mut statistics = match board.levers.take() {
        None => push_statistics(&board, plans.len()),
        Some(levers) => lever_statistics(&board, levers, &plans),
    };
    statistics.timing.total = began.elapsed().as_secs_f64();
    let fault = board.attempts.arm_fault.filter(|_| status == PlanStatus::NoPlan);
    Solution {
        status,
        stopped: query.progress.cancelled(),
        model: match statistics.levers {
            None => query.planner.model().spec().clone(),
            // Lever-ups are ranked by the coarse simulation.
            Some(_) => LeverSimulator::COARSE.spec(),
        },
        plans,
        tools: query.tools.iter().map(|tool| Tool::clone(tool)).collect(),
        candidates: board.search.map_or_else(Vec::new, |search| search.scored().to_vec()),
        statistics,
        partial: None,
        cause: fault.map(|fault| Cause::Arm { fault }),
        warnings,
    }
}

/// Orders plans of pushes: the best plan, then passed, untried and failed ones. If none passed,
/// verified plans come before untried ones.
fn ranked_pushes(board: &mut Blackboard, status: PlanStatus) -> Vec<Attempt> {
    let best = board.attempts.best.filter(|_| board.attempts.nominal_ok()).map(|(_, k)| k);
    let rank = |index: usize, attempt: &Attempt| match (&attempt.verdict, status) {
        _ if Some(index) == best => 0,
        (Some(verdict), PlanStatus::Solved) => {
            if verdict.passed {
                1
            } else {
                3
            }
        }
        (Some(_), _) => 1,
        (None, _) => 2,
    };
    let nearest = status == PlanStatus::NoPlan;
    let query = board.query;
    let mut order: Vec<(usize, Attempt)> = std::mem::take(&mut board.attempts.list)
        .into_iter()
        .enumerate()
        .filter(|(_, attempt)| !nearest || attempt.plan.is_empty() || is_nearer(&query, attempt))
        .map(|(index, attempt)| (rank(index, &attempt), attempt))
        .collect();
    order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.score.total_cmp(&b.1.score)));
    order.truncate(REPORTED);
    order.into_iter().map(|(_, attempt)| attempt).collect()
}

/// Orders plans that leave the plane: working plans by their success rate, then failed ones, then
/// the rest. Among ties, plans with pushes after a lever-up come first, because they are only made
/// if no lever-up alone passes.
fn ranked_levers(board: &mut Blackboard) -> Vec<Attempt> {
    let mut order = std::mem::take(&mut board.attempts.list);
    let pushes_last = |attempt: &Attempt| {
        attempt.plan.steps.last().is_some_and(|step| matches!(step, Step::Push(_)))
    };
    order.sort_by(|a, b| {
        let evidence = b.evidence().total_cmp(&a.evidence());
        evidence.then(pushes_last(b).cmp(&pushes_last(a)))
    });
    order.truncate(REPORTED);
    order
}

/// Returns the attempts as plans with their predictions, and the warnings of the first plan.
fn predicted(query: &Query, attempts: Vec<Attempt>) -> (Vec<RankedPlan>, Vec<Warning>) {
    let (task, situation) = (query.task, query.situation);
    let pushes: Vec<(&Plan, &[Arc<Tool>])> = attempts
        .iter()
        .filter(|attempt| attempt.prediction.is_none())
        .map(|attempt| (&attempt.plan, &attempt.tools[..]))
        .collect();
    let mut predictions = query.planner.predict_all(task, situation, &pushes).into_iter();
    let mut first = None;
    let mut plans = Vec::new();
    for attempt in attempts {
        let (predicted, outcome, warnings) = match attempt.prediction {
            Some((trajectory, outcome)) => (trajectory, outcome, Vec::new()),
            None => {
                let Some(one) = predictions.next() else { continue };
                (one.trajectory, one.outcome, one.warnings)
            }
        };
        first.get_or_insert_with(|| [pressing(attempt.verdict.as_ref()), warnings].concat());
        let mut ranked = RankedPlan {
            plan: attempt.plan,
            tools: attempt.tools,
            predicted,
            outcome,
            verdict: attempt.verdict,
            refinement: attempt.refinement,
            joints: None,
        };
        ranked.joints = joints(query, &ranked);
        plans.push(ranked);
    }
    (plans, first.unwrap_or_default())
}

/// Returns the warnings of a plan's nominal replays that the tool presses hard or that an object
/// ends near the edge of the table; of each kind the one with the largest force.
fn pressing(verdict: Option<&Verdict>) -> Vec<Warning> {
    let force = |warning: &Warning| match warning {
        Warning::HardPush { needed } | Warning::Squeezed { needed, .. } => *needed,
        _ => 0.0,
    };
    let nominal = Engine::ALL.into_iter().filter_map(|engine| verdict?.nominal(engine));
    let mut found: Vec<Warning> = Vec::new();
    for warning in nominal.flat_map(|evidence| &evidence.warnings) {
        let reported = warning.presses() || matches!(warning, Warning::NearEdge { .. });
        match found.iter_mut().find(|known| known.is_like(warning)) {
            Some(known) if force(known) < force(warning) => *known = warning.clone(),
            None if reported => found.push(warning.clone()),
            _ => (),
        }
    }
    found
}

/// Returns `true` if a plan is predicted to be clearly better than the plan without steps.
fn is_nearer(query: &Query, attempt: &Attempt) -> bool {
    let (task, start) = (query.task, &query.situation.start);
    // The goal with the smallest required improvement counts, because scores are in units of
    // tolerances.
    let kinds = task.goals.iter().flat_map(|goal| &goal.demands).map(|demand| demand.kind());
    let least = kinds.flat_map(|kind| {
        let nearer = kind.tolerance().map(|tolerance| NEARER / tolerance);
        let turned = kind.turn_tolerance().map(|tolerance| TURNED / tolerance);
        nearer.into_iter().chain(turned)
    });
    let least = least.fold(f64::INFINITY, f64::min);
    bare(attempt.score) <= task.score(start) - least
}

fn push_statistics(board: &Blackboard, plans: usize) -> Statistics {
    let search = board.search.as_ref();
    Statistics {
        search: board.all.statistics(search),
        refinement: board.refiner.statistics.clone(),
        rollouts: plans + board.refiner.rollouts.used(),
        verified: board.verification.verified,
        depth: search.map_or(0, Search::depth),
        escalated: board.all.used,
        timing: board.timing,
        levers: None,
    }
}

fn lever_statistics(
    board: &Blackboard,
    mut levers: LeverStatistics,
    plans: &[RankedPlan],
) -> Statistics {
    levers.verified = board.verification.verified;
    Statistics {
        rollouts: levers.search.rollouts,
        verified: levers.verified,
        depth: plans.first().map_or(0, |best| best.plan.steps.len()),
        timing: board.timing,
        levers: Some(levers),
        ..Statistics::default()
    }
}
