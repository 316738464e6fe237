//! Budgets and acceptance thresholds of a run.

use serde::{Deserialize, Serialize};

use pushplan::task::{Noise, Truth};

use super::probe::ProbeRule;

/// Budgets and acceptance thresholds of a run. All budgets are counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSettings {
    /// Maximum number of pushes; an indivisible plan of chained pushes counts as one.
    pub max_pushes: usize,
    /// Number of belief samples under which plans are judged. The standard error of a share of 16
    /// samples is about 0.1.
    pub samples: usize,
    /// Share of the samples in which a plan must reach the goal to be carried out without
    /// exploration.
    pub min_success: f64,
    /// Maximum number of exploratory pushes.
    pub max_probes: usize,
    /// Rule for choosing exploratory pushes.
    pub probe_rule: ProbeRule,
    /// Maximum number of samples planned for individually if no plan is good enough. Each is a
    /// sample in which no plan reaches the goal.
    pub others: usize,
    /// Noise of the observations.
    pub noise: Noise,
    /// Seed of the belief samples.
    pub seed: u64,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            max_pushes: 12,
            samples: 16,
            min_success: 0.8,
            max_probes: 3,
            probe_rule: ProbeRule::Task,
            others: 3,
            noise: Truth::NOISE,
            seed: 0,
        }
    }
}
