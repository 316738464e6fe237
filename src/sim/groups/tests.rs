//! Tests of `groups`.

use super::*;
use crate::geometry::Shape;
use crate::scene::{Joint, JointKind, Object};

fn scene() -> (Scene, State) {
    let shape = Shape::Cylinder { radius: 0.05, height: 0.1 };
    let object = |k: usize| {
        Object::new(format!("o{k}"), shape).mass(1.0 + k as f64).at(0.1 * k as f64, 0.0, 0.3)
    };
    let joint = |a, b, kind| Joint::new([a, b], kind);
    let pin = JointKind::Revolute { at: Vector::zeros(), limits: None };
    let joints = vec![
        joint(3, 2, JointKind::Fixed),
        joint(1, 2, pin),
        joint(0, 3, JointKind::Fixed),
        joint(0, 2, JointKind::Fixed),
    ];
    let objects: Vec<Object> = (0..5).map(object).collect();
    let scene = Scene { joints, ..Scene::new(objects) };
    let state = scene.start();
    (scene, state)
}

#[test]
fn fixed_joints_make_groups_and_loops_of_them_do_no_harm() {
    let (scene, state) = scene();
    let groups = Group::of(&scene, &state, &Physics::stated(&scene));
    let objects: Vec<Vec<usize>> = groups.iter().map(|group| group.objects.clone()).collect();
    assert_eq!(objects, [vec![0, 2, 3], vec![1], vec![4]]);
    assert_eq!(groups[1].pose, scene.objects[1].pose);
    assert!((groups[0].pose.position.x - (0.6 + 1.2) / 8.0).abs() < 1e-15);
}

#[test]
fn a_turning_group_gives_its_objects_their_velocities_back() {
    let (scene, mut state) = scene();
    let about = Velocity { linear: Vector::new(0.1, -0.2), angular: 0.7 };
    for (pose, velocity) in state.poses.iter().zip(&mut state.velocities) {
        *velocity = Velocity { linear: about.at(pose.position), ..about };
    }
    let groups = Group::of(&scene, &state, &Physics::stated(&scene));
    for index in 0..5 {
        let member = Member::of(&groups, &state, index);
        let velocity = member.velocity(groups[member.body].velocity, 0.0);
        assert!((velocity.linear - state.velocities[index].linear).norm() < 1e-14);
        assert!((velocity.angular - 0.7).abs() < 1e-14);
        assert_eq!(member.pose(Vector::zeros(), 0.0), state.poses[index]);
    }
}
