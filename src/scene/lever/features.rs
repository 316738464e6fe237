//! Shape features that are inputs of models of lever-ups.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Shape features (Tekden 2020, chapter 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverFeatures {
    /// No shape features.
    Nothing,
    /// Counts of outline points in 10 rings and 11 wedges of the half-plane before the lever point;
    /// they do not contain the size of the plate.
    ShapeContext,
    /// Up to 10 corners, counter-clockwise from the end of the levered edge, and the centre of
    /// mass.
    Corners,
    /// The ends of the support edge, and the centre of mass.
    Support,
    /// Corners and support.
    Shape,
}

impl LeverFeatures {
    /// Maximum number of corners; outlines with more are sampled at even distances.
    pub const CORNERS: usize = 10;

    /// Numbers of rings and wedges of a shape context.
    pub const BINS: [usize; 2] = [10, 11];

    /// Number of action features: depth, pivot, angle, thickness and two frictions.
    pub const ACTION: usize = 6;

    /// Index of the thickness among the action features.
    pub const THICKNESS: usize = 3;

    /// Returns the number of shape features.
    pub fn count(self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::ShapeContext => Self::BINS[0] * Self::BINS[1],
            Self::Corners => 2 * Self::CORNERS + 2,
            Self::Support => 7,
            Self::Shape => 2 * Self::CORNERS + 9,
        }
    }
}

impl fmt::Display for LeverFeatures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nothing => "no shape",
            Self::ShapeContext => "shape context",
            Self::Corners => "corners",
            Self::Support => "support points",
            Self::Shape => "corners and support points",
        })
    }
}
