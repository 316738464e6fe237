//! Plans that meet some of several goals, by highest weight.

use crate::asset::ToolLibrary;
use crate::progress::{Progress, Quiet};
use crate::verify::{Verifier, VerifySettings};
use crate::{outcome::Outcome, task::Task};

use super::error::SolveError;
use super::planner::{Planner, stated};
use super::solution::{Partial, PlanStatus, Solution};

/// Maximum number of goals for which all subsets are tried. With more goals, only single goals and
/// all but one are tried.
const ALL_SETS: usize = 6;

/// Maximum number of sets of goals tried, each as a separate task, because sets of low weight are
/// worth little.
const TRIED: usize = 12;

/// Replaces a solution that does not meet all goals by a plan that meets some of them.
pub(super) fn meet_some_goals(
    planner: &Planner,
    task: &Task,
    library: &ToolLibrary,
    progress: &dyn Progress,
    solution: &mut Solution,
) -> Result<(), SolveError> {
    let missed = matches!(solution.status, PlanStatus::NoPlan | PlanStatus::FailedVerification);
    if !missed || task.goals.len() < 2 {
        return Ok(());
    }
    let situation = stated(task);
    progress.stage("plans for a subset of the goals");
    // Milestones of partial plans are not reported.
    let quiet = Quiet(progress);
    for met in sets(task) {
        let Some(part) = task.only(&met).filter(|_| !progress.cancelled()) else { break };
        let found = planner.solve_from(&situation, &part, library, &quiet)?;
        if found.status != PlanStatus::Solved {
            continue;
        }
        let before = std::mem::take(&mut solution.statistics);
        *solution = Solution { status: PlanStatus::Partial, ..found };
        solution.statistics.add(&before);
        // The other plans were judged by some goals only.
        solution.plans.truncate(1);
        let mut robustness = None;
        for best in &mut solution.plans {
            robustness = best.verdict.as_ref().and_then(|verdict| verdict.robustness);
            let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
            let (tools, plan) = (&best.tools, &best.plan);
            best.verdict = Some(verifier.nominal(task, &situation, tools, plan));
            best.outcome = Outcome::judge(&situation.scene, task, &best.predicted);
        }
        solution.partial = Some(Partial { met, robustness });
        break;
    }
    Ok(())
}

/// Returns sets of a task's goals by their indices, highest weight first. The set of all goals and
/// sets met at the start are excluded.
fn sets(task: &Task) -> Vec<Vec<usize>> {
    let start = task.scene.start();
    let goals: Vec<(f64, bool)> =
        task.goals.iter().map(|goal| (goal.weight, goal.reached(&start))).collect();
    let count = goals.len();
    let mut sets: Vec<Vec<usize>> = match count <= ALL_SETS {
        true => (1..(1usize << count) - 1)
            .map(|set| (0..count).filter(|k| set >> k & 1 == 1).collect())
            .collect(),
        false => {
            let but_one = (0..count).map(|left| (0..count).filter(|k| *k != left).collect());
            but_one.chain((0..count).map(|k| vec![k])).collect()
        }
    };
    sets.retain(|set| set.iter().any(|k| !goals[*k].1));
    let weight = |set: &Vec<usize>| set.iter().map(|k| goals[*k].0).sum::<f64>();
    // Ties in weight go to larger sets, then to earlier goals.
    sets.sort_by(|a, b| weight(b).total_cmp(&weight(a)).then(b.len().cmp(&a.len())).then(a.cmp(b)));
    sets.truncate(TRIED);
    sets
}
