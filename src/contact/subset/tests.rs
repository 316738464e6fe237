//! Tests of `subset`.

use super::*;
use crate::{
    contact::{ListIndex, Partner, SceneIndex},
    geometry::Pose,
    scene::{JointKind, Object, Part, Physics, Scene, Tool},
};

#[test]
fn a_subset_keeps_joints_and_groups_under_new_numbers() {
    let object = |k: usize| {
        let x = 0.1 * k as f64;
        Object::cylinder(format!("{k}"), 0.05, 0.1).mass(1.0 + k as f64).at(x, 0.0, 0.0)
    };
    let slide = JointKind::Prismatic { axis: crate::geometry::Vector::x(), limits: None };
    let scene = Scene::new((0..6).map(object))
        .with_joint([0, 1], JointKind::Fixed)
        .with_joint([2, 5], JointKind::Fixed)
        .with_joint([5, 4], slide);
    let part = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Tool::new("bar", [part]).map(|tool| tool.friction(0.3));
    let whole = Bodies::new(&scene, &tool.expect("one piece"), 0.0, &Physics::stated(&scene));
    let mut subset = Subset::<SceneIndex, ListIndex>::default();
    subset.list_all(&whole);
    subset.gather(&whole);
    assert_eq!(subset.bodies.groups.members, whole.groups.members);
    assert_eq!(subset.bodies.mechanisms, whole.mechanisms);
    // Fewer than before, so that remains of the previous list would be visible.
    subset.objects = [2, 3, 4, 5].map(SceneIndex).to_vec();
    subset.parts.clear();
    subset.gather(&whole);
    let bodies = &subset.bodies;
    assert_eq!(bodies.groups.members, [vec![0, 3], vec![1], vec![2]]);
    assert_eq!(bodies.groups.of, [0, 1, 2, 0].map(GroupIndex));
    assert_eq!(bodies.mechanisms, [0, 1, 0, 0]);
    assert_eq!(bodies.groups.places[3], whole.groups.places[5]);
    let between: Vec<[usize; 2]> = bodies.joints.iter().map(|joint| joint.between).collect();
    assert_eq!(between, [[0, 3], [3, 2]]);
    let masses: Vec<f64> = bodies.objects.iter().map(|object| object.mass).collect();
    assert_eq!(masses, [3.0, 4.0, 5.0, 6.0]);
    assert!(bodies.parts.is_empty());
    let (here, there) = (Partner::Object(3), Partner::Object(5));
    assert_eq!(bodies.pair(0, here), whole.pair(2, there), "a pair keeps its id");
    assert_eq!(subset.own(SceneIndex(4)), ListIndex(2));
    assert_eq!(subset.outer(ListIndex(2)), SceneIndex(4));
}
