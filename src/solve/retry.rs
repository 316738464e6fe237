//! What is learnt from failed replays: ways that do not work are left for others, and plans that
//! end near the goal are aimed again, by as much as they missed it.

use std::sync::Arc;

use crate::geometry::{Vector, wrap_angle};
use crate::plan::{Candidate, CandidatePush, SearchResult, is_behind};
use crate::{
    outcome::{Verdict, Warning},
    scene::{Engine, State, Tool},
    task::{Goal, Task},
};

use super::attempts::{Attempt, Perturbed};
use super::rank::distinct;
use super::solving::Solving;

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

/// Pushes whose directions differ by no more, radians, and lengths by no more, metres, move the
/// object alike, whatever tool makes them.
const SAME_DIRECTION: f64 = 0.26;
const SAME_LENGTH: f64 = 0.02;

/// Objects, directions and lengths of the pushes of a plan.
pub(super) struct PushPattern(Vec<(usize, f64, f64)>);

impl PushPattern {
    fn of(pushes: &[CandidatePush]) -> Self {
        Self(pushes.iter().map(|push| (push.object, push.direction, push.length)).collect())
    }

    /// Whether a candidate begins like this: its further pushes start from a prediction that
    /// does not hold.
    fn begins(&self, candidate: &Candidate) -> bool {
        self.0.len() <= candidate.pushes.len()
            && self.0.iter().zip(&candidate.pushes).all(|(&(object, direction, length), push)| {
                push.object == object
                    && wrap_angle(push.direction - direction).abs() <= SAME_DIRECTION
                    && (push.length - length).abs() <= SAME_LENGTH
            })
    }
}

