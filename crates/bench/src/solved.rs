//! The result of solving a task, as benchmarks keep it.

use serde::{Deserialize, Serialize};

use crate::store::Seconds;
use pushplan::solve::{PlanStatus, Solution};
use pushplan::{
    outcome::{Outcome, Warning},
    scene::{Engine, Situation},
    task::{Plan, Task},
};

/// The result of solving one task, everything but the times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolvedTask {
    /// Name of the task.
    pub task: String,
    /// How it ended.
    pub status: PlanStatus,
    /// Largest distance that counts as success, metres; `None` where no place is asked for.
    pub tolerance: Option<f64>,
    /// The plan to use, or the nearest one; `None` if no push can be made at all.
    pub plan: Option<Plan>,
    /// Where it ends as predicted by the effect model.
    pub predicted: Option<End>,
    /// Where it ends in the planar engine.
    pub planar: Option<End>,
    /// Where it ends in the 3-D engine.
    pub spatial: Option<End>,
    /// Share of the disturbed 3-D replays that reach the goal, where any were made.
    pub robustness: Option<f64>,
    /// Plans that were replayed until one passed or they ran out.
    pub attempts: usize,
    /// Rollouts of the effect model.
    pub rollouts: usize,
    /// What lowers the trust in the prediction.
    pub warnings: Vec<Warning>,
}

/// Where the goal object ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// Distance from the goal, metres.
    pub error: f64,
    /// Heading error, radians, where a heading is asked for.
    pub heading_error: Option<f64>,
    /// Whether the goal is reached at rest.
    pub reached: bool,
}

impl SolvedTask {
    /// The record of a solution. A plan that was not worth verifying is replayed all the same,
    /// so that every plan has its error in both engines.
    pub fn of(task: &Task, solution: &Solution) -> Self {
        let best = solution.best();
        let situation = Situation::stated(&task.scene);
        let replays = best.map(|best| best.replays(task, &situation));
        let verdict = replays.as_deref();
        let end = |engine: Engine| {
            let found = verdict.and_then(|verdict| verdict.nominal(engine));
            found.map(|evidence| End::of(&evidence.outcome))
        };
        Self {
            task: task.name.clone(),
            status: solution.status,
            tolerance: Some(task.goals[0].tolerance()).filter(|tolerance| tolerance.is_finite()),
            plan: best.map(|best| best.plan.clone()),
            predicted: best.map(|best| End::of(&best.outcome)),
            planar: end(Engine::Planar),
            spatial: end(Engine::Spatial),
            robustness: verdict.and_then(|verdict| verdict.robustness),
            attempts: solution.statistics.verified,
            rollouts: solution.statistics.rollouts,
            warnings: solution.warnings.clone(),
        }
    }

    /// How long solving took, by stage.
    pub fn seconds(solution: &Solution) -> Seconds {
        let timing = &solution.statistics.timing;
        let stages = [
            ("search", timing.search),
            ("refinement", timing.refinement),
            ("verification", timing.verification),
            ("total", timing.total),
        ];
        stages.into_iter().map(|(name, seconds)| (name.to_owned(), seconds)).collect()
    }
}

impl End {
    /// The part of an outcome that is counted.
    pub fn of(outcome: &Outcome) -> Self {
        let (error, heading_error) = (outcome.error(), outcome.heading_error());
        Self { error, heading_error, reached: outcome.reached }
    }
}
