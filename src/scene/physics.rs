//! What is believed about the objects of a scene: masses, frictions and joints.

use super::{Joint, Scene};

/// Physical parameters under which a motion is played. What computes effects reads these and not
/// what the scene states, so that several beliefs about one scene can be rolled out side by side.
///
/// A tool's friction belongs to the tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Physics {
    /// Mass of every object, kg.
    pub masses: Vec<f64>,
    /// Friction value of every object.
    pub frictions: Vec<f64>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// Joints between objects; their anchors, axes and limits are given where the objects stand
    /// at the poses that the scene states.
    pub joints: Vec<Joint>,
}

impl Physics {
    /// Exactly what the scene states.
    pub fn stated(scene: &Scene) -> Self {
        Self {
            masses: scene.objects.iter().map(|object| object.mass).collect(),
            frictions: scene.objects.iter().map(|object| object.friction).collect(),
            table_friction: scene.table_friction,
            joints: scene.joints.clone(),
        }
    }

    /// Coefficient of friction between object `index` and the table.
    pub fn support_friction(&self, index: usize) -> f64 {
        Scene::pair_friction(self.frictions[index], self.table_friction)
    }

    /// For every object the lowest index among those that the joints chosen by `counts`
    /// connect it with, itself included: objects with the same number move as one group.
    pub fn groups(&self, counts: impl Fn(&Joint) -> bool) -> Vec<usize> {
        let mut lowest: Vec<usize> = (0..self.masses.len()).collect();
        // Each round carries a number across at least one more joint.
        for _ in 0..lowest.len() {
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
    use crate::scene::JointKind;

    #[test]
    fn groups_follow_chains_in_any_order() {
        let joint = |between| Joint { between, kind: JointKind::Fixed, guessed: false };
        let physics = Physics {
            masses: vec![0.4; 6],
            frictions: vec![0.4; 6],
            table_friction: 0.4,
            joints: [[4, 5], [3, 4], [0, 3]].map(joint).to_vec(),
        };
        assert_eq!(physics.groups(|_| true), [0, 1, 2, 0, 0, 0]);
        assert_eq!(physics.groups(|joint| joint.between != [3, 4]), [0, 1, 2, 0, 4, 4]);
        assert_eq!(physics.groups(|_| false), [0, 1, 2, 3, 4, 5]);
    }
}
