//! Frames with a solution known in closed form or by symmetry.

use super::*;
use crate::{
    contact::{bodies::Bodies, free_sliding::coast, points::find_contacts},
    geometry::{Pose, Shape, Turn, cross},
    scene::{Joint, JointKind, Object, Obstacle, Part, Physics, Scene, State, Support, Tool},
    task::FrameStep,
};
use pushplan_kernel::Motion;

fn cuboid(x: f64, y: f64) -> Object {
    Object::cuboid(format!("{x} {y}"), [0.06, 0.06, 0.1]).mass(0.5).friction(0.5).at(x, y, 0.0)
}

fn can(x: f64, y: f64) -> Object {
    Object { shape: Shape::Cylinder { radius: 0.03, height: 0.1 }, ..cuboid(x, y) }
}

/// Pushed at the table's height, so that the load does not move.
fn table(objects: Vec<Object>) -> Scene {
    Scene { push_height: Some(0.0), ..Scene::new(objects) }
}

/// Returns the motions of one slow frame in which a round finger of 2 cm, its far side touching the
/// line x = 0, moves by `travel`.
fn prior(scene: &Scene, travel: Vector) -> Vec<Motion> {
    let to = Pose { position: travel, heading: 0.0 };
    let step = FrameStep { from: Pose::default(), to, duration: 0.5 };
    let mut prior = Prior::default();
    in_frame(scene, &scene.start(), &step, |scenery, contacts| {
        prior.solve(scenery, Vector::x(), contacts);
    });
    prior.motions
}

/// Calls `with` with a frame of that finger.
fn in_frame(
    scene: &Scene,
    state: &State,
    step: &FrameStep,
    with: impl FnOnce(Scenery, &[Contact]),
) {
    let finger = Part {
        name: "finger".into(),
        shape: Shape::Cylinder { radius: 0.01, height: 0.1 },
        pose: Pose::new(-0.01, 0.0, 0.0),
    };
    let tool = Tool::new("finger", [finger]).expect("one part is one piece").friction(0.5);
    let bodies = Bodies::new(scene, &tool, 0.002, &Physics::stated(scene));
    let coasts: Vec<Motion> = (bodies.objects.iter().zip(&state.velocities))
        .map(|(body, velocity)| coast(body, velocity, step.duration))
        .collect();
    let turns: Vec<Turn> = state.poses.iter().map(Pose::turn).collect();
    let mut contacts = Vec::new();
    let scenery = Scenery {
        bodies: &bodies,
        state,
        step,
        coasts: &coasts,
        turns: &turns,
        margin: crate::contact::MARGIN,
    };
    find_contacts(scenery, &mut contacts);
    with(scenery, &contacts);
}

#[test]
fn a_push_through_the_centre_only_shifts() {
    let [motion] = prior(&table(vec![cuboid(0.03, 0.0)]), Vector::new(0.008, 0.0))[..] else {
        panic!("one object")
    };
    assert!((motion.shift - Vector::new(0.008, 0.0)).norm() < 5e-5, "{motion:?}");
    assert!(motion.turn.abs() < 1e-9, "{motion:?}");
}

/// A slow push at one point that sticks: friction over the whole underside and the force at that
/// point balance, in forces and in torques (Goyal, Ruina and Papadopoulos 1991).
#[test]
fn an_off_centre_push_that_sticks_balances_friction_under_even_pressure() {
    let scene = table(vec![cuboid(0.03, -0.01)]);
    let [motion] = prior(&scene, Vector::new(0.002, 0.0))[..] else { panic!("one object") };
    let arm = Vector::new(-0.03, 0.01);
    assert!((motion.at(arm) - Vector::new(0.002, 0.0)).norm() < 5e-5, "{motion:?}");
    let (mut force, mut torque, count) = (Vector::zeros(), 0.0, 200);
    for k in 0..count * count {
        let place = |k: i32| 0.06 * ((f64::from(k) + 0.5) / f64::from(count) - 0.5);
        let at = Vector::new(place(k % count), place(k / count));
        let drag = motion.at(at).normalize() / f64::from(count * count);
        force += drag;
        torque += cross(at, drag);
    }
    // The tolerance is the torque of an arm of a millimetre.
    assert!((torque - cross(arm, force)).abs() < 1e-3 * force.norm(), "{torque} {force}");
    assert!(motion.turn < -0.01, "{motion:?}");
}

