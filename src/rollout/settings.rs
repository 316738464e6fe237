//! Settings of a rollout.

/// How finely a rollout goes, and whether it looks at everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RollSettings {
    /// Frames of a moving tool (see [`crate::scene::FRAME_TRAVEL`]) that are predicted as one,
    /// at least 1. The states between are interpolated, so that a trajectory has the same
    /// frames whatever the stride.
    pub stride: usize,
    /// Whether bodies that the motion cannot reach, not even through others, and frames in
    /// which nothing can touch are left out. The results are the same bits.
    pub pruned: bool,
    /// Most objects that may be awake in a frame whose prior is corrected.
    pub corrected: usize,
}

impl Default for RollSettings {
    fn default() -> Self {
        Self { stride: 1, pruned: true, corrected: usize::MAX }
    }
}