impl Solving<'_> {
    /// Up to `count` candidates of different kinds to refine, best first, none that begins like
    /// a refuted plan or is a variant of one of `known`, as long as there are others.
    pub(super) fn choose(
        &self,
        found: &[SearchResult],
        count: usize,
        known: &[&Candidate],
    ) -> Vec<Candidate> {
        let others: Vec<SearchResult> = found
            .iter()
            .filter(|one| !self.is_refuted(&one.candidate))
            .filter(|one| !known.iter().any(|known| one.candidate.is_variant_of(known)))
            .cloned()
            .collect();
        let most_behind = self.at_once();
        if others.is_empty() && known.is_empty() {
            distinct(found, count, most_behind)
        } else {
            distinct(&others, count, most_behind)
        }
    }

    /// Reorders the queue of plans of one length after the plans `failed` did not pass, or were not
    /// safe: first those of them that reached the goal before their last push, without it; those
    /// whose tool came down on an object, set down farther away; those that came near, aimed
    /// again; then other ways, of which new ones are refined where too few are left; then the
    /// rest. `first` is the first plan of this length.
    pub(super) fn reconsider(
        &mut self,
        queue: &mut Vec<usize>,
        failed: &[usize],
        found: &[SearchResult],
        (first, pushes): (usize, usize),
    ) {
        for &k in failed {
            let tried = &self.tried[k];
            if missed(self.task, tried) > REFUTED
                && let Some(candidate) = &tried.candidate
            {
                self.refuted.push(PushPattern::of(&candidate.pushes));
            }
        }
        let at_once = self.at_once();
        let mut next = self.shortened(failed);
        next.extend(self.set_down_farther(failed, pushes));
        next.extend(self.aim_again(failed, at_once.div_ceil(2), pushes));
        let (fresh, rest): (Vec<usize>, Vec<usize>) = queue.iter().partition(|&&k| {
            self.tried[k].candidate.as_ref().is_some_and(|candidate| !self.is_refuted(candidate))
        });
        next.extend(fresh);
        let missing = at_once.saturating_sub(next.len());
        if missing > 0 {
            let known: Vec<&Candidate> =
                self.tried[first..].iter().filter_map(|tried| tried.candidate.as_ref()).collect();
            let others = self.choose(found, missing, &known);
            let goals = self.task.goals.clone();
            next.extend(self.refined(&others, &goals, pushes));
        }
        next.extend(rest);
        // Stable: plans through a wall go last, everything else keeps its order.
        next.sort_by_key(|&k| is_behind(self.tried[k].score));
        *queue = next;
    }

    /// Refines changed candidates of plans that were replayed already: what was decided on is not screened
    /// again.
    fn refined_again(
        &mut self,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<usize> {
        if self.deciding.is_none() {
            return self.refined(candidates, aims, pushes);
        }
        self.tell("refine", pushes);
        let decided = self.decided(candidates, aims, pushes);
        self.worth_verifying(decided, aims)
    }

    /// Plans that reached the goal after an earlier push than the last, in both engines, without
    /// the pushes that spoiled it.
    fn shortened(&mut self, failed: &[usize]) -> Vec<usize> {
        let mut next = Vec::new();
        for &k in failed {
            let tried = &self.tried[k];
            let (Some(candidate), Some(verdict)) = (&tried.candidate, &tried.verdict) else {
                continue;
            };
            let reached = |count: usize| {
                Engine::ALL.into_iter().all(|engine| {
                    let frames = verdict.nominal(engine).and_then(|e| e.trajectory.as_ref());
                    let mut frames = frames.iter().flat_map(|t| t.frames.iter().rev());
                    let end = frames.find(|frame| frame.stroke + 1 == count);
                    end.is_some_and(|frame| self.task.reached(&frame.state))
                })
            };
            let placed = self.workspace.is_placed();
            let count = (1..tried.plan.pushes().len()).find(|&count| placed && reached(count));
            let Some(count) = count else { continue };
            let mut candidate = candidate.clone();
            candidate.pushes.truncate(count);
            let plan = tried.plan.first(count);
            let known = self.tried.iter().any(|tried| tried.plan == plan);
            if !known {
                let named = |tool: &&Arc<Tool>| plan.tools().contains(&tool.name.as_str());
                let shorter = Attempt {
                    tools: tried.tools.iter().filter(named).cloned().collect(),
                    plan,
                    candidate: Some(candidate),
                    aims: tried.aims.clone(),
                    refinement: tried.refinement.clone(),
                    verdict: None,
                    disturbed: Perturbed::No,
                    ..*tried
                };
                next.push(self.tried.len());
                self.tried.push(shorter);
            }
        }
        next
    }

    /// Plans whose tool came down on an object for a later push, with more room there.
    fn set_down_farther(&mut self, failed: &[usize], pushes: usize) -> Vec<usize> {
        let mut wider = Vec::new();
        for &k in failed {
            let tried = &self.tried[k];
            let (Some(candidate), Some(verdict)) = (&tried.candidate, &tried.verdict) else {
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
        let goals = self.task.goals.clone();
        match wider.is_empty() {
            true => Vec::new(),
            false => self.refined_again(&wider, &goals, pushes),
        }
    }

    /// Refines the nearest of the failed plans towards goals that lie as far on the other side
    /// of ours as their replays ended next to it.
    fn aim_again(&mut self, failed: &[usize], count: usize, pushes: usize) -> Vec<usize> {
        let task = self.task;
        let mut near: Vec<(f64, usize)> = failed
            .iter()
            .map(|&k| (missed(task, &self.tried[k]), k))
            .filter(|(missed, _)| *missed <= NEAR)
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut next = Vec::new();
        for (_, k) in near.into_iter().take(count) {
            let tried = &self.tried[k];
            let (Some(candidate), Some(verdict)) = (tried.candidate.clone(), &tried.verdict) else {
                continue;
            };
            let aims = task.goals.iter().zip(&tried.aims);
            let next_aims: Vec<Option<Goal>> =
                aims.clone().map(|(goal, aimed)| aim(goal, aimed, verdict)).collect();
            if next_aims.iter().any(Option::is_some) {
                let kept = aims
                    .zip(next_aims)
                    .map(|((_, aimed), next)| next.unwrap_or_else(|| aimed.clone()));
                next.extend(self.refined_again(&[candidate], &kept.collect::<Vec<_>>(), pushes));
            }
        }
        next
    }

    fn is_refuted(&self, candidate: &Candidate) -> bool {
        self.refuted.iter().any(|way| way.begins(candidate))
    }
}

/// By how many tolerances a plan misses the goal as written, in the engine where it misses by more;
/// infinite where its end does not count at all.
fn missed(task: &Task, tried: &Attempt) -> f64 {
    let Some(verdict) = &tried.verdict else { return f64::INFINITY };
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

/// Where to aim next, when a plan aimed at `aim` missed the goal: as far on the other side.
/// One step of iterative learning control (Arimoto et al. 1984, doi:10.1002/rob.4620010203) with
/// the effect model's own slopes, for the middle of where it ends in both engines, disturbed or
/// not. `None` if that is on the goal already.
fn aim(goal: &Goal, aim: &Goal, verdict: &Verdict) -> Option<Goal> {
    let (mut shift, mut turn, mut engines) = (Vector::zeros(), 0.0, 0.0);
    for engine in Engine::ALL {
        let all = verdict.nominal(engine).into_iter().chain(verdict.disturbed(engine));
        let ends: Vec<&State> = all
            .filter(|evidence| evidence.fault().is_none())
            .map(|evidence| &evidence.outcome.state)
            .collect();
        if !ends.is_empty() {
            let count = ends.len() as f64;
            shift += ends.iter().map(|end| goal.off_as_seen(end)).sum::<Vector>() / count;
            let turned = ends.iter().filter_map(|end| goal.turned(end));
            turn += turned.sum::<f64>() / count;
            engines += 1.0;
        }
    }
    if engines == 0.0 {
        return None;
    }
    let (shift, turn) = (shift / engines, turn / engines);
    let heading = match (goal.heading, aim.heading) {
        (Some((_, tolerance)), Some((aimed, _))) => Some((aimed - turn, tolerance)),
        _ => None,
    };
    let off = goal.heading.map_or(0.0, |(_, tolerance)| turn.abs() / tolerance);
    let off = off.max(shift.norm() / goal.tolerance);
    // From where it was aimed at last.
    let aimed = goal.shifted(aim.position - goal.position - shift);
    (off > ON_THE_GOAL).then_some(Goal { heading, ..aimed })
}

#[cfg(test)]
mod tests;
