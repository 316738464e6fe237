//! Solution of a task.

use std::borrow::Cow;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::asset::PlanFile;
use crate::geometry::Vector;
use crate::plan::lever::LeverSearchStatistics;
use crate::plan::{RefineStatistics, ScoredPush, SearchStatistics};
use crate::verify::{Verifier, VerifySettings};
use crate::{
    outcome::{Outcome, Trajectory, Verdict, Warning},
    scene::{JointTrajectory, ModelSpec, Physics, Situation, Tool},
    task::{Plan, Task},
};

use super::Cause;

/// Status of the solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlanStatus {
    /// The first plan passes: it satisfies the rules of the task, its nominal replays reach the
    /// goal in both engines, and so does the required share of perturbed replays.
    Solved,
    /// The first plan works as written, but in fewer perturbed replays than required, and no more
    /// robust plan was found.
    Fragile,
    /// Not all goals could be met. The first plan meets [some](Solution::partial) of them, and
    /// passes for these.
    Partial,
    /// After refinement, no candidate's predicted error was at most the tolerance plus the effect
    /// model's 95th-percentile error. The first plan is the nearest one.
    NoPlan,
    /// Some candidates were good enough to verify, but none of them works. The first plan is the
    /// one with the best prediction, with the evidence against it.
    FailedVerification,
}

/// Refinement of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refinement {
    /// Distance from the aim to the centre of the predicted final poses over plausible support
    /// models before refinement, metres.
    pub before: f64,
    /// Distance from the aim to this centre after refinement, metres.
    pub after: f64,
    /// Position at which the plan was aimed instead of the goal, metres, because its replay in 3-D
    /// missed the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aimed_at: Option<Vector>,
    /// Score of this centre (error in units of the tolerance) after each round.
    pub rounds: Vec<f64>,
}

/// Plan with its prediction, verdict and refinement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankedPlan {
    /// The plan.
    pub plan: Plan,
    /// Tools that the plan names, in the order of their first use. A plan without steps has the
    /// first offered tool.
    #[serde(with = "shared")]
    pub tools: Vec<Arc<Tool>>,
    /// Predicted trajectory, frame by frame.
    pub predicted: Trajectory,
    /// Outcome at the end of the trajectory.
    pub outcome: Outcome,
    /// Verdict of the replays in the simulator, if any were made.
    pub verdict: Option<Verdict>,
    /// Effect of refinement.
    pub refinement: Refinement,
    /// Joint trajectory of the arm, if the task has an arm that can execute the plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joints: Option<JointTrajectory>,
}

impl RankedPlan {
    /// Returns the first tool.
    ///
    /// # Panics
    /// Never for a plan returned by a planner, which has at least one tool.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.tools[0]
    }

    /// Returns the nominal replays in both engines. They are taken from the verdict, or made from
    /// `situation` if the plan was not verified.
    pub fn replays(&self, task: &Task, situation: &Situation) -> Cow<'_, Verdict> {
        match &self.verdict {
            Some(verdict) => Cow::Borrowed(verdict),
            None => {
                let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
                Cow::Owned(verifier.nominal(task, situation, &self.tools, &self.plan))
            }
        }
    }
}

impl RankedPlan {
    /// Returns the file of this plan for `task`, with its prediction and verdict.
    ///
    /// ```no_run
    /// # use pushplan::{Error, RankedPlan, Task};
    /// # fn saved(task: &Task, best: &RankedPlan) -> Result<(), Error> {
    /// best.to_file(task).write("my-task.plan.json")?;
    /// # Ok(())
    /// # }
    /// ```
    pub fn to_file(&self, task: &Task) -> PlanFile {
        PlanFile {
            model: Some(self.predicted.by.clone()),
            predicted: Some(self.outcome.clone()),
            verdict: self.verdict.clone(),
            joints: self.joints.clone(),
            ..PlanFile::new(task.clone(), self.tools.clone(), self.plan.clone())
        }
    }