#[test]
fn a_sliding_contact_moves_the_object_along_the_edge_of_the_friction_cone() {
    let slippery = |object: Object| Object { friction: 0.0, ..object };
    let scene = Scene { table_friction: 1.0, ..table(vec![slippery(can(0.03, 0.0))]) };
    // Short, because the contact moves around the disc.
    let travel = Vector::new(0.0002, 0.0003);
    let [motion] = prior(&scene, travel)[..] else { panic!("one object") };
    // Coefficient 0.25 with the finger's 0.5; a disc's rim also rotates, which needs no
    // displacement of its centre.
    assert!((motion.shift.y / motion.shift.x - 0.25).abs() < 0.01, "{motion:?}");
    assert!((motion.shift.x - travel.x).abs() < 2.5e-6, "{motion:?}");
}

#[test]
fn a_row_is_pushed_through_to_its_end() {
    let row = (0..4).map(|k| can(0.03 + 0.06 * f64::from(k), 0.0)).collect();
    for motion in prior(&table(row), Vector::new(0.01, 0.0)) {
        // Contacts yield by a share of the load, here the load of four cans.
        assert!((motion.shift - Vector::new(0.01, 0.0)).norm() < 8e-4, "{motion:?}");
    }
}

#[test]
fn an_object_pushed_against_a_wall_stays_finite_and_between() {
    let mut scene = table(vec![can(0.03, 0.0)]);
    scene.obstacles.push(Obstacle {
        name: "wall".into(),
        size: [0.02, 0.3, 0.1],
        pose: Pose::new(0.07, 0.0, 0.0),
        z: 0.0,
        friction: 0.5,
    });
    let [motion] = prior(&scene, Vector::new(0.01, 0.0))[..] else { panic!("one object") };
    assert!(motion.shift.x > 0.0 && motion.shift.x < 0.01, "{motion:?}");
    assert!(motion.shift.y.abs() < 1e-6 && motion.turn.abs() < 1e-6, "{motion:?}");
}

#[test]
fn a_revolute_pair_keeps_its_anchor_and_a_prismatic_one_its_line() {
    for kind in [
        JointKind::Revolute { at: Vector::new(0.07, 0.0), limits: None },
        JointKind::Prismatic { axis: Vector::y(), limits: None },
    ] {
        let mut scene = table(vec![can(0.03, -0.015), can(0.11, 0.0)]);
        scene.joints.push(Joint::new([0, 1], kind));
        let motions = prior(&scene, Vector::new(0.008, 0.0));
        let joint = &scene.joints[0];
        let frames = joint.frames(&scene.objects);
        let shifted = |k: usize| {
            let at = scene.objects[joint.between[k]].pose * frames[k];
            motions[k].at(at.position - scene.objects[k].pose.position)
        };
        let apart = shifted(1) - shifted(0);
        match kind {
            JointKind::Revolute { .. } => {
                assert!(apart.norm() < 1e-8 + motions[0].turn.powi(2), "{apart}");
                assert!((motions[0].turn - motions[1].turn).abs() > 1e-3, "{motions:?}");
            }
            _ => {
                assert!((motions[0].turn - motions[1].turn).abs() < 1e-9, "{motions:?}");
                assert!(motions[1].shift.x > 0.004, "pushed along: {motions:?}");
            }
        }
    }
}

/// Two boxes that rotate while they are pushed: frames with and without warm start have the same
/// result.
#[test]
fn where_a_frame_begins_from_makes_it_shorter_and_no_other() {
    let scene = table(vec![cuboid(0.03, -0.02), cuboid(0.091, 0.03)]);
    let (mut going, mut state) = (Prior::default(), scene.start());
    let mut last = Vec::new();
    let [mut followed, mut alone] = [0, 0];
    for frame in 0..12 {
        let [from, to] = [0, 1].map(|k| Pose::new(0.002 * f64::from(frame + k), 0.0, 0.0));
        let step = FrameStep { from, to, duration: 0.02 };
        in_frame(&scene, &state, &step, |scenery, contacts| {
            let mut fresh = Prior::default();
            fresh.solve(scenery, Vector::x(), contacts);
            let before = [&going.system, &going.velocities].map(|system| system.tally.updates);
            match frame {
                0 => going.solve(scenery, Vector::x(), contacts),
                _ => going.follow(scenery, Vector::x(), contacts, &last),
            }
            for (one, other) in going.motions.iter().zip(&fresh.motions) {
                assert!((one.shift - other.shift).norm() < 1e-5, "{frame}: {one:?} {other:?}");
                let ended = step.duration * (one.velocity - other.velocity);
                assert!(ended.norm() < 1e-5, "{frame}: {one:?} {other:?}");
            }
            if frame > 4 {
                followed += going.system.tally.updates + going.velocities.tally.updates;
                followed -= before.iter().sum::<u64>();
                alone += fresh.system.tally.updates + fresh.velocities.tally.updates;
            }
            last = contacts.to_vec();
        });
        for (k, motion) in going.motions.iter().enumerate() {
            state.poses[k].position += motion.shift;
            state.poses[k].heading += motion.turn;
            state.velocities[k].linear = motion.velocity;
            state.velocities[k].angular = motion.spin;
        }
    }
    assert!(state.poses[0].heading.abs() > 0.1, "{state:?}");
    assert!(5 * followed < 4 * alone, "{followed} {alone}");
}

