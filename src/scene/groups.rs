//! Which objects joints connect.

use super::{Joint, Scene};

impl Scene {
    /// For every object the lowest index among those that the joints chosen by `counts`
    /// connect it with, itself included: objects with the same number move as one group.
    pub fn groups(&self, counts: impl Fn(&Joint) -> bool) -> Vec<usize> {
        let mut lowest: Vec<usize> = (0..self.objects.len()).collect();
        // Each round carries a number across at least one more joint.
        for _ in 0..self.objects.len() {
            for joint in self.joints.iter().filter(|joint| counts(joint)) {
                let [a, b] = joint.between;
                let low = lowest[a].min(lowest[b]);
                (lowest[a], lowest[b]) = (low, low);
            }
        }
        lowest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose, Shape};
    use crate::scene::{JointKind, Object};

    #[test]
    fn groups_follow_chains_in_any_order() {
        let object = Object {
            name: "a".into(),
            shape: Shape::Cylinder { radius: 0.05, height: 0.1 },
            mass: 0.4,
            friction: 0.4,
            pose: Pose::default(),
        };
        let joint = |between| Joint { between, kind: JointKind::Fixed, guessed: false };
        let scene = Scene {
            objects: vec![object; 6],
            joints: [[4, 5], [3, 4], [0, 3]].map(joint).to_vec(),
            ..Scene::default()
        };
        assert_eq!(scene.groups(|_| true), [0, 1, 2, 0, 0, 0]);
        assert_eq!(scene.groups(|joint| joint.between != [3, 4]), [0, 1, 2, 0, 4, 4]);
        assert_eq!(scene.groups(|_| false), [0, 1, 2, 3, 4, 5]);
    }
}
