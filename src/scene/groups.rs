//! Groups of objects that joints connect.

use super::{DisjointSets, Joint, JointKind, Physics};

/// Groups of objects that move as one body because fixed joints connect them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RigidGroups {
    /// Group index of every object; groups are in the order of their first objects.
    pub of: Vec<usize>,
    /// Objects of every group, in order; a single object also is a group.
    pub members: Vec<Vec<usize>>,
}

impl Physics {
    /// Returns for every object the lowest index in its group. Joints for which `counts` returns
    /// `true` connect objects to groups; objects with equal numbers move together.
    pub fn groups(&self, counts: impl Fn(&Joint) -> bool) -> Vec<usize> {
        let joints = self.joints.iter().filter(|joint| counts(joint));
        let pairs = joints.map(|joint| joint.between);
        DisjointSets::of(self.masses.len(), pairs).names().to_vec()
    }

    /// Returns the groups of objects that fixed joints connect.
    pub fn rigid_groups(&self) -> RigidGroups {
        let mut groups = RigidGroups::default();
        let lowest = self.groups(|joint| joint.kind == JointKind::Fixed);
        for (object, first) in lowest.into_iter().enumerate() {
            if first == object {
                groups.of.push(groups.members.len());
                groups.members.push(vec![object]);
            } else {
                let group = groups.of[first];
                groups.of.push(group);
                groups.members[group].push(object);
            }
        }
        groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn groups_follow_chains_in_any_order() {
        let joint = |between| Joint { between, kind: JointKind::Fixed, guessed: false };
        let mut physics = Physics {
            masses: vec![0.4; 6],
            frictions: vec![0.4; 6],
            table_friction: 0.4,
            pairs: Vec::new(),
            feet: Vec::new(),
            supports_known: true,
            push_height: None,
            joints: [[4, 5], [3, 4], [0, 3]].map(joint).to_vec(),
        };
        assert_eq!(physics.groups(|_| true), [0, 1, 2, 0, 0, 0]);
        assert_eq!(physics.groups(|joint| joint.between != [3, 4]), [0, 1, 2, 0, 4, 4]);
        assert_eq!(physics.groups(|_| false), [0, 1, 2, 3, 4, 5]);
        physics.joints[1].kind = JointKind::Revolute { at: Vector::zeros(), limits: None };
        let groups = physics.rigid_groups();
        assert_eq!(groups.of, [0, 1, 2, 0, 3, 3]);
        assert_eq!(groups.members, [vec![0, 3], vec![1], vec![2], vec![4, 5]]);
    }
}
