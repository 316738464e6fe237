//! What comes back from solving a task of levering.

use std::sync::Arc;

use serde::Serialize;

use crate::plan::lever::LeverSearchStatistics;
use crate::scene::{LeverOutcome, LeverPlan, LeverVerdict, Task, Tool};
use crate::solve::{PlanStatus, Solution};

/// A lever-up with everything that is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedLever {
    /// The plan.
    pub plan: LeverPlan,
    /// The tool that it names.
    pub tool: Arc<Tool>,
    /// What comes of it by prediction.
    pub predicted: LeverOutcome,
    /// Name of the model that says so.
    pub by: String,
    /// By what it was ranked before verification, the smaller the better.
    pub merit: f64,
    /// Whether it works in the simulator, if that was tried.
    pub verdict: Option<LeverVerdict>,
    /// How the pushes that follow were found, if there are any.
    pub pushed: Option<Arc<PushedAfter>>,
}

/// The task of pushes that a lever-up leaves, and its solution.
#[derive(Clone, Debug, PartialEq)]
pub struct PushedAfter {
    /// What is left to do: see [`Task::task_after`](crate::scene::Task::task_after).
    pub task: Task,
    /// Its solution, whose best plan follows the lever-up.
    pub solution: Solution,
}

/// Wall-clock time of each stage, seconds. Reported, never used to decide anything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct LeverTiming {
    /// Search.
    pub search: f64,
    /// Coarse simulation of the best.
    pub simulation: f64,
    /// Verification.
    pub verification: f64,
    /// Pushes that follow: their search and verification, and that of the whole.
    pub pushes: f64,
    /// Everything.
    pub total: f64,
}

/// What solving cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LeverStatistics {
    /// Of the search.
    pub search: LeverSearchStatistics,
    /// Candidates that were simulated coarsely.
    pub simulated: usize,
    /// Plans that were verified.
    pub verified: usize,
    /// Lever-ups after which pushes were looked for.
    pub followed: usize,
    /// Wall-clock times.
    pub timing: LeverTiming,
}

/// The result of [`LeverPlanner::solve`](super::LeverPlanner::solve).
#[derive(Clone, Debug, PartialEq)]
pub struct LeverSolution {
    /// How it ended.
    pub status: PlanStatus,
    /// Whether it was stopped before it was over: the plans are the best so far.
    pub stopped: bool,
    /// Ranked plans, the one to use first. Empty only if no lever-up can be made at all.
    pub plans: Vec<RankedLever>,
    /// What it cost.
    pub statistics: LeverStatistics,
}

impl LeverSolution {
    /// The plan to use: the verified one if solved, otherwise the nearest.
    pub fn best(&self) -> Option<&RankedLever> {
        self.plans.first()
    }
}
