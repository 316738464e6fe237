//! Images of a plate as network inputs.

use std::fmt;

use pushplan::internals::scene::LeverFeatures;
use serde::{Deserialize, Serialize};

/// Images of a plate (Tekden 2020, chapter 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ImageFeatures {
    /// A mask of the plate from above, whose features a convolutional network learns.
    Image,
    /// The mask in the code of an autoencoder, which is trained without lever-ups.
    ImageCode,
    /// The shape context as an image of rings and wedges, by a convolutional network.
    ContextImage,
    /// Height of everything above the table, from above, by a convolutional network.
    Depth,
}

impl ImageFeatures {
    /// Rows and columns of a mask or a depth image.
    pub const PIXELS: [usize; 2] = [64, 64];

    /// Returns rows and columns of the image.
    pub fn extents(self) -> [usize; 2] {
        match self {
            Self::Image | Self::ImageCode | Self::Depth => Self::PIXELS,
            Self::ContextImage => LeverFeatures::BINS,
        }
    }
}

impl fmt::Display for ImageFeatures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Image => "image CNN",
            Self::ImageCode => "image autoencoder",
            Self::ContextImage => "shape context CNN",
            Self::Depth => "depth image CNN",
        })
    }
}
