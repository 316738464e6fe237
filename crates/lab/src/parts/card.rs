//! The network of parts of levered bodies: its tables and its weights file.
//!
//! The network propagates as for pushes. Nodes are the cuboids of a levered body, and relations are
//! joints between them and nearness of others. Even and odd refer to a mirror along the levered
//! edge, in the lever frame (x inward, y along the edge, z up).

use pushplan::internals::network::{
    Card, Config, Layout, Normaliser, Tables, Weights, WeightsError, check_config,
    check_normaliser, layout_of,
};
use serde::{Deserialize, Serialize};

/// The weights of a network of parts.
pub type PartsWeights = Weights<PartsCard>;

/// Columns of its tables. A node's output is the motion of the body. Displacements along x and z
/// and the rotation about y are even; the displacement along y and rotations about x and z are odd.
pub const PARTS: Tables =
    Tables { node: [19, 13], given: [0, 0], relation: [24, 8], output: [3, 3] };

/// Metadata of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartsCard {
    /// Network size.
    pub config: Config,
    /// Whether the network corrects the analytic model.
    pub prior: bool,
    /// Feature scales.
    pub normaliser: Normaliser,
    /// Number of lever-ups in its training set.
    pub episodes: u64,
    /// Number of optimiser steps taken.
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
