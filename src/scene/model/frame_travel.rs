//! The length of a frame.

/// Tool travel per frame while it moves, metres. A stroke is cut into equal frames of at most
/// this travel, so a slow and a fast push cost the same number of frames.
pub const FRAME_TRAVEL: f64 = 0.010;
