//! Selection of candidates to refine and of plans to verify.

use crate::plan::{Candidate, Evaluation, SearchResult, is_behind, kinds};
use crate::task::{Demand, End, Goal, Task};

/// The best `count` found candidates of different kinds, then, if there are too few kinds, the next
/// best ones; at most `most_behind` of them with something in the way. `found` is sorted, best
/// first, and so is the answer.
pub fn distinct(found: &[SearchResult], count: usize, most_behind: usize) -> Vec<Candidate> {
    let kinds = kinds(found, count);
    let mut taken = vec![false; found.len()];
    kinds.iter().for_each(|&k| taken[k] = true);
    let missing = count.saturating_sub(kinds.len());
    let spare: Vec<usize> = (0..found.len()).filter(|&k| !taken[k]).take(missing).collect();
    spare.into_iter().for_each(|k| taken[k] = true);
    let kept = found.iter().zip(&taken).filter(|(_, taken)| **taken).map(|(one, _)| one);
    // Plans that lead through a wall come after everything else.
    let (behind, sound): (Vec<&SearchResult>, Vec<&SearchResult>) =
        kept.partition(|one| is_behind(one.score));
    sound
        .into_iter()
        .chain(behind.into_iter().take(most_behind))
        .map(|one| one.candidate.clone())
        .collect()
}

/// A prediction that is outside the tolerance by no more than this share of it is tried, however
/// good the model is said to be: it is good only on average.
const HAIR: f64 = 0.1;

/// Whether the predicted error is at most the tolerance plus the effect model's error, `error_p95`
/// metres, or a hair; for a heading this is taken at the object's mean radius. Where that was not
/// measured, everything that can be carried out is.
pub(super) fn is_worth_verifying(
    task: &Task,
    evaluation: &Evaluation,
    error_p95: Option<f64>,
) -> bool {
    if !evaluation.score.is_finite() {
        return false;
    }
    let Some(error_p95) = error_p95 else { return true };
    let near = |goal: &Goal| {
        let error_p95 = error_p95.max(HAIR * goal.tolerance());
        let radius = task.scene.objects[goal.object].shape.footprint().mean_radius();
        let end = End::resting(goal.object, &evaluation.outcome);
        goal.demands.iter().map(Demand::kind).all(|kind| {
            let off = kind.off(&end).zip(kind.tolerance());
            let near = off.is_none_or(|(off, within)| off.norm() <= within + error_p95);
            let turn = kind.turned(&end).zip(kind.turn_tolerance());
            let turned =
                turn.is_none_or(|(turn, within)| turn.abs() <= within + error_p95 / radius);
            near && turned || kind.is_met(&end)
        })
    };
    task.goals.iter().all(near)
}
