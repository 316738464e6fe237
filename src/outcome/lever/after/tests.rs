//! Tests of `after`.

use super::*;
use crate::{
    scene::Robot,
    task::{Demand, Flipped, LeverRules, PushRules},
};

fn task() -> Task {
    let tile = Object::cuboid("tile", [0.12, 0.08, 0.008]).on_feet(0.006);
    let goal = Goal::new(0, [0.5, 0.2], 0.02).with(Demand::Flipped(Flipped { flipped: true }));
    Task::new("turn", Scene::new([tile]), Robot::reaching(0.1, 0.9), goal)
        .levering(LeverRules::default())
}

fn upside_down(z: f64) -> Pose3 {
    let flat = Pose3::upright(Pose::new(0.4, 0.1, 0.3), z);
    let lying = Pose3 { position: Vector3::zeros(), ..flat };
    let turned = lying.turned_about(Vector3::zeros(), Vector3::x_axis(), std::f64::consts::PI);
    Pose3 { position: flat.position, ..turned }
}

#[test]
fn a_plate_on_its_feet_stands_on_them() {
    let rest = Pose3::upright(Pose::new(0.4, 0.1, 0.3), 0.006);
    let after = task().after(&[rest]).expect("it lies on the table");
    let object = &after.scene.objects[0];
    let Support::Points(points) = &object.support else { panic!("{:?}", object.support) };
    assert_eq!(points.len(), 4);
    assert!(points.iter().all(|point| (point.norm() - 0.06f64.hypot(0.04)).abs() < 1e-9));
    assert!((object.shape.height() - 0.014).abs() < 1e-9);
    assert!((object.shape.footprint().area() - 0.12 * 0.08).abs() < 1e-9);
    assert_eq!(after.goals[0].position(), Some(Vector::new(0.5, 0.2)));
}

#[test]
fn a_plate_upside_down_lies_on_its_upper_face() {
    let after = task().after(&[upside_down(0.008)]).expect("it lies on the table");
    let object = &after.scene.objects[0];
    assert!((object.pose.position - Vector::new(0.4, 0.1)).norm() < 1e-9);
    // The feet point upwards.
    assert!((object.shape.height() - 0.014).abs() < 1e-9);
    let Support::Points(points) = &object.support else { panic!("{:?}", object.support) };
    assert_eq!(points.len(), 4);
}

#[test]
fn objects_above_the_table_are_not_pushed() {
    assert_eq!(task().after(&[upside_down(0.02)]), None, "on a block");
    let leaning = Pose3::upright(Pose::default(), 0.03).turned_about(
        Vector3::zeros(),
        Vector3::x_axis(),
        0.6,
    );
    assert_eq!(task().after(&[leaning]), None);
    let forbidden = task().pushing(PushRules::none());
    assert_eq!(forbidden.after(&[upside_down(0.008)]), None);
}
