//! What refinement brings: final errors of the best plan before and after, as predicted and as
//! executed in both engines, over random tasks that are known to be solvable.

use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    asset::ToolLibrary,
    effect::EffectModel,
    plan::{
        Candidate, Evaluation, RefineSettings, RefineStatistics, Rollouts, Search, Workspace,
        evaluate, kinds, refine,
    },
    scene::{Job, Outcome, Record, Situation, Task, Tool, ToolMotion},
    sim::Simulator,
    solve::Settings,
};

use super::{random::random_task, statistics::Summary};

/// Final errors of plans, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanErrors {
    /// As the effect model predicts them.
    pub predicted: Option<Summary>,
    /// As executed in the planar engine.
    pub planar: Option<Summary>,
    /// As executed in the 3-D engine.
    pub spatial: Option<Summary>,
    /// Plans that reach the goal in the planar engine.
    pub reached_planar: usize,
    /// Plans that reach the goal in the 3-D engine.
    pub reached_spatial: usize,
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
    /// Tasks for which the search found any push that can be made; only these are counted.
    pub planned: usize,
    /// Tolerance of the goals, metres.
    pub tolerance: f64,
    /// The best candidate of the search.
    pub before: PlanErrors,
    /// The best refined candidate.
    pub after: PlanErrors,
    /// Tasks in which the predicted error grew: must be none.
    pub worse_predicted: usize,
    /// Tasks in which the executed planar error grew by more than a millimetre.
    pub worse_planar: usize,
    /// Quadratic programmes solved.
    pub programmes: usize,
    /// Quadratic programmes that ended in another status.
    pub programmes_failed: usize,
}

/// Final errors of one plan.
struct Errors {
    predicted: f64,
    planar: Outcome,
    spatial: Outcome,
}

/// Searches and refines `tasks` random tasks with `model` under the budgets of `settings`, in
/// parallel over tasks on the current rayon pool; the same bits for any number of threads.
pub fn refinement_report(
    model: &dyn EffectModel,
    library: &ToolLibrary,
    settings: &Settings,
    seed: u64,
    tasks: usize,
) -> RefinementReport {
    let count = if library.is_empty() { 0 } else { tasks };
    let tools: Vec<Arc<Tool>> = library.iter().cloned().collect();
    let results: Vec<Option<(Errors, Errors, RefineStatistics)>> = (0..count)
        .into_par_iter()
        .map(|index| one_task(model, &tools, settings, &random_task(library, seed, index)))
        .collect();
    let done: Vec<_> = results.into_iter().flatten().collect();
    let tolerance = if count > 0 { random_task(library, seed, 0).goal.tolerance } else { 0.0 };
    let (before, after): (Vec<&Errors>, Vec<&Errors>) =
        done.iter().map(|(before, after, _)| (before, after)).unzip();
    let worse = |grown: &dyn Fn(&Errors, &Errors) -> bool| {
        done.iter().filter(|(before, after, _)| grown(before, after)).count()
    };
    RefinementReport {
        model: model.name().to_owned(),
        seed,
        tasks: count,
        planned: done.len(),
        tolerance,
        before: plan_errors(&before),
        after: plan_errors(&after),
        worse_predicted: worse(&|before, after| after.predicted > before.predicted),
        worse_planar: worse(&|before, after| after.planar.error > before.planar.error + 1e-3),
        programmes: done.iter().map(|(_, _, statistics)| statistics.solved).sum(),
        programmes_failed: done.iter().map(|(_, _, statistics)| statistics.failures.len()).sum(),
    }
}

fn one_task(
    model: &dyn EffectModel,
    tools: &[Arc<Tool>],
    settings: &Settings,
    task: &Task,
) -> Option<(Errors, Errors, RefineStatistics)> {
    let workspace = Workspace { task, tools, later_stand_off: 0.0 };
    let mut rollouts = Rollouts::new(model, Situation::stated(&task.scene));
    let mut search = Search::new(workspace, rollouts.situation(), settings.search());
    let found = search.deepen(&mut rollouts, &mut |_, _| {});
    let chosen: Vec<Candidate> =
        kinds(&found, settings.refined).into_iter().map(|k| found[k].candidate.clone()).collect();
    let best = |list: Vec<Evaluation>| {
        let feasible = list.into_iter().filter(|e| e.is_feasible() && e.score.is_finite());
        feasible.min_by(|a, b| a.score.total_cmp(&b.score))
    };
    let before: Vec<Evaluation> =
        evaluate(&workspace, &mut rollouts, &chosen).into_iter().flatten().collect();
    let before = best(before)?;
    let refine_settings = RefineSettings {
        rounds: settings.refine_rounds,
        extra: settings.refine_extra,
        seed: 0,
        enough: settings.verified_at_once,
    };
    let mut statistics = RefineStatistics::default();
    let refined = refine(
        &workspace,
        &mut rollouts,
        &chosen,
        refine_settings,
        &mut statistics,
        &mut |_, _| {},
    );
    let after = best(refined.into_iter().map(|one| one.best).collect())?;
    Some((execute(&workspace, &before), execute(&workspace, &after), statistics))
}

fn execute(workspace: &Workspace, evaluation: &Evaluation) -> Errors {
    let (task, candidate) = (workspace.task, &evaluation.candidate);
    let motion = ToolMotion::pushes(
        Arc::clone(&workspace.tools[candidate.tool]),
        task.pushes.lift,
        candidate.grip_yaw,
        &evaluation.pushes,
        workspace.is_placed(),
    );
    let run = |simulator: Simulator| {
        let job = Job::stated(&task.scene, motion.clone());
        let played = simulator.run(&task.scene, &job, Record::Outcome);
        Outcome::judge(&task.goal, &played)
    };
    Errors {
        predicted: task.goal.error(&evaluation.outcome),
        planar: run(Simulator::planar()),
        spatial: run(Simulator::spatial()),
    }
}

fn plan_errors(list: &[&Errors]) -> PlanErrors {
    let over = |value: &dyn Fn(&Errors) -> f64| {
        Summary::of(&list.iter().map(|errors| value(errors)).collect::<Vec<f64>>())
    };
    PlanErrors {
        predicted: over(&|errors| errors.predicted),
        planar: over(&|errors| errors.planar.error),
        spatial: over(&|errors| errors.spatial.error),
        reached_planar: list.iter().filter(|errors| errors.planar.reached).count(),
        reached_spatial: list.iter().filter(|errors| errors.spatial.reached).count(),
    }
}
