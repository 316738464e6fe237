//! Timed prediction of one action by one effect model.

use std::time::Instant;

use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory, Warning},
    scene::Scene,
    task::Job,
};

/// Timed prediction of an action.
#[derive(Clone, Debug)]
pub struct TimedEffect {
    /// Predicted trajectory.
    pub trajectory: Trajectory,
    /// Warnings about the prediction, from the model's range and from the rollout, without
    /// duplicates.
    pub warnings: Vec<Warning>,
    /// Wall time of the rollout, seconds.
    pub seconds: f64,
}

/// Rolls out a job with a model; returns `None` if the model declines the job.
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
