//! Limits stop a joint at the stated values, on both sides, in both engines.

use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::Record,
    scene::{JointKind, Scene, Span},
    task::Job,
};

use crate::fixtures::{brick, engines, opened, push, row};

/// Returns a heavy brick and a light one beyond it, 3 cm apart, with a joint.
fn pair(kind: JointKind) -> Scene {
    let mut model = brick();
    model.pose.heading = std::f64::consts::FRAC_PI_2;
    let mut scene = row(2, &model, 0.13, |_| JointKind::Fixed);
    scene.objects[0].mass = 2.0;
    scene.joints[0].kind = kind;
    scene
}

/// Returns the extremes of the joint while the light brick is pushed 10 cm along +x or -x at its
/// far end. `value` reads them over all frames, for either engine.
fn extremes(scene: &Scene, ahead: bool, value: fn(Pose) -> f64) -> [Span; 2] {
    let (start, direction) = if ahead { (-0.04, 0.0) } else { (0.04, std::f64::consts::PI) };
    let motion = push(Vector::new(start, 0.26), direction, 0.10, 0.1);
    engines().map(|simulator| {
        let trajectory = simulator.run(scene, &Job::stated(scene, motion.clone()), Record::Frames);
        assert!(trajectory.warnings.is_empty(), "{:?}", trajectory.warnings);
        let values = trajectory.frames.iter().map(|frame| value(opened(scene, &frame.state, 0)));
        values.fold(Span::new(0.0, 0.0), |span, value| {
            Span::new(span.low.min(value), span.high.max(value))
        })
    })
}

#[test]
fn a_limit_stops_a_turning_pair_on_either_side() {
    let at = Vector::new(0.0, 0.065);
    let limits = Span::new((-20f64).to_radians(), 12f64.to_radians());
    let slack = 0.1f64.to_radians();
    let turned = |pose: Pose| pose.heading;
    let free = pair(JointKind::Revolute { at, limits: None });
    let limited = pair(JointKind::Revolute { at, limits: Some(limits) });
    // Pushed forward at its far end, the second brick rotates clockwise.
    for span in extremes(&free, true, turned) {
        assert!(span.low < limits.low - 0.05, "{span:?}");
    }
    for span in extremes(&limited, true, turned) {
        assert!((span.low - limits.low).abs() < slack, "{span:?}");
    }
    for span in extremes(&free, false, turned) {
        assert!(span.high > limits.high + 0.05, "{span:?}");
    }
    for span in extremes(&limited, false, turned) {
        assert!((span.high - limits.high).abs() < slack, "{span:?}");
    }
}

#[test]
fn a_limit_stops_a_sliding_pair_on_either_side() {
    let axis = Vector::new(1.0, 0.0);
    let limits = Span::new(-0.02, 0.03);
    let slack = 0.1e-3;
    let slid = |pose: Pose| pose.position.x;
    let free = pair(JointKind::Prismatic { axis, limits: None });
    let limited = pair(JointKind::Prismatic { axis, limits: Some(limits) });
    for span in extremes(&free, true, slid) {
        assert!(span.high > limits.high + 0.01, "{span:?}");
    }
    for span in extremes(&limited, true, slid) {
        assert!((span.high - limits.high).abs() < slack, "{span:?}");
    }
    for span in extremes(&free, false, slid) {
        assert!(span.low < limits.low - 0.01, "{span:?}");
    }
    for span in extremes(&limited, false, slid) {
        assert!((span.low - limits.low).abs() < slack, "{span:?}");
    }
}

#[test]
fn a_joint_that_starts_at_its_limit_moves_only_the_other_way() {
    let axis = Vector::new(1.0, 0.0);
    let limited = pair(JointKind::Prismatic { axis, limits: Some(Span::new(0.0, 0.03)) });
    let slid = |pose: Pose| pose.position.x;
    for span in extremes(&limited, false, slid) {
        assert!(span.low > -0.1e-3 && span.high < 0.1e-3, "{span:?}");
    }
}

#[test]
fn limits_count_from_the_stated_start_also_after_the_tool_was_lifted() {
    // Two pushes: the world is rebuilt before the second, when the joint is at its limit.
    let axis = Vector::new(1.0, 0.0);
    let limits = Span::new(-0.02, 0.03);
    let scene = pair(JointKind::Prismatic { axis, limits: Some(limits) });
    let mut motion = push(Vector::new(-0.04, 0.26), 0.0, 0.08, 0.1);
    let again = motion.strokes[0];
    motion.strokes.push(again);
    motion.strokes[1].to.position.x += 0.06;
    for simulator in engines() {
        let trajectory =
            simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);
        for frame in &trajectory.frames {
            let slid = opened(&scene, &frame.state, 0).position.x;
            assert!(slid < limits.high + 0.1e-3, "{slid}");
        }
        assert!((opened(&scene, trajectory.outcome(), 0).position.x - 0.03).abs() < 0.1e-3);
    }
}
