//! Joints constrain the intended degrees of freedom and leave the others free.

use pushplan::geometry::{Pose, Vector, wrap_angle};
use pushplan::{
    outcome::Record,
    scene::{Joint, JointKind, Object, Scene, State},
    task::Job,
};

use crate::fixtures::{brick, can, engines, push};

/// Returns two bricks end to end with a gap of 2 mm, the second pushed from behind, off-centre.
fn pushed(kind: JointKind) -> (Scene, Vec<State>) {
    let mut second = brick();
    second.name = "second".into();
    second.pose = Pose::new(0.0, 0.102, std::f64::consts::FRAC_PI_2);
    let mut first = brick();
    first.pose.heading = std::f64::consts::FRAC_PI_2;
    let mut scene = Scene::new([first, second]);
    scene.joints.push(Joint::new([0, 1], kind));
    let motion = push(Vector::new(-0.04, 0.20), 0.0, 0.12, 0.1);
    let ends = engines().map(|simulator| {
        let trajectory =
            simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
        assert!(trajectory.warnings.is_empty(), "{:?}", trajectory.warnings);
        trajectory.outcome().clone()
    });
    (scene, ends.to_vec())
}

/// Returns the final position of a world point that an object carries from the start.
fn carried(scene: &Scene, end: &State, object: usize, point: Vector) -> Vector {
    end.poses[object].point(scene.objects[object].pose.local_point(point))
}

#[test]
fn a_fixed_joint_makes_one_body() {
    let (scene, ends) = pushed(JointKind::Fixed);
    for end in ends {
        let turn = |object: usize| end.poses[object].heading - scene.objects[object].pose.heading;
        assert!(turn(0).abs() > 0.05, "it turns: {}", turn(0));
        assert!(wrap_angle(turn(0) - turn(1)).abs() < 2e-3);
        let between =
            carried(&scene, &end, 0, Vector::zeros()) - carried(&scene, &end, 1, Vector::zeros());
        assert!(between.norm() < 0.5e-3, "{between}");
    }
}

#[test]
fn a_revolute_joint_keeps_its_axis_and_turns() {
    let at = Vector::new(0.0, 0.051);
    let (scene, ends) = pushed(JointKind::Revolute { at, limits: None });
    for end in ends {
        let drift = carried(&scene, &end, 0, at) - carried(&scene, &end, 1, at);
        assert!(drift.norm() < 0.5e-3, "{drift}");
        let bend = wrap_angle(end.poses[0].heading - end.poses[1].heading).abs();
        assert!(bend > 0.02, "{bend}");
    }
}

#[test]
fn a_prismatic_joint_slides_along_its_axis_and_keeps_the_angle() {
    let (scene, ends) = pushed(JointKind::Prismatic { axis: Vector::x(), limits: None });
    for end in ends {
        let turn = |object: usize| end.poses[object].heading - scene.objects[object].pose.heading;
        assert!(wrap_angle(turn(0) - turn(1)).abs() < 5e-3, "{} {}", turn(0), turn(1));
        let apart = end.poses[0].local_vector(end.poses[1].position - end.poses[0].position);
        let start = scene.objects[0]
            .pose
            .local_vector(scene.objects[1].pose.position - scene.objects[0].pose.position);
        // World x is the bricks' own -y at the start.
        assert!((apart.x - start.x).abs() < 1e-3, "{apart} from {start}");
        assert!((apart.y - start.y).abs() > 0.01, "{apart} from {start}");
    }
}

#[test]
fn an_untouched_joint_does_not_move() {
    let other = Object { name: "other".into(), ..can() }.at(0.0, 0.12, 0.4);
    let hinge = JointKind::Revolute { at: Vector::new(0.01, 0.06), limits: None };
    let scene = Scene::new([can(), other]).with_joint([0, 1], hinge);
    let motion = push(Vector::new(-2.0, 0.0), 0.0, 0.1, 0.1);
    for simulator in engines() {
        let trajectory =
            simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
        for (object, pose) in scene.objects.iter().zip(&trajectory.outcome().poses) {
            assert!((object.pose.position - pose.position).norm() < 2e-5, "{pose:?}");
        }
    }
}
