//! Which measured level each effort stands for.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::solve::{Effort, Settings};

use super::{front::Noise, measured::PlanRow};

/// Draft may fail this much more often than the best level, as a share.
const DRAFT_LOSS: f64 = 0.10;

/// A level of planning by name, with what it is made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffortChoice {
    /// Name of the level.
    pub level: String,
    /// Name of its effect model.
    pub model: String,
    /// Its budgets.
    pub settings: Settings,
}

/// The efforts among the levels on the front. Exhaustive is the most successful one; thorough the
/// cheapest that is as good within the noise, standard within twice the noise, draft within ten
/// per cent.
pub fn choose_efforts(plans: &[PlanRow], noise: Noise) -> BTreeMap<Effort, EffortChoice> {
    let front = || plans.iter().filter(|row| row.on_front);
    let best = front().map(|row| row.success).fold(0.0, f64::max);
    let losses = [
        (Effort::Draft, DRAFT_LOSS.max(2.0 * noise.error)),
        (Effort::Standard, 2.0 * noise.error),
        (Effort::Thorough, noise.error),
        (Effort::Exhaustive, 0.0),
    ];
    losses
        .into_iter()
        .filter_map(|(effort, loss)| {
            let good = front().filter(|row| row.success >= best - loss);
            let cheapest = good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
            let level = &cheapest.level;
            let (model, settings) = (level.model.clone(), level.settings);
            Some((effort, EffortChoice { level: level.name.clone(), model, settings }))
        })
        .collect()
}
