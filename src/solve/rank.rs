//! Selection of candidates to refine and of plans to verify.

use crate::plan::{Candidate, Evaluation, SearchResult, is_behind, kinds};
use crate::task::{Demand, End, Goal, Task};

/// Returns the best `count` candidates of different kinds, followed by the next best ones if there
/// are too few kinds. At most `most_behind` of them have a blocked motion. `found` must be sorted,
/// best first, and the result is sorted also.
pub fn distinct(found: &[SearchResult], count: usize, most_behind: usize) -> Vec<Candidate> {
    let kinds = kinds(found, count);
    let mut taken = vec![false; found.len()];
    kinds.iter().for_each(|&k| taken[k] = true);
    let missing = count.saturating_sub(kinds.len());
    let spare: Vec<usize> = (0..found.len()).filter(|&k| !taken[k]).take(missing).collect();
    spare.into_iter().for_each(|k| taken[k] = true);
    let kept = found.iter().zip(&taken).filter(|(_, taken)| **taken).map(|(one, _)| one);
    // Plans with a blocked motion come last.
    let (behind, sound): (Vec<&SearchResult>, Vec<&SearchResult>) =
        kept.partition(|one| is_behind(one.score));
    sound
        .into_iter()
        .chain(behind.into_iter().take(most_behind))
        .map(|one| one.candidate.clone())
        .collect()
}

/// Smallest model error assumed in the decision to verify, relative to the tolerance: a measured
/// accuracy only holds on average.
const HAIR: f64 = 0.1;

/// Error assumed for a model outside the ranges in which it was measured, metres. Plans that are
/// predicted to miss by more have not been seen to work.
const UNKNOWN_ERROR: f64 = 0.05;

/// Returns `true` if the predicted error is at most the tolerance plus the effect model's error
/// `error_p95` (metres), which is at least [`HAIR`]. For headings, the model's error applies at the
/// object's mean radius. If it is unknown or larger, [`UNKNOWN_ERROR`] is assumed.
pub(super) fn is_worth_verifying(
    task: &Task,
    evaluation: &Evaluation,
    error_p95: Option<f64>,
) -> bool {
    if !evaluation.score.is_finite() {
        return false;
    }
    let error_p95 = error_p95.unwrap_or(UNKNOWN_ERROR).min(UNKNOWN_ERROR);
    let near = |goal: &Goal| {
        // A goal without a place has no finite tolerance.
        let hair = Some(HAIR * goal.tolerance()).filter(|hair| hair.is_finite());
        let error_p95 = error_p95.max(hair.unwrap_or(0.0));
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
