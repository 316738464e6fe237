//! How much of a trained correction counts: as much as serves every truth.
//!
//! Where truths disagree and much is decided by chance, one-frame losses fall with corrections that
//! make whole pushes worse. So the last layer is scaled once the weights are trained: of a few
//! shares the one with the least error over the held-out sets counts, and of these only one that
//! leaves no set with an error larger than the prior's by more than chance.

use pushplan::internals::effect::Network;
use pushplan::internals::network::PredictorWeights;
use pushplan::internals::watch::Watch;

use crate::dataset::Dataset;

use super::{HeldOutError, rollout_error};

/// The shares that are tried, after none.
const SHARES: [f32; 6] = [0.15, 0.3, 0.45, 0.6, 0.8, 1.0];

/// Held-out sets of some hundred pushes tell no smaller difference from chance.
const CHANCE: f64 = 0.01;

/// The weights with the share of their correction that serves all of `sets`, and that share; none if
/// no other does.
pub(super) fn shared(
    weights: &PredictorWeights,
    sets: &[Dataset],
    watch: &dyn Watch,
) -> (PredictorWeights, f32) {
    let errors = |share: f32| {
        let error = rollout_error(&Network::new(scaled(weights, share)), sets);
        let each = |set: &HeldOutError| set.capped;
        if error.sets.is_empty() {
            vec![error.capped]
        } else {
            error.sets.iter().map(each).collect()
        }
    };
    let alone = errors(0.0);
    let mut best = (0.0, 1.0);
    for share in SHARES {
        let ratios: Vec<f64> =
            errors(share).iter().zip(&alone).map(|(own, prior)| own / prior.max(1e-9)).collect();
        watch.line(&format!("share {share}: errors over the prior's {ratios:.3?}"));
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        if ratios.iter().all(|ratio| *ratio <= 1.0 + CHANCE) && mean < best.1 {
            best = (share, mean);
        }
    }
    (scaled(weights, best.0), best.0)
}

fn scaled(weights: &PredictorWeights, share: f32) -> PredictorWeights {
    let mut weights = weights.clone();
    for name in ["motion.even", "motion.odd"] {
        if let Some(values) = weights.parameters.values.get_mut(name) {
            values.iter_mut().for_each(|value| *value *= share);
        }
    }
    weights
}
