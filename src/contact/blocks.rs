//! Which groups are solved together, and which separately.

use super::{eliminated::Eliminated, index::GroupIndex};

/// No group.
pub(super) const NOBODY: GroupIndex = GroupIndex(usize::MAX);

/// Which groups feel each other's forces, through contacts that press or through joints.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    /// For every group one of those solved with it, itself if it is the first.
    first: Vec<usize>,
}

impl Blocks {
    /// Of a number of groups, of which these `pairs` press on each other.
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

    /// The lowest group that `group` is together with.
    #[inline]
    pub fn of(&self, group: GroupIndex) -> usize {
        let mut at = group.0;
        while self.first[at] != at {
            at = self.first[at];
        }
        at
    }
}