/// A steadily pushed object does not depend on its momentum: its motion is determined by friction
/// alone, though it would come to rest within a frame if the tool left it.
#[test]
fn a_steady_push_is_balanced_by_friction() {
    let long =
        Object::cuboid("long", [0.04, 0.2, 0.1]).mass(0.5).friction(0.5).at(0.02, -0.05, 0.0);
    let scene = table(vec![Object { support: Support::Corners, ..long }]);
    let travel = Pose { position: Vector::new(0.006, 0.0), heading: 0.0 };
    let pushed = |state: &State, duration: f64| {
        let step = FrameStep { from: Pose::default(), to: travel, duration };
        let mut prior = Prior::default();
        in_frame(&scene, state, &step, |scenery, contacts| {
            prior.solve(scenery, Vector::x(), contacts);
        });
        prior.motions[0]
    };
    let slow = pushed(&scene.start(), 50.0);
    assert!(slow.turn < -0.02, "{slow:?}");
    for duration in [0.2, 0.1, 0.04] {
        let mut state = scene.start();
        state.velocities[0].linear = slow.shift / duration;
        state.velocities[0].angular = slow.turn / duration;
        let steady = pushed(&state, duration);
        assert!((steady.shift - slow.shift).norm() < 1e-4, "{duration}: {steady:?} {slow:?}");
        assert!((steady.turn - slow.turn).abs() < 1e-3, "{duration}: {steady:?} {slow:?}");
    }
}

/// Two feet that both move drag equally, without a torque that would balance an eccentric push. One
/// of them, the far one, therefore stands still.
#[test]
fn a_rod_on_two_feet_turns_about_the_far_one() {
    let feet = [0.09, -0.09].map(|y| Vector::new(0.0, y));
    for arm in [0.03, 0.06, 0.09] {
        let rod = Object::cuboid("rod", [0.02, 0.2, 0.1]).mass(0.5).friction(0.1);
        let support = Support::Points(feet.to_vec());
        let scene = table(vec![Object { support, ..rod.at(0.01, -arm, 0.0) }]);
        let [motion] = prior(&scene, Vector::new(0.005, 0.0))[..] else { panic!("one object") };
        assert!(motion.at(feet[1]).norm() < 4e-4, "{arm}: {motion:?}");
        assert!((motion.turn + 0.005 / (0.09 + arm)).abs() < 3e-3, "{arm}: {motion:?}");
    }
}

/// The feet of a long box at half the motion balance a push at its end.
#[test]
fn four_feet_half_way_balance_a_push_that_turns_the_box() {
    let long =
        Object::cuboid("long", [0.04, 0.2, 0.1]).mass(0.5).friction(0.1).at(0.02, -0.08, 0.0);
    let scene = table(vec![Object { support: Support::Corners, ..long }]);
    let travel = Vector::new(0.01, 0.0);
    let [motion] = prior(&scene, travel)[..] else { panic!("one object") };
    assert!(motion.turn < -0.04, "{motion:?}");
    let half = Turn::by(0.5 * motion.turn);
    let (mut force, mut torque) = (Vector::zeros(), 0.0);
    for [x, y] in [[0.02, 0.1], [-0.02, 0.1], [-0.02, -0.1], [0.02, -0.1]] {
        let foot = half.of(Vector::new(x, y));
        let drag = motion.at(foot).normalize() / 4.0;
        force += drag;
        torque += cross(foot, drag);
    }
    // The finger's own point, along the face's normal from its middle.
    let finger = Vector::new(-0.01, 0.0) + travel / 2.0 + half.of(Vector::new(0.01, 0.0));
    let arm = finger - (Vector::new(0.02, -0.08) + motion.shift / 2.0);
    // The tolerance is the torque of an arm of a millimetre.
    assert!((torque - cross(arm, force)).abs() < 1e-3 * force.norm(), "{torque} {force}");
}
