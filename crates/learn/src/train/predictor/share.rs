//! Scaling of the trained correction for all sources of ground truth.
//!
//! If ground truths disagree and outcomes are partly random, one-frame losses decrease with
//! corrections that make whole pushes worse. The last layer is therefore scaled after training, by
//! a share of 0 to 1. A share is rejected if it is significantly worse than the analytic model on a
//! held-out set. Among the remaining shares, the one with the smallest error over all held-out sets
//! is chosen.

use pushplan::internals::effect::Network;
use pushplan::internals::network::PredictorWeights;
use pushplan::internals::progress::Progress;

use crate::dataset::Dataset;

use super::{HeldOutError, rollout_error};

/// Candidate shares in addition to zero.
const SHARES: [f32; 6] = [0.15, 0.3, 0.45, 0.6, 0.8, 1.0];

/// Relative difference below which errors on held-out sets of some hundred pushes are not
/// significant.
const CHANCE: f64 = 0.01;

/// Returns the best share of the correction for all of `sets`, with the weights scaled by it. The
/// share is zero if no other share is better.
pub(super) fn shared(
    weights: &PredictorWeights,
    sets: &[Dataset],
    progress: &dyn Progress,
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
        progress
            .line(&format!("share {share}: errors relative to the analytic model {ratios:.3?}"));
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
