//! Trained weights of [pushplan](https://crates.io/crates/pushplan), as safetensors files that its
//! library reads.
//!
//! They are a separate crate because they are most of the download and change less often than the
//! code. The model card beside each file describes its training data and its accuracy.

/// Propagation network that predicts pushes, `brdpn.md`.
pub const BRDPN: &[u8] = include_bytes!("brdpn.safetensors");

/// Belief regulator, `regulator.md`.
pub const REGULATOR: &[u8] = include_bytes!("regulator.safetensors");

/// Network that corrects predicted lever-ups, `lever.md`.
pub const LEVER: &[u8] = include_bytes!("lever.safetensors");
