//! Retries after failed replays. Refuted patterns of pushes are avoided, and plans that end near
//! the goal are aimed again, corrected by their error.

use std::sync::Arc;

use crate::geometry::Vector;
use crate::outcome::{Verdict, Warning};
use crate::plan::is_behind;
use crate::scene::{Engine, Tool};
use crate::task::{Demand, End, Goal, Task};

use super::attempts::{Attempt, Attempts, Replays};
use super::blackboard::Blackboard;
use super::candidates::Candidates;
use super::pattern::PushPattern;
use super::refinement::refined;

/// Error of a replay in tolerances above which a plan is refuted. With a smaller error it may work
/// with another tool.
const REFUTED: f64 = 1.25;

/// Maximum error of a replay in tolerances for which a plan is aimed again. Beyond it the
/// prediction is wrong in kind, and a shifted aim has other effects.
const NEAR: f64 = 4.0;

/// Mean error in tolerances below which a plan cannot be aimed better.
const ON_THE_GOAL: f64 = 0.1;

/// Minimum room of a push after its tool came down on the object, metres.
const LEAST_ROOM: f64 = 0.01;

/// Maximum room of a push after its tool came down on the object, metres.
const MOST_ROOM: f64 = 0.04;

/// Reorders the queue of plans of one length after the plans `failed` did not pass or were not
/// safe. `first` is the first plan of this length.
///
/// Failed plans that reached the goal before their last push come first, without that push. They
/// are followed by plans whose tool came down on an object, set down farther away, and by near
/// plans aimed again. Other patterns are next, with newly refined ones if too few are left, and the
/// rest comes last.
pub(super) fn retry(
    board: &mut Blackboard,
    queue: &mut Vec<usize>,
    failed: &[usize],
    candidates: &Candidates,
    first: usize,
) {
    let Candidates { found, pushes, .. } = candidates;
    let query = board.query;
    refute(query.task, &mut board.attempts, failed);
    let at_once = query.at_once();
    let mut next = shortened(board, failed);
    next.extend(set_down_farther(board, failed, *pushes));
    next.extend(aim_again(board, failed, at_once.div_ceil(2), *pushes));
    let (fresh, rest): (Vec<usize>, Vec<usize>) = queue.iter().partition(|&&k| {
        let candidate = board.attempts.list[k].candidate.as_ref();
        candidate.is_some_and(|candidate| !board.attempts.is_refuted(candidate))
    });
    next.extend(fresh);
    let missing = at_once.saturating_sub(next.len());
    if missing > 0 {
        let attempts = &board.attempts;
        let known = attempts.list[first..].iter().filter_map(|one| one.candidate.as_ref());
        let others = attempts.choose(found, missing, &known.collect::<Vec<_>>(), at_once);
        next.extend(refined(board, &others, &query.goals(), *pushes));
    }
    next.extend(rest);
    // The sort is stable: blocked plans go last, and all others keep their order.
    next.sort_by_key(|&k| is_behind(board.attempts.list[k].score));
    *queue = next;
}

/// Records the patterns of failed plans whose replays missed the goal by a large distance.
fn refute(task: &Task, attempts: &mut Attempts, failed: &[usize]) {
    for &k in failed {
        let attempt = &attempts.list[k];
        if replayed_error(task, attempt) > REFUTED
            && let Some(candidate) = &attempt.candidate
        {
            attempts.refuted.push(PushPattern::of(&candidate.pushes));
        }
    }
}

/// Returns the plans that reached the goal in both engines before their last push, without the
/// later pushes.
fn shortened(board: &mut Blackboard, failed: &[usize]) -> Vec<usize> {
    let (task, placed) = (board.query.task, board.query.workspace().is_placed());
    let mut next = Vec::new();
    for &k in failed {
        let attempt = &board.attempts.list[k];
        let (Some(candidate), Some(verdict)) = (&attempt.candidate, &attempt.verdict) else {
            continue;
        };
        let reached = |count: usize| {
            Engine::ALL.into_iter().all(|engine| {
                let frames = verdict.nominal(engine).and_then(|e| e.trajectory.as_ref());
                let mut frames = frames.iter().flat_map(|t| t.frames.iter().rev());
                let end = frames.find(|frame| frame.stroke + 1 == count);
                end.is_some_and(|frame| task.reached(&frame.state))
            })
        };
        let count = (1..attempt.plan.pushes().len()).find(|&count| placed && reached(count));
        let Some(count) = count else { continue };
        let mut candidate = candidate.clone();
        candidate.pushes.truncate(count);
        let plan = attempt.plan.first(count);
        let known = board.attempts.list.iter().any(|attempt| attempt.plan == plan);
        if !known {
            let named = |tool: &&Arc<Tool>| plan.tools().contains(&tool.name.as_str());
            let shorter = Attempt {
                tools: attempt.tools.iter().filter(named).cloned().collect(),
                plan,
                candidate: Some(candidate),
                aims: attempt.aims.clone(),
                refinement: attempt.refinement.clone(),
                prediction: None,
                verdict: None,
                replays: Replays::None,
                ..*attempt
            };
            next.push(board.attempts.push(shorter));
        }
    }
    next
}

