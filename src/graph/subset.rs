//! Some of the bodies of a scene, under numbers of their own.

use super::bodies::Bodies;

/// Bodies taken from a scene's, in their order there, and where each comes from.
///
/// Whoever fills the lists takes all objects of a mechanism or none of them.
#[derive(Clone, Debug, Default)]
pub struct Subset {
    /// Which objects of the scene; the position in this list is their number in `bodies`.
    pub objects: Vec<usize>,
    /// Which parts of the tool.
    pub parts: Vec<usize>,
    /// Which obstacles of the scene.
    pub obstacles: Vec<usize>,
    /// The bodies themselves.
    pub bodies: Bodies,
    /// Number in `bodies` of every object of the scene that is taken.
    number: Vec<usize>,
}

impl Subset {
    /// Lists everything in `whole`.
    pub fn list_all(&mut self, whole: &Bodies) {
        self.objects.clear();
        self.objects.extend(0..whole.objects.len());
        self.parts.clear();
        self.parts.extend(0..whole.parts.len());
        self.obstacles.clear();
        self.obstacles.extend(0..whole.obstacles.len());
    }

    /// The number in `bodies` of `object`, which must be taken.
    pub fn number(&self, object: usize) -> usize {
        self.number[object]
    }

    /// Fills `bodies` with what the lists name, on the memory that it has.
    pub fn gather(&mut self, whole: &Bodies) {
        let Self { objects, parts, obstacles, bodies, number } = self;
        number.resize(whole.objects.len(), 0);
        objects.iter().enumerate().for_each(|(own, &object)| number[object] = own);
        bodies.objects.clear();
        bodies.objects.extend(objects.iter().map(|&k| whole.objects[k]));
        bodies.parts.clear();
        bodies.parts.extend(parts.iter().map(|&k| whole.parts[k]));
        bodies.obstacles.clear();
        bodies.obstacles.extend(obstacles.iter().map(|&k| whole.obstacles[k]));
        bodies.mechanisms.clear();
        bodies.mechanisms.extend(objects.iter().map(|&k| number[whole.mechanisms[k]]));
        bodies.joints.clear();
        let taken = |object: usize| objects.get(number[object]) == Some(&object);
        for joint in whole.joints.iter().filter(|joint| taken(joint.between[0])) {
            let mut own = *joint;
            own.between = joint.between.map(|object| number[object]);
            bodies.joints.push(own);
        }
        let groups = &mut bodies.groups;
        groups.places.clear();
        groups.places.extend(objects.iter().map(|&k| whole.groups.places[k]));
        groups.of.clear();
        let mut count = 0;
        for (own, &object) in objects.iter().enumerate() {
            let first = whole.groups.members[whole.groups.of[object]][0];
            if first == object {
                match groups.members.get_mut(count) {
                    Some(members) => members.clear(),
                    None => groups.members.push(Vec::new()),
                }
                groups.of.push(count);
                count += 1;
            } else {
                groups.of.push(groups.of[number[first]]);
            }
            groups.members[groups.of[own]].push(own);
        }
        groups.members.truncate(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        geometry::{Pose, Shape},
        scene::{Joint, JointKind, Object, Part, Physics, Scene, Tool},
    };

    #[test]
    fn what_is_taken_keeps_its_joints_and_groups_under_new_numbers() {
        let object = |k: usize| Object {
            name: format!("{k}"),
            shape: Shape::Cylinder { radius: 0.05, height: 0.1 },
            mass: 1.0 + k as f64,
            friction: 0.4,
            pose: Pose::new(0.1 * k as f64, 0.0, 0.0),
        };
        let joint = |between, kind| Joint { between, kind, guessed: false };
        let slide = JointKind::Prismatic { axis: crate::geometry::Vector::x(), limits: None };
        let scene = Scene {
            table_friction: 0.5,
            objects: (0..6).map(object).collect(),
            joints: vec![
                joint([0, 1], JointKind::Fixed),
                joint([2, 5], JointKind::Fixed),
                joint([5, 4], slide),
            ],
            ..Scene::default()
        };
        let part = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
        let tool =
            Tool::assemble("bar".into(), String::new(), Pose::default(), 0.3, vec![part], &[]);
        let whole = Bodies::new(&scene, &tool.expect("one piece"), 0.0, &Physics::stated(&scene));
        let mut subset = Subset::default();
        subset.list_all(&whole);
        subset.gather(&whole);
        assert_eq!(subset.bodies.groups.members, whole.groups.members);
        assert_eq!(subset.bodies.mechanisms, whole.mechanisms);
        // Fewer than before, so that what is left over of the last time would show.
        subset.objects = vec![2, 3, 4, 5];
        subset.parts.clear();
        subset.gather(&whole);
        let bodies = &subset.bodies;
        assert_eq!(bodies.groups.members, [vec![0, 3], vec![1], vec![2]]);
        assert_eq!(bodies.groups.of, [0, 1, 2, 0]);
        assert_eq!(bodies.mechanisms, [0, 1, 0, 0]);
        assert_eq!(bodies.groups.places[3], whole.groups.places[5]);
        let between: Vec<[usize; 2]> = bodies.joints.iter().map(|joint| joint.between).collect();
        assert_eq!(between, [[0, 3], [3, 2]]);
        let masses: Vec<f64> = bodies.objects.iter().map(|object| object.mass).collect();
        assert_eq!(masses, [3.0, 4.0, 5.0, 6.0]);
        assert!(bodies.parts.is_empty());
    }
}
