//! What a run may cost, and when it is content.

use serde::{Deserialize, Serialize};

use pushplan::task::{Noise, Truth};

use super::probe::ProbeRule;

/// What a run may cost, and when it is satisfied. All budgets are counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSettings {
    /// Most pushes; a plan of chained pushes, which cannot be parted, counts as one.
    pub pushes: usize,
    /// Samples of the belief under which plans are judged. Shares of 16 are off by a tenth.
    pub samples: usize,
    /// Share of the samples in which a plan must reach the goal to be carried out without doubt.
    pub enough: f64,
    /// Most pushes that are made only to learn something.
    pub probes: usize,
    /// How these are chosen.
    pub rule: ProbeRule,
    /// Samples that are planned for by themselves where no plan is good enough, one after another of
    /// those in which none reaches the goal.
    pub others: usize,
    /// Errors of what is seen.
    pub noise: Noise,
    /// Seed of the samples.
    pub seed: u64,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            pushes: 12,
            samples: 16,
            enough: 0.8,
            probes: 3,
            rule: ProbeRule::Task,
            others: 3,
            noise: Truth::NOISE,
            seed: 0,
        }
    }
}