    /// Returns `true` if the plan as written works in both engines with every plausible support
    /// model.
    pub fn works_on_all_supports(&self, task: &Task, situation: &Situation) -> bool {
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        Physics::PLAUSIBLE_SUPPORTS.iter().all(|support| {
            let mut situation = situation.clone();
            Arc::make_mut(&mut situation.physics).support_all(&situation.scene, support);
            verifier.nominal(task, &situation, &self.tools, &self.plan).passed
        })
    }
}

/// Cost of searching lever-ups.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LeverStatistics {
    /// Statistics of the last search.
    pub search: LeverSearchStatistics,
    /// Number of candidates simulated coarsely.
    pub simulated: usize,
    /// Number of verified plans.
    pub verified: usize,
    /// Number of lever-ups followed by a search for pushes.
    pub followed: usize,
}

/// Wall-clock time of each stage, seconds. It is reported only and does not affect results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Time of the search.
    pub search: f64,
    /// Time of the refinement.
    pub refinement: f64,
    /// Time of the replays in the simulator.
    pub verification: f64,
    /// Total time.
    pub total: f64,
}

/// Cost of the solution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Statistics of the search.
    pub search: SearchStatistics,
    /// Statistics of the refinement.
    pub refinement: RefineStatistics,
    /// Number of rollouts of the effect model.
    pub rollouts: usize,
    /// Number of plans replayed in the simulator.
    pub verified: usize,
    /// Number of pushes of the longest plans searched.
    pub depth: usize,
    /// Whether the budgets of a first attempt did not suffice.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub escalated: bool,
    /// Wall-clock times.
    pub timing: Timing,
    /// Cost of lever-ups, if the task allows them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levers: Option<LeverStatistics>,
}

impl Statistics {
    /// Adds the cost of earlier work on the same task.
    pub(super) fn add(&mut self, before: &Self) {
        self.escalated |= before.escalated;
        self.rollouts += before.rollouts;
        self.verified += before.verified;
        let (timing, spent) = (&mut self.timing, &before.timing);
        timing.search += spent.search;
        timing.refinement += spent.refinement;
        timing.verification += spent.verification;
        timing.total += spent.total;
    }
}

/// Evidence for a plan that meets some of several goals.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Partial {
    /// Indices of the goals that the plan meets.
    pub met: Vec<usize>,
    /// Share of the perturbed replays that meet these goals.
    pub robustness: Option<f64>,
}

/// Result of [`super::Planner::solve`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// Status of the solution.
    pub status: PlanStatus,
    /// Whether the search was stopped early by its time limit or from outside, so that the plans
    /// are the best found until then.
    pub stopped: bool,
    /// Effect model.
    pub model: ModelSpec,
    /// Ranked plans, best first. Empty only if no push can be made at all.
    pub plans: Vec<RankedPlan>,
    /// Offered tools; candidates name them by index.
    pub tools: Vec<Tool>,
    /// Every kind of push considered by the search, with its best score.
    pub candidates: Vec<ScoredPush>,
    /// Cost of the solution.
    pub statistics: Statistics,
    /// Goals that are met, if not all of several are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<Partial>,
    /// Cause if there is no plan and the cause was searched for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<Cause>,
    /// Warnings that lower the trust in the predictions of the first plan.
    pub warnings: Vec<Warning>,
}

impl Solution {
    /// Returns the plan to use: the verified plan if solved, otherwise the nearest.
    pub fn best(&self) -> Option<&RankedPlan> {
        self.plans.first()
    }
}

/// Serialisation of shared tools as plain tools.
mod shared {
    use std::sync::Arc;

    use serde::{Deserialize, Deserializer, Serializer};

    use crate::scene::Tool;

    pub fn serialize<S: Serializer>(tools: &[Arc<Tool>], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(tools.iter().map(|tool| &**tool))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<Arc<Tool>>, D::Error> {
        Ok(Vec::<Tool>::deserialize(deserializer)?.into_iter().map(Arc::new).collect())
    }
}
