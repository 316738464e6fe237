//! Goals with a choice among objects. Each choice is searched as a task with simpler goals, and
//! plans are judged by the original goals.

use crate::asset::ToolLibrary;
use crate::outcome::{Evidence, Outcome, Verdict};
use crate::progress::Progress;
use crate::scene::Situation;
use crate::task::Task;

use super::error::SolveError;
use super::planner::Planner;
use super::solution::{PlanStatus, RankedPlan, Solution};

/// Solves the choices one after another, nearest first, until one has a plan that passes; otherwise
/// returns the best solution.
pub(super) fn solve_one_of(
    planner: &Planner,
    (task, situation): (&Task, &Situation),
    choices: &[Task],
    library: &ToolLibrary,
    progress: &dyn Progress,
) -> Result<Solution, SolveError> {
    let (nearest, others) = choices.split_first().unwrap_or((task, &[]));
    let mut best = planner.solve_from(situation, nearest, library, progress)?;
    for choice in others {
        if best.status == PlanStatus::Solved || progress.cancelled() {
            break;
        }
        let found = planner.solve_from(situation, choice, library, progress)?;
        let (mut better, other) = match rank(found.status) < rank(best.status) {
            true => (found, best),
            false => (best, found),
        };
        better.statistics.add(&other.statistics);
        better.stopped |= other.stopped;
        best = better;
    }
    best.plans.iter_mut().for_each(|plan| judge_by(task, situation, plan));
    Ok(best)
}

fn rank(status: PlanStatus) -> usize {
    match status {
        PlanStatus::Solved => 0,
        PlanStatus::Fragile => 1,
        PlanStatus::Partial => 2,
        PlanStatus::FailedVerification => 3,
        PlanStatus::NoPlan => 4,
    }
}

/// Judges a plan and its replays by the goals of `task`. An outcome that satisfies a choice also
/// satisfies these goals, so that the number of passing replays cannot fall.
fn judge_by(task: &Task, situation: &Situation, plan: &mut RankedPlan) {
    let scene = &*situation.scene;
    plan.outcome = Outcome::judge(scene, task, &plan.predicted);
    let Some(verdict) = plan.verdict.take() else { return };
    let judged = |evidence: Evidence| {
        let lifts = evidence.trajectory.as_ref().map_or(&[][..], |replay| &replay.lifts);
        let sound = evidence.fault().is_none();
        let state = evidence.outcome.state.clone();
        Evidence { outcome: Outcome::of_state((scene, task), state, lifts, sound), ..evidence }
    };
    let evidence = verdict.evidence.into_iter().map(judged).collect();
    plan.verdict = Some(Verdict::judge(verdict.forbidden, evidence, task.robustness));
}
