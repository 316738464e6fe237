//! Joint constraints hold over long distances, in pairs and in rows of twelve.
//!
//! Objects of 0.4 kg in a row across the hand's path, pushed 1 m at 0.21 m/s. Largest violation
//! over all joints and frames, planar / 3-D:
//!
//! | row                        | mm at 1/240 s   | mm at 1/480 s   | degrees at 1/240 s |
//! |----------------------------|-----------------|-----------------|--------------------|
//! | any, fixed                 | 0 / 0           | 0 / 0           | 0 / 0              |
//! | 2 cans, revolute           | 0.001 / 0.001   | 0.005 / 0.001   |                    |
//! | 2 bricks, revolute         | 0.001 / 0.005   | 0.000 / 0.002   |                    |
//! | 2 cans, prismatic          | 0.001 / 0.006   | 0.000 / 0.001   | 0.001 / 0.008      |
//! | 2 bricks, prismatic        | 0.036 / 0.036   | 0.000 / 0.023   | 0.040 / 0.051      |
//! | 12 cans, revolute          | 0.21 / 0.37     | 0.05 / 0.04     |                    |
//! | 12 bricks, revolute        | 0.17 / 0.16     | 0.04 / 0.04     |                    |
//! | same, masses 1 : 10 in turn| 0.71 / 2.6      |                 |                    |

use std::num::NonZeroU16;

use pushplan::geometry::{Pose, Vector};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::{Engine, JointKind, Object, Rate, Scene},
    task::Job,
};

use crate::fixtures::{brick, can, drift, hand_push, row};

/// Name, and the joint about the midpoint between two objects.
type Named = (&'static str, fn(Vector) -> JointKind);

const KINDS: [Named; 3] = [
    ("fixed", |_| JointKind::Fixed),
    ("revolute", |at| JointKind::Revolute { at, limits: None }),
    ("prismatic", |_| JointKind::Prismatic { axis: Vector::new(1.0, 0.0), limits: None }),
];

/// Simulates a push of the hand, 1 m at 0.21 m/s, at `y` metres.
fn play(scene: &Scene, simulator: &Simulator, y: f64) -> Trajectory {
    let motion = hand_push(Vector::new(-0.13, y), 0.0, 1.0, 0.21);
    simulator.run(scene, &Job::stated(scene, motion.clone()), Record::Frames)
}

fn models() -> [(&'static str, Object, f64); 2] {
    let mut across = brick();
    across.pose = Pose::new(0.0, 0.0, std::f64::consts::FRAC_PI_2);
    [("cans", can(), 0.102), ("bricks", across, 0.102)]
}

fn simulators() -> [(&'static str, f64, Simulator); 4] {
    let fine = Rate(NonZeroU16::new(480).unwrap());
    [
        ("planar", 240.0, Simulator::planar()),
        ("planar", 480.0, Simulator::new(Engine::Planar, fine)),
        ("3-D", 240.0, Simulator::spatial()),
        ("3-D", 480.0, Simulator::new(Engine::Spatial, fine)),
    ]
}

/// Asserts that no joint of the row drifts by more than `most` metres, or as many radians per 50
/// mm, and that half the step drifts less or is negligible.
fn assert_held(name: &str, scene: &Scene, y: f64, most: f64) {
    let mut before = (0.0, 0.0);
    for (engine, step, simulator) in simulators() {
        let trajectory = play(scene, &simulator, y);
        let (distance, angle) = drift(scene, &trajectory);
        println!(
            "{name}, {engine} at 1/{step}: {:.4} mm, {:.4} deg, {} frames",
            distance * 1e3,
            angle.to_degrees(),
            trajectory.frames.len()
        );
        assert!(trajectory.warnings.is_empty(), "{name}, {engine}: {:?}", trajectory.warnings);
        assert!(distance < most, "{name}, {engine} at 1/{step}: {distance} m");
        assert!(angle < most / 0.05, "{name}, {engine} at 1/{step}: {angle} rad");
        if step > 240.0 {
            let less = |half: f64, full: f64| half < full.max(0.1 * most);
            assert!(less(distance, before.0) && less(angle, before.1), "{name}, {engine}");
        }
        before = (distance, angle);
    }
}

#[test]
fn pairs_hold_over_a_metre() {
    for (shape, model, pitch) in models() {
        for (kind, joint) in KINDS {
            let scene = row(2, &model, pitch, joint);
            assert_held(&format!("2 {shape}, {kind}"), &scene, 0.09, 0.1e-3);
        }
    }
}

#[test]
fn a_row_of_twelve_pushed_at_its_middle_stays_together() {
    for (shape, model, pitch) in models() {
        for (kind, joint) in &KINDS[..2] {
            let scene = row(12, &model, pitch, *joint);
            let most = if *kind == "fixed" { 1e-6 } else { 1e-3 };
            assert_held(&format!("12 {shape}, {kind}"), &scene, 5.6 * pitch, most);
        }
    }
}

#[test]
fn light_and_heavy_ones_in_turn_stay_together() {
    for (kind, joint) in &KINDS[..2] {
        let (_, model, pitch) = models()[1].clone();
        let mut scene = row(12, &model, pitch, *joint);
        scene.objects.iter_mut().step_by(2).for_each(|object| object.mass = 0.04);
        let most = if *kind == "fixed" { 1e-6 } else { 4e-3 };
        for simulator in [Simulator::planar(), Simulator::spatial()] {
            let (distance, _) = drift(&scene, &play(&scene, &simulator, 5.6 * pitch));
            println!("1 : 10, {kind}, {:?}: {:.4} mm", simulator.engine(), distance * 1e3);
            assert!(distance < most, "{kind}, {:?}: {distance} m", simulator.engine());
        }
    }
}
