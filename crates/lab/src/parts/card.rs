//! The network of parts that are levered: its tables and its weights file.
//!
//! Propagation as of pushes, on nodes that are the cuboids of a levered body and relations that are
//! joints between them and nearness of others. Even and odd are meant under a mirror along the levered
//! edge, in the lever frame (x inward, y along the edge, z up).

use pushplan::internals::network::{
    Card, Config, Layout, Normaliser, Tables, Weights, WeightsError, check_config,
    check_normaliser, layout_of,
};
use serde::{Deserialize, Serialize};

/// The weights of a network of parts.
pub type PartsWeights = Weights<PartsCard>;

/// Columns of its tables. What is read from a node is how the body moves: of ways x and z and of the
/// turn y are even, of ways y and of the turn x and z are odd.
pub const PARTS: Tables =
    Tables { node: [19, 13], given: [0, 0], relation: [24, 8], output: [3, 3] };

/// What the weights are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartsCard {
    /// Network size.
    pub config: Config,
    /// Whether it corrects the prior.
    pub prior: bool,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Lever-ups that it was trained on.
    pub episodes: u64,
    /// Optimiser steps taken.
    pub steps: u64,
}

impl Card for PartsCard {
    const KEY: &'static str = "pushplan-parts";
    const FORMAT: u32 = 1;

    fn check(&self) -> Result<(), WeightsError> {
        check_config(self.config)?;
        check_normaliser(&self.normaliser, &PARTS)
    }

    fn layout(&self) -> Layout {
        layout_of(&PARTS, &self.config)
    }
}