/// Returns the plans whose tool came down on an object for a later push, with more room there.
fn set_down_farther(board: &mut Blackboard, failed: &[usize], pushes: usize) -> Vec<usize> {
    let mut wider = Vec::new();
    for &k in failed {
        let attempt = &board.attempts.list[k];
        let (Some(candidate), Some(verdict)) = (&attempt.candidate, &attempt.verdict) else {
            continue;
        };
        let landed = verdict.evidence.iter().find_map(|evidence| match evidence.fault() {
            Some(Warning::SetDownOn { stroke, .. }) if *stroke > 0 => Some(*stroke),
            _ => None,
        });
        let mut candidate = candidate.clone();
        if let Some(push) = landed.and_then(|stroke| candidate.pushes.get_mut(stroke))
            && push.room < MOST_ROOM
        {
            push.room = (2.0 * push.room).clamp(LEAST_ROOM, MOST_ROOM);
            wider.push(candidate);
        }
    }
    let goals = board.query.goals();
    match wider.is_empty() {
        true => Vec::new(),
        false => refined(board, &wider, &goals, pushes),
    }
}

/// Refines the nearest failed plans towards aims that are shifted against the mean error of their
/// replays.
fn aim_again(board: &mut Blackboard, failed: &[usize], count: usize, pushes: usize) -> Vec<usize> {
    let task = board.query.task;
    let mut near: Vec<(f64, usize)> = failed
        .iter()
        .map(|&k| (replayed_error(task, &board.attempts.list[k]), k))
        .filter(|(error, _)| *error <= NEAR)
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut next = Vec::new();
    for (_, k) in near.into_iter().take(count) {
        let attempt = &board.attempts.list[k];
        let (Some(candidate), Some(verdict)) = (attempt.candidate.clone(), &attempt.verdict) else {
            continue;
        };
        let aims = task.goals.iter().zip(&attempt.aims);
        let next_aims: Vec<Option<Goal>> =
            aims.clone().map(|(goal, aimed)| aim(goal, aimed, verdict)).collect();
        if next_aims.iter().any(Option::is_some) {
            let kept =
                aims.zip(next_aims).map(|((_, aimed), next)| next.unwrap_or_else(|| aimed.clone()));
            let kept: Vec<Goal> = kept.collect();
            next.extend(refined(board, &[candidate], &kept, pushes));
        }
    }
    next
}

/// Returns the error of a plan as written in tolerances, in the engine where it is larger. The
/// error is infinite if the outcome is invalid.
pub(super) fn replayed_error(task: &Task, attempt: &Attempt) -> f64 {
    let Some(verdict) = &attempt.verdict else { return f64::INFINITY };
    if !verdict.forbidden.is_empty() {
        return f64::INFINITY;
    }
    let missed = |engine| {
        let nominal = verdict.nominal(engine).filter(|evidence| evidence.fault().is_none());
        let score = nominal.map(|evidence| task.score(&evidence.outcome.state));
        score.filter(|score| score.is_finite()).unwrap_or(f64::INFINITY)
    };
    Engine::ALL.into_iter().map(missed).fold(0.0, f64::max)
}

/// Returns the next aim after a plan aimed at `aim` missed the goal, shifted against the mean error
/// of each demand. This is one step of iterative learning control (Arimoto et al. 1984,
/// doi:10.1002/rob.4620010203) with the effect model's slopes, for the mean end of all replays in
/// both engines. Returns `None` if the plan already ends on the goal.
fn aim(goal: &Goal, aim: &Goal, verdict: &Verdict) -> Option<Goal> {
    let found = goal.demands.iter().zip(&aim.demands).map(|(demand, aim)| {
        let (shift, turn) = mean_miss(goal.object, demand, verdict)?;
        // The correction starts from the last aim.
        let next = demand.kind().aimed(aim, shift, turn);
        let [place, angle] = [demand.kind().tolerance(), demand.kind().turn_tolerance()];
        let off = angle.map_or(0.0, |tolerance| turn.abs() / tolerance);
        Some((next, off.max(place.map_or(0.0, |tolerance| shift.norm() / tolerance))))
    });
    let found: Vec<(Demand, f64)> = found.collect::<Option<_>>()?;
    let off = found.iter().map(|(_, off)| *off).fold(0.0, f64::max);
    let demands = found.into_iter().map(|(next, _)| next).collect();
    (off > ON_THE_GOAL).then_some(Goal { demands, ..*goal })
}

/// Returns the mean offset from a demand in its own frame, metres, and the mean rotation, radians,
/// of the valid replays, each engine with equal weight. Returns `None` without valid replays.
fn mean_miss(object: usize, demand: &Demand, verdict: &Verdict) -> Option<(Vector, f64)> {
    let (mut shift, mut turn, mut engines) = (Vector::zeros(), 0.0, 0.0);
    for engine in Engine::ALL {
        let all = verdict.nominal(engine).into_iter().chain(verdict.perturbed(engine));
        let ends: Vec<End> = all
            .filter(|evidence| evidence.fault().is_none())
            .map(|evidence| End::resting(object, &evidence.outcome.state))
            .collect();
        if !ends.is_empty() {
            let count = ends.len() as f64;
            shift += ends.iter().filter_map(|end| demand.off_as_seen(end)).sum::<Vector>() / count;
            turn += ends.iter().filter_map(|end| demand.kind().turned(end)).sum::<f64>() / count;
            engines += 1.0;
        }
    }
    (engines > 0.0).then(|| (shift / engines, turn / engines))
}

#[cfg(test)]
mod tests;
