//! Adaptation of the planner's network to the table during a run.

use crate::fit::{Basis, HeadSettings, learn};
use crate::judge::Trial;
use pushplan::effect::{EffectModels, ModelError, Network};
use pushplan::scene::{ModelSpec, State, TableFit};

use super::runner::seen_at;
use super::trace::{Step, Trace};

/// Adapts the network to the pushes of a run; the initial fit stays unchanged.
pub(super) struct Learner {
    network: Network,
    given: Option<TableFit>,
}

impl Learner {
    /// Creates a learner for the network of `spec`, starting from the fit `given`; `None` without a
    /// network.
    pub fn new(spec: &ModelSpec, given: Option<TableFit>) -> Result<Option<Self>, ModelError> {
        let weights = EffectModels::weights_of(spec)?;
        Ok(weights.map(|weights| Self { network: Network::new(weights), given }))
    }

    /// Fits the network to all steps of a trace that began at `start`.
    ///
    /// Returns `None` if masses, frictions, supports or joints of the task are unknown, because the
    /// pushes then identify those first.
    pub fn learn(&self, trace: &Trace, start: &State) -> Result<Option<TableFit>, ModelError> {
        let Trace { task, settings, steps, .. } = trace;
        if task.unknown.any() || steps.is_empty() {
            return Ok(None);
        }
        let before = std::iter::once(start).chain(steps.iter().map(|step| &step.state));
        let trial = |(step, before): (&Step, &State)| {
            let scene = seen_at(&task.scene, before);
            Trial::to_rest(scene, step.motion(), step.state.poses.clone())
        };
        let trials = steps.iter().zip(before).map(trial);
        // A push that ended before its first stroke has moved no object.
        let trials: Vec<Trial> = trials.filter(|trial| !trial.motion.strokes.is_empty()).collect();
        if trials.is_empty() {
            return Ok(self.given.clone());
        }
        let basis = Basis::seen(&trials, settings.noise.position, self.given.as_ref());
        let fit = learn(&self.network, &trials, &basis, &HeadSettings::default());
        fit.map(Some).map_err(ModelError::Shipped)
    }
}
