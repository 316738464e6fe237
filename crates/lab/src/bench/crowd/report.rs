//! What was measured, as plain data.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::watch::Watch;
use pushplan_act::judge::{Trial, TrialErrors};
use serde::{Deserialize, Serialize};

use super::family::{CrowdFamily, CrowdSet};

/// Errors of several models on one test set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdReport {
    /// The set's family.
    pub family: CrowdFamily,
    /// What the scenes hold.
    pub set: CrowdSet,
    /// Seed of the set.
    pub seed: u64,
    /// What was measured.
    #[serde(flatten)]
    pub errors: TrialErrors,
}

impl CrowdReport {
    /// Errors of `models` on the trajectories of a test set, drawn with `seed`; `watch` is told
    /// the rollouts of each that are done.
    pub fn of(
        (set, seed): (&CrowdSet, u64),
        trials: &[Trial],
        models: &[Box<dyn EffectModel>],
        watch: &dyn Watch,
    ) -> Self {
        let errors = TrialErrors::of(set.title(), trials, models, watch);
        Self { family: set.family, set: *set, seed, errors }
    }
}
