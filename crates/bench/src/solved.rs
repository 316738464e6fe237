//! Benchmark record of a solved task.

use serde::{Deserialize, Serialize};

use crate::store::Seconds;
use pushplan::solve::{PlanStatus, Solution};
use pushplan::{
    outcome::{Outcome, Warning},
    scene::{Engine, Situation},
    task::{Plan, Task},
};

/// Result of solving one task, without the times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolvedTask {
    /// Name of the task.
    pub task: String,
    /// Status of the solution.
    pub status: PlanStatus,
    /// Largest distance that counts as success, metres; `None` for a goal without a position.
    pub tolerance: Option<f64>,
    /// Chosen plan, or the nearest one; `None` if no push is feasible.
    pub plan: Option<Plan>,
    /// Outcome predicted by the effect model.
    pub predicted: Option<End>,
    /// Outcome in the 2-D engine.
    pub planar: Option<End>,
    /// Outcome in the 3-D engine.
    pub spatial: Option<End>,
    /// Share of the perturbed 3-D replays that reach the goal, if any were made.
    pub robustness: Option<f64>,
    /// Number of plans replayed until one passed or none was left.
    pub attempts: usize,
    /// Number of rollouts of the effect model.
    pub rollouts: usize,
    /// Warnings about the prediction.
    pub warnings: Vec<Warning>,
}

/// Final error of the goal object.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// Distance from the goal, metres.
    pub error: f64,
    /// Heading error, radians, if the goal has a heading.
    pub heading_error: Option<f64>,
    /// Whether the goal is reached at rest.
    pub reached: bool,
}

impl SolvedTask {
    /// Returns the record of a solution. An unverified plan is replayed too, so that every plan has
    /// its error in both engines.
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

    /// Returns the duration of solving, by stage.
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
    /// Returns the errors of an outcome.
    pub fn of(outcome: &Outcome) -> Self {
        let (error, heading_error) = (outcome.error(), outcome.heading_error());
        Self { error, heading_error, reached: outcome.reached }
    }
}
