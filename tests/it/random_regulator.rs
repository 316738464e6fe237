//! Regulator with random weights.

use pushplan::network::Statistics;
use pushplan_act::regulator::{RegulatorCard, RegulatorWeights, fresh_regulator};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Returns random weights, none of them zero, with features of random scales.
pub fn random_weights(features: usize, width: usize) -> RegulatorWeights {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut parameters = fresh_regulator(features, width, 3);
    for value in parameters.values.values_mut().flatten() {
        *value += rng.random_range(-0.3..0.3);
    }
    let scales = Statistics {
        mean: (0..features).map(|_| rng.random_range(-1.0..1.0)).collect(),
        deviation: (0..features).map(|_| rng.random_range(0.5..2.0)).collect(),
    };
    let card = RegulatorCard { features, width, scales, data_seed: 1, episodes: 1, steps: 0 };
    RegulatorWeights { card, parameters }
}
