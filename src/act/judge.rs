//! How good a plan is under samples of a belief.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::effect::EffectModel;
use crate::scene::{Job, Outcome, Physics, Plan, Record, Scene, Situation, Task, Tool};

/// A miss by more tolerances than this is no worse: one sample in which all goes wrong must not
/// outweigh the others.
const WORST: f64 = 10.0;

/// What is expected of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chance {
    /// Share of the samples in which it reaches the goal.
    pub share: f64,
    /// Mean error at its end in units of the tolerance.
    pub score: f64,
}

/// The situation under every sample: where things are is the same, what they are like is not.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub now: Situation,
    pub physics: Vec<Arc<Physics>>,
}

impl Samples {
    /// Jobs of a plan under all samples.
    pub fn jobs(&self, plan: &Plan, tool: &Arc<Tool>) -> Vec<Job> {
        let motion = plan.motion(tool);
        let job = |physics: &Arc<Physics>| Job {
            start: self.now.start.clone(),
            motion: motion.clone(),
            physics: Arc::clone(physics),
        };
        self.physics.iter().map(job).collect()
    }

    /// What is expected of plans with at least one push each.
    pub fn chances(
        &self,
        model: &dyn EffectModel,
        task: &Task,
        plans: &[(Plan, Arc<Tool>)],
    ) -> Vec<Chance> {
        let scene: &Scene = &self.now.scene;
        let jobs: Vec<Job> = plans.iter().flat_map(|(plan, tool)| self.jobs(plan, tool)).collect();
        let rolled = model.rollout(scene, &jobs, Record::Outcome);
        let outcomes: Vec<Outcome> =
            rolled.iter().map(|trajectory| Outcome::judge(&task.goal, trajectory)).collect();
        let count = self.physics.len().max(1);
        let chance = |outcomes: &[Outcome]| {
            let reached = outcomes.iter().filter(|outcome| outcome.reached).count();
            let score = |outcome: &Outcome| {
                let score = task.goal.score(&outcome.state);
                // A NaN is no smaller than anything.
                if score < WORST { score } else { WORST }
            };
            Chance {
                share: reached as f64 / count as f64,
                score: outcomes.iter().map(score).sum::<f64>() / count as f64,
            }
        };
        outcomes.chunks(count).map(chance).collect()
    }
}

impl Chance {
    /// Whether it is better than another: reaches the goal in more samples, or, in as many, ends
    /// nearer.
    pub fn beats(&self, other: &Self) -> bool {
        let (mine, theirs) = ((self.share, -self.score), (other.share, -other.score));
        mine.0 > theirs.0 || (mine.0 == theirs.0 && mine.1 > theirs.1)
    }
}
