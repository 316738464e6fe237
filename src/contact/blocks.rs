//! Partition of groups into blocks that are solved separately.

use super::{eliminated::Eliminated, index::GroupIndex};

/// Marker for the absence of a group.
pub(super) const NOBODY: GroupIndex = GroupIndex(usize::MAX);

/// Blocks of groups coupled by pressing contacts or by joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    /// Parent of every group in a disjoint-set forest; the first of a block is its own parent.
    first: Vec<usize>,
}

impl Blocks {
    /// Finds the blocks of `count` groups, of which these `pairs` press on each other.
    pub fn find(
        &mut self,
        count: usize,
        pairs: impl Iterator<Item = [GroupIndex; 2]>,
        joints: &Eliminated,
    ) {
        self.first.clear();
        self.first.extend((0..count).map(|group| joints.mechanism(GroupIndex(group))));
        for pair in pairs.filter(|pair| pair[1] != NOBODY) {
            let [a, b] = pair.map(|group| self.of(group));
            self.first[a.max(b)] = a.min(b);
        }
    }

    /// Returns the lowest group of the block of `group`.
    #[inline]
    pub fn of(&self, group: GroupIndex) -> usize {
        let mut at = group.0;
        while self.first[at] != at {
            at = self.first[at];
        }
        at
    }
}
