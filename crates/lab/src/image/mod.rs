//! Networks of lever-ups that see the plate from above (Tekden 2020, chapter 6).
//!
//! A long short-term memory like the shipped one, `pushplan::internals::network::LeverCell`. Its
//! gates receive the code of an image instead of features of the shape. The code comes from
//! convolutions, which are trained together with the memory, or before it in an autoencoder.
//!
//! Rejected: support points, which cost nothing to compute, are more informative
//! (`crates/models/lever.md`, from images).

mod autoencoder;
mod card;
mod convolution;
mod drawn;
mod example;
mod features;
mod graph;
mod model;
mod train;

pub use card::{CODE, ImageCard, ImageWeights, fresh_image};
pub use convolution::{Convolution, ImageSizes, fresh_bound, image_code, image_layout};
pub use drawn::lever_image;
pub use example::image_inputs;
pub use features::ImageFeatures;
pub use graph::{Autoencoder, ImageGraph, autoencoder_layout, fresh_autoencoder};
pub use model::ImageNetwork;
pub use train::{ImageSettings, train_image};
