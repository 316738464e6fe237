//! How good a plan is under samples of a belief.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Outcome, Record, Trajectory, in_turn},
    scene::{Physics, Situation, Tool},
    task::{Job, Plan, Task, ToolMotion},
};

/// A miss by more tolerances than this is no worse: one sample in which everything goes wrong must
/// not outweigh the others.
const WORST: f64 = 10.0;

/// A plan with the tools that it names, the first one first.
pub(super) type Tooled = (Plan, Vec<Arc<Tool>>);

/// What is expected of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chance {
    /// Share of the samples in which it reaches the goal.
    pub share: f64,
    /// Mean error at its end in units of the tolerance.
    pub score: f64,
}

/// The situation under every sample: objects are at the same places, but have other physics.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub now: Situation,
    pub physics: Vec<Arc<Physics>>,
}

impl Samples {
    /// Jobs of a motion under all samples.
    pub fn jobs(&self, motion: &ToolMotion) -> Vec<Job> {
        let job = |physics: &Arc<Physics>| Job {
            start: self.now.start.clone(),
            motion: motion.clone().into(),
            physics: Arc::clone(physics),
        };
        self.physics.iter().map(job).collect()
    }

    /// The outcome of plans with at least one push each, in every sample.
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
            // A NaN is no smaller than anything.
            Reach { reached: outcome.reached, score: if score < WORST { score } else { WORST } }
        };
        let each = rolled.chunks(self.physics.len().max(1));
        each.map(|rolled| rolled.iter().map(reach).collect()).collect()
    }
}

/// The outcome of a plan in a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    /// Whether it reaches the goal.
    pub reached: bool,
    /// Error at its end in units of the tolerance.
    pub score: f64,
}

impl Chance {
    /// Over all samples.
    pub(super) fn of(reach: &[Reach]) -> Self {
        let count = reach.len().max(1) as f64;
        let reached = reach.iter().filter(|reach| reach.reached).count();
        Self {
            share: reached as f64 / count,
            score: reach.iter().map(|reach| reach.score).sum::<f64>() / count,
        }
    }

    /// Whether it is better than another: reaches the goal in more samples, or, in as many, ends
    /// nearer.
    pub fn beats(&self, other: &Self) -> bool {
        let (mine, theirs) = ((self.share, -self.score), (other.share, -other.score));
        mine.0 > theirs.0 || (mine.0 == theirs.0 && mine.1 > theirs.1)
    }
}
