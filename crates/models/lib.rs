//! Trained weights of [pushplan](https://crates.io/crates/pushplan), as safetensors files that its
//! library reads. They are a crate of their own because they are most of what there is to download and
//! change less often than the code; the card beside each says what it was trained on and how exact it is.

/// The propagation network that predicts pushes, `brdpn.md`.
pub const BRDPN: &[u8] = include_bytes!("brdpn.safetensors");

/// The belief regulator, `regulator.md`.
pub const REGULATOR: &[u8] = include_bytes!("regulator.safetensors");

/// The network that corrects predicted lever-ups, `lever.md`.
pub const LEVER: &[u8] = include_bytes!("lever.safetensors");
