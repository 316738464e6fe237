//! Results on a test set, as plain data.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::progress::Progress;
use pushplan_act::judge::{Trial, TrialErrors};
use serde::{Deserialize, Serialize};

use super::family::{CrowdFamily, CrowdSet};

/// Errors of several models on a test set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdReport {
    /// Family of the set.
    pub family: CrowdFamily,
    /// Content of the scenes.
    pub set: CrowdSet,
    /// Seed of the set.
    pub seed: u64,
    /// Errors by model.
    #[serde(flatten)]
    pub errors: TrialErrors,
}

impl CrowdReport {
    /// Computes the errors of `models` on the trajectories of a test set, drawn with `seed`.
    /// `progress` receives the number of finished rollouts of each.
    pub fn of(
        (set, seed): (&CrowdSet, u64),
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        progress: &dyn Progress,
    ) -> Self {
        let errors = TrialErrors::of(set.title(), trials, models, progress);
        Self { family: set.family, set: *set, seed, errors }
    }
}
