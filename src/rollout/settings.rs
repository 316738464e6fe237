//! Settings of a rollout.

/// Resolution and pruning of a rollout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RollSettings {
    /// Number of frames of a moving tool (see [`crate::scene::FRAME_TRAVEL`]) predicted as one, at
    /// least 1. The states between are interpolated, so that a trajectory has the same frames for
    /// every stride.
    pub stride: usize,
    /// Whether to skip frames without possible contact, and bodies that the motion cannot reach,
    /// not even through others. The results are bitwise equal.
    pub pruned: bool,
    /// Maximum number of awake objects in a frame that the network corrects.
    pub corrected: usize,
}

impl Default for RollSettings {
    fn default() -> Self {
        Self { stride: 1, pruned: true, corrected: usize::MAX }
    }
}
