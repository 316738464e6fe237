//! The length of a frame.

/// Maximum tool travel in a frame, metres. A stroke is divided into equal frames, so a slow and a
/// fast push have the same number of frames.
pub const FRAME_TRAVEL: f64 = 0.010;
