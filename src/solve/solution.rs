//! The result of solving a task.

use std::borrow::Cow;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;
use crate::plan::lever::LeverSearchStatistics;
use crate::plan::{RefineStatistics, ScoredPush, SearchStatistics};
use crate::verify::{Verifier, VerifySettings};
use crate::{
    outcome::{Outcome, Trajectory, Verdict, Warning},
    scene::{JointTrajectory, Models, Physics, Situation, Tool},
    task::{Plan, Task},
};

use super::Cause;

/// Status of the solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlanStatus {
    /// The first plan passes: it keeps the rules of the task, its replays as written reach the goal
    /// in both engines, and so does the share of the disturbed ones that the task asks for.
    Solved,
    /// The first plan works as written, but in fewer of the disturbed replays than the task asks
    /// for, and none was found that is more robust.
    Fragile,
    /// Not all of several goals could be met; the first plan meets [some](Solution::partial), and as such it
    /// passes.
    Partial,
    /// After refinement no candidate's predicted error was at most the tolerance plus the effect
    /// model's 95th-percentile error. The first plan is the nearest one.
    NoPlan,
    /// Some candidates were good enough to be verified, and none of those works. The first plan
    /// is the best predicted of them, with the evidence against it.
    FailedVerification,
}

/// Refinement of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refinement {
    /// How far from where it was aimed the middle of the predicted ends on plausible supports lay
    /// as the search left it, metres.
    pub before: f64,
    /// Distance of that middle from its aim now.
    pub after: f64,
    /// Where the plan was aimed instead of the goal, metres, because its replay in 3-D missed the
    /// goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aimed_at: Option<Vector>,
    /// Score of that middle (error in units of the tolerance) after each round.
    pub rounds: Vec<f64>,
}

/// A plan with everything that is known about it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankedPlan {
    /// The plan.
    pub plan: Plan,
    /// The tools that it names, each once, in the order in which they are used; of a plan without
    /// steps the first that was offered.
    #[serde(with = "shared")]
    pub tools: Vec<Arc<Tool>>,
    /// Predicted trajectory, frame by frame.
    pub predicted: Trajectory,
    /// Outcome at its end.
    pub outcome: Outcome,
    /// Whether it works in the simulator, if that was tried.
    pub verdict: Option<Verdict>,
    /// Effect of refinement.
    pub refinement: Refinement,
    /// Motion of the arm, where the task has one that can carry it out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joints: Option<JointTrajectory>,
}

impl RankedPlan {
    /// Its first tool.
    ///
    /// # Panics
    /// Never for a plan that a planner returned: those have at least one tool.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.tools[0]
    }

    /// Its nominal replays in both engines: those of the verdict, or ones made now from
    /// `situation` where the plan was not worth verifying.
    pub fn replays(&self, task: &Task, situation: &Situation) -> Cow<'_, Verdict> {
        match &self.verdict {
            Some(verdict) => Cow::Borrowed(verdict),
            None => {
                let verifier = Verifier::new(VerifySettings { disturbed: 0, seed: 0 });
                Cow::Owned(verifier.nominal(task, situation, &self.tools, &self.plan))
            }
        }
    }
}

impl RankedPlan {
    /// Whether the plan, as written, works in both engines on whatever the objects may rest.
    pub fn works_on_all_supports(&self, task: &Task, situation: &Situation) -> bool {
        let verifier = Verifier::new(VerifySettings { disturbed: 0, seed: 0 });
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
    /// Candidates that were simulated coarsely.
    pub simulated: usize,
    /// Plans that were verified.
    pub verified: usize,
    /// Lever-ups after which pushes were looked for.
    pub followed: usize,
}

/// Wall-clock time of each stage, seconds. Reported, never used to decide anything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Search.
    pub search: f64,
    /// Refinement.
    pub refinement: f64,
    /// Replays in the simulator.
    pub verification: f64,
    /// Everything.
    pub total: f64,
}

/// Cost of solving.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Statistics of the search.
    pub search: SearchStatistics,
    /// Statistics of the refinement.
    pub refinement: RefineStatistics,
    /// Number of rollouts of the effect models.
    pub rollouts: usize,
    /// Number of these by the final model; all, where no other one screens.
    #[serde(default)]
    pub decided: usize,
    /// Plans replayed in the simulator.
    pub verified: usize,
    /// Pushes of the longest plans that were looked at.
    pub depth: usize,
    /// Wall-clock times.
    pub timing: Timing,
    /// Cost of lever-ups, where a task allows them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub levers: Option<LeverStatistics>,
}

impl Statistics {
    /// Adds what was spent before on the same question.
    pub(super) fn add(&mut self, before: &Self) {
        self.rollouts += before.rollouts;
        self.decided += before.decided;
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
    /// The goals that it meets, by their indices.
    pub met: Vec<usize>,
    /// Share of the disturbed replays that meet these.
    pub robustness: Option<f64>,
}

/// The result of [`super::Planner::solve`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// Status.
    pub status: PlanStatus,
    /// Whether it was stopped, by its time limit or from outside, before the search was over: the
    /// plans are the best so far.
    pub stopped: bool,
    /// Screening and final model.
    pub models: Models,
    /// Ranked plans, the one to use first. Empty only if no push can be made at all.
    pub plans: Vec<RankedPlan>,
    /// The tools that were offered; candidates name them by index.
    pub tools: Vec<Tool>,
    /// Every way to push that the search considered, with the best that it leads to.
    pub candidates: Vec<ScoredPush>,
    /// Cost.
    pub statistics: Statistics,
    /// Goals that are met, where not all of several are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub partial: Option<Partial>,
    /// Reason why there is no plan, where that was looked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<Cause>,
    /// Warnings that lower the trust in the predictions of the first plan.
    pub warnings: Vec<Warning>,
}

impl Solution {
    /// The plan to use: the verified one if solved, otherwise the nearest.
    pub fn best(&self) -> Option<&RankedPlan> {
        self.plans.first()
    }
}

/// Shared tools are written as the tools themselves.
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
