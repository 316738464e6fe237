//! Benefit of refinement: solvable random tasks, solved without and with it, everything else alike.

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::solve::{PlanStatus, Planner, Solution, SolveError};
use pushplan::internals::{scene::Situation, task::Task};
use pushplan_act::judge::Summary;
use pushplan_bench::store::Measured;
use pushplan_bench::{End, SolvedTask};
use serde::{Deserialize, Serialize};

use super::random::random_task;

/// Results of the tasks with a planner; errors refer to the selected plans, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanErrors {
    /// Error predicted by the effect model.
    pub predicted: Option<Summary>,
    /// Error in the 2-D engine.
    pub planar: Option<Summary>,
    /// Error in the 3-D engine.
    pub spatial: Option<Summary>,
    /// Number of tasks solved.
    pub solved: usize,
    /// Number of plans that work in both engines on even pressure, corners and in between.
    pub on_all_supports: usize,
    /// Mean number of plans replayed per task.
    pub attempts: f64,
    /// Mean number of rollouts of the effect model per task.
    pub rollouts: f64,
}

/// Refinement over many tasks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefinementReport {
    /// Name of the effect model.
    pub model: String,
    /// Seed of the tasks.
    pub seed: u64,
    /// Number of tasks.
    pub tasks: usize,
    /// Tolerance of the goals, metres.
    pub tolerance: f64,
    /// Results without refinement.
    pub before: PlanErrors,
    /// Results with refinement.
    pub after: PlanErrors,
    /// Number of refined plans with a larger predicted error than before: must be zero.
    pub worse: usize,
    /// Number of quadratic programmes solved.
    pub programmes: usize,
    /// Number of quadratic programmes that ended in another status.
    pub programmes_failed: usize,
}

/// Effect of refinement in a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RefinedTask {
    /// The task solved without refinement.
    pub before: Tried,
    /// The task solved with refinement.
    pub after: Tried,
    /// Number of refined plans with a larger predicted error than before.
    pub worse: usize,
    /// Number of quadratic programmes solved.
    pub programmes: usize,
    /// Number of quadratic programmes that ended in another status.
    pub programmes_failed: usize,
}

/// A solved task, and whether its plan works on every support model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// The task and its result.
    pub solved: SolvedTask,
    /// Whether the selected plan works in both engines on even pressure, corners and in between.
    pub on_all_supports: bool,
}

impl Tried {
    fn of(task: &Task, solution: &Solution) -> Self {
        let situation = Situation::stated(&task.scene);
        Self {
            solved: SolvedTask::of(task, solution),
            on_all_supports: solution
                .best()
                .is_some_and(|plan| plan.works_on_all_supports(task, &situation)),
        }
    }
}

/// Solves random task `index` of `seed` with two planners. `without` differs from `with` only in
/// that it does not refine. `library` holds at least one tool. The result has the same bits for any
/// number of threads.
///
/// # Errors
/// Returns the error of a planner that refuses the task.
pub fn refine_task(
    [without, with]: [&Planner; 2],
    library: &ToolLibrary,
    seed: u64,
    index: usize,
) -> Result<Measured<RefinedTask>, SolveError> {
    let task = random_task(library, seed, index);
    let before = without.solve(&task, library)?;
    let after = with.solve(&task, library)?;
    let statistics = &after.statistics.refinement;
    let refined = after.plans.iter().map(|plan| &plan.refinement);
    let record = RefinedTask {
        before: Tried::of(&task, &before),
        after: Tried::of(&task, &after),
        worse: refined.filter(|plan| plan.after > plan.before).count(),
        programmes: statistics.solved,
        programmes_failed: statistics.failures.len(),
    };
    let total = |solution: &Solution| solution.statistics.timing.total;
    let seconds = [("without", total(&before)), ("with", total(&after))];
    let seconds = seconds.map(|(name, spent)| (name.to_owned(), spent)).into();
    Ok(Measured { record, seconds })
}

impl RefinementReport {
    /// Combines the results of tasks of `seed` that were solved with the effect model `model`.
    pub fn of(model: &str, seed: u64, done: &[&RefinedTask]) -> Self {
        let (before, after): (Vec<&Tried>, Vec<&Tried>) =
            done.iter().map(|one| (&one.before, &one.after)).unzip();
        let sum = |count: &dyn Fn(&RefinedTask) -> usize| done.iter().map(|one| count(one)).sum();
        Self {
            model: model.to_owned(),
            seed,
            tasks: done.len(),
            tolerance: after.first().map_or(0.0, |task| task.solved.tolerance.unwrap_or_default()),
            before: plan_errors(&before),
            after: plan_errors(&after),
            worse: sum(&|one| one.worse),
            programmes: sum(&|one| one.programmes),
            programmes_failed: sum(&|one| one.programmes_failed),
        }
    }
}

fn plan_errors(list: &[&Tried]) -> PlanErrors {
    let on_all_supports = list.iter().filter(|task| task.on_all_supports).count();
    let list: Vec<&SolvedTask> = list.iter().map(|task| &task.solved).collect();
    let over = |end: &dyn Fn(&SolvedTask) -> Option<End>| {
        let errors = list.iter().filter_map(|task| Some(end(task)?.error));
        Summary::of(&errors.collect::<Vec<f64>>())
    };
    let mean = |count: &dyn Fn(&SolvedTask) -> usize| {
        list.iter().map(|task| count(task) as f64).sum::<f64>() / list.len().max(1) as f64
    };
    PlanErrors {
        predicted: over(&|task| task.predicted),
        planar: over(&|task| task.planar),
        spatial: over(&|task| task.spatial),
        solved: list.iter().filter(|task| task.status == PlanStatus::Solved).count(),
        on_all_supports,
        attempts: mean(&|task| task.attempts),
        rollouts: mean(&|task| task.rollouts),
    }
}
