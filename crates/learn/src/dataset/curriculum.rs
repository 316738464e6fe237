//! Blocks of the curriculum.
//!
//! Distributions change every 25 episodes, so that rare dynamics (for example a table full of
//! sliding joints) occur in concentration and can be learned (Tekden et al. 2021, arXiv
//! 2102.02100).

use pushplan::internals::seeded::generator;
use rand::Rng;

use super::config::DatasetConfig;
use super::constraints::JointRule;
use super::distributions::{uniform, weighted};
use super::tabletop::Solids;

/// Number of episodes in a block.
const BLOCK: u64 = 25;

/// Constant that separates the random numbers of blocks and episodes.
const SALT: u64 = 0x6375_7272_6963_756C;

/// Probability that near neighbours are joined in a constrained set, unless a loop would close.
const TEST_JOINED: f64 = 0.5;

/// Distributions in a block of crowds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Probability that an object is a cylinder.
    pub cylinders: f64,
    /// Probability that two near neighbours are joined, unless a loop would close.
    pub joined: f64,
    /// Weights of fixed, revolute and prismatic joints.
    pub kinds: [f64; 3],
}

impl Block {
    /// Returns the block of episode `index`. Its distributions depend only on the seed, `index /
    /// 25` and the constraints.
    pub fn of(config: &DatasetConfig, index: u64) -> Self {
        let mut rng = generator(config.seed ^ SALT, index / BLOCK);
        let mixed = uniform(&mut rng, 0.3, 0.7);
        let cylinders = [1.0, mixed, 0.0][weighted(&mut rng, &[0.40, 0.45, 0.15])];
        let (few, many) = (uniform(&mut rng, 0.15, 0.4), uniform(&mut rng, 0.6, 0.95));
        let joined = [0.0, few, many][weighted(&mut rng, &[0.20, 0.35, 0.45])];
        let any = [rng.random::<f64>(), rng.random(), rng.random()];
        let kinds = [[1.0, 1.0, 1.0], any, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            [weighted(&mut rng, &[0.25, 0.20, 0.25, 0.15, 0.15])];
        let (joined, kinds) = match config.constraints.joints {
            None => (joined, kinds),
            Some(JointRule::None) => (0.0, kinds),
            Some(JointRule::Fixed) => (TEST_JOINED, [1.0, 0.0, 0.0]),
            Some(JointRule::Mixed) => (TEST_JOINED, [1.0, 1.0, 1.0]),
        };
        let cylinders = match config.constraints.solids {
            None => cylinders,
            Some(Solids::Any) => 0.5,
            Some(Solids::Cylinders) => 1.0,
            Some(Solids::Cuboids) => 0.0,
        };
        Self { cylinders, joined, kinds }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn probabilities_change_between_blocks_and_not_within_one() {
        let config = DatasetConfig::default();
        let blocks: Vec<Block> = (0..100).map(|k| Block::of(&config, k * BLOCK)).collect();
        for (k, block) in blocks.iter().enumerate() {
            let first = k as u64 * BLOCK;
            assert!((first..first + BLOCK).all(|index| Block::of(&config, index) == *block));
        }
        let different: HashSet<String> = blocks.iter().map(|block| format!("{block:?}")).collect();
        assert!(different.len() > 60, "{}", different.len());
        let other = config.split(config.seed + 1, 1);
        assert!((0..4).any(|k| Block::of(&other, k * BLOCK) != blocks[k as usize]));
    }
}
