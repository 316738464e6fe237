//! One action by one effect model, timed.

use std::time::Instant;

use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory, Warning},
    scene::Scene,
    task::Job,
};

/// What a model says of an action.
#[derive(Clone, Debug)]
pub struct TimedEffect {
    /// Where everything ends.
    pub trajectory: Trajectory,
    /// What lowers the trust in it, known before or seen on the way, each once.
    pub warnings: Vec<Warning>,
    /// Wall time of the rollout, seconds.
    pub seconds: f64,
}

/// Rolls a job out by a model; `None` if it gives no trajectory.
pub fn timed_effect(model: &dyn EffectModel, scene: &Scene, job: &Job) -> Option<TimedEffect> {
    let began = Instant::now();
    let found = model.rollout(scene, std::slice::from_ref(job), Record::Outcome);
    let seconds = began.elapsed().as_secs_f64();
    let trajectory = found.into_iter().next()?;
    let mut warnings = model.trust(scene, job).warnings();
    for warning in &trajectory.warnings {
        if !warnings.contains(warning) {
            warnings.push(warning.clone());
        }
    }
    Some(TimedEffect { trajectory, warnings, seconds })
}
