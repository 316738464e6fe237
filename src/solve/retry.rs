//! Retries after failed replays: refuted patterns of pushes are left for others, and plans that
//! end near the goal are aimed again, by as much as they missed it.

use std::sync::Arc;

use crate::geometry::Vector;
use crate::outcome::{Verdict, Warning};
use crate::plan::is_behind;
use crate::scene::{Engine, Tool};
use crate::task::{Demand, End, Goal, Task};

use super::attempts::{Attempt, Attempts, Replays};
use super::blackboard::{Blackboard, Candidates};
use super::pattern::PushPattern;
use super::refinement::{refined, refined_again};

/// A plan is refuted if its replay misses the goal by more than this many tolerances: one that
/// misses by less may work with another tool.
const REFUTED: f64 = 1.25;

/// A plan is aimed again if its replay misses the goal by at most this many tolerances. Farther
/// out the prediction is wrong in kind, and shifting the aim shifts something else.
const NEAR: f64 = 4.0;

/// A plan that ends within this share of the tolerance on average cannot be aimed better.
const ON_THE_GOAL: f64 = 0.1;

/// Room that a push gets after its tool came down on the object, metres.
const LEAST_ROOM: f64 = 0.01;
const MOST_ROOM: f64 = 0.04;

/// Reorders the queue of plans of one length after the plans `failed` did not pass, or were not
/// safe: first those of them that reached the goal before their last push, without it; those
/// whose tool came down on an object, set down farther away; those that came near, aimed
/// again; then other patterns, of which new ones are refined where too few are left; then the
/// rest. `first` is the first plan of this length.
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
    // Stable: plans through a wall go last, everything else keeps its order.
    next.sort_by_key(|&k| is_behind(board.attempts.list[k].score));
    *queue = next;
}

/// Notes the patterns of failed plans whose replays missed the goal by far.
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

/// Plans that reached the goal after an earlier push than the last, in both engines, without
/// the pushes that spoiled it.
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

/// Plans whose tool came down on an object for a later push, with more room there.
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
        false => refined_again(board, &wider, &goals, pushes),
    }
}

/// Refines the nearest of the failed plans towards goals that lie as far on the other side
/// of ours as their replays ended next to it.
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
            next.extend(refined_again(board, &[candidate], &kept, pushes));
        }
    }
    next
}

/// Error of a plan as written in tolerances, in the engine where it is larger; infinite where its end does
/// not count at all.
fn replayed_error(task: &Task, attempt: &Attempt) -> f64 {
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

/// The next target of each demand, when a plan aimed at `aim` missed the goal: as far on the other side.
/// One step of iterative learning control (Arimoto et al. 1984, doi:10.1002/rob.4620010203) with
/// the effect model's own slopes, for the middle of the ends in both engines, disturbed or
/// not. `None` if the plan ends on the goal already.
fn aim(goal: &Goal, aim: &Goal, verdict: &Verdict) -> Option<Goal> {
    let found = goal.demands.iter().zip(&aim.demands).map(|(demand, aim)| {
        let (shift, turn) = mean_miss(goal.object, demand, verdict)?;
        // From where it was aimed at last.
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

/// The mean offset from a demand in its own frame, metres, and the mean turn, radians, of the replays that
/// count, each engine with equal weight; `None` if there are none.
fn mean_miss(object: usize, demand: &Demand, verdict: &Verdict) -> Option<(Vector, f64)> {
    let (mut shift, mut turn, mut engines) = (Vector::zeros(), 0.0, 0.0);
    for engine in Engine::ALL {
        let all = verdict.nominal(engine).into_iter().chain(verdict.disturbed(engine));
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
