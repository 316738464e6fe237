//! Evaluation of plans under samples of a belief.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Outcome, Record, Trajectory, in_turn},
    scene::{Physics, Situation, Tool},
    task::{Job, Plan, Task, ToolMotion},
};

/// Upper bound of an error, in tolerances, so that a single failed sample does not outweigh the
/// others.
const WORST: f64 = 10.0;

/// Plan with the tools that it names, starting with the tool of its first push.
pub(super) type Tooled = (Plan, Vec<Arc<Tool>>);

/// Expected outcome of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chance {
    /// Share of the samples in which the plan reaches the goal.
    pub share: f64,
    /// Mean final error in units of the tolerance.
    pub score: f64,
}

/// Situation with one set of physics per sample; the poses are equal in all samples.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub now: Situation,
    pub physics: Vec<Arc<Physics>>,
}

impl Samples {
    /// Returns the jobs of a motion, one per sample.
    pub fn jobs(&self, motion: &ToolMotion) -> Vec<Job> {
        let job = |physics: &Arc<Physics>| Job {
            start: self.now.start.clone(),
            motion: motion.clone().into(),
            physics: Arc::clone(physics),
        };
        self.physics.iter().map(job).collect()
    }

    /// Returns the outcome of every plan in every sample. Each plan has at least one push.
    pub fn reach(&self, model: &dyn EffectModel, task: &Task, plans: &[Tooled]) -> Vec<Vec<Reach>> {
        let under = |physics: &Arc<Physics>, motions: &[ToolMotion]| {
            let now = Situation { physics: Arc::clone(physics), ..self.now.clone() };
            Job::sequence(&now, motions)
        };
        let all: Vec<Vec<Job>> = plans
            .iter()
            .flat_map(|(plan, tools)| {
                let motions = plan.slides(tools).unwrap_or_default();
                self.physics.iter().map(|physics| under(physics, &motions)).collect::<Vec<_>>()
            })
            .collect();
        let run = |jobs: &[Job]| model.rollout(&self.now.scene, jobs, Record::Outcome);
        let rolled = in_turn(&all, Record::Outcome, run);
        let reach = |trajectory: &Trajectory| {
            let outcome = Outcome::judge(&task.scene, task, trajectory);
            let score = task.score(&outcome.state);
            // The comparison is false for a NaN.
            Reach { reached: outcome.reached, score: if score < WORST { score } else { WORST } }
        };
        let each = rolled.chunks(self.physics.len().max(1));
        each.map(|rolled| rolled.iter().map(reach).collect()).collect()
    }
}

/// Outcome of a plan in one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Whether the plan reaches the goal.
    pub reached: bool,
    /// Final error in units of the tolerance.
    pub score: f64,
}

impl Chance {
    /// Averages the outcomes over all samples.
    pub(super) fn of(reach: &[Reach]) -> Self {
        let count = reach.len().max(1) as f64;
        let reached = reach.iter().filter(|reach| reach.reached).count();
        Self {
            share: reached as f64 / count,
            score: reach.iter().map(|reach| reach.score).sum::<f64>() / count,
        }
    }

    /// Returns `true` if `self` reaches the goal in more samples than `other`, or in equally many
    /// with a smaller mean error.
    pub fn beats(&self, other: &Self) -> bool {
        let (mine, theirs) = ((self.share, -self.score), (other.share, -other.score));
        mine.0 > theirs.0 || (mine.0 == theirs.0 && mine.1 > theirs.1)
    }
}
