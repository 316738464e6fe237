//! A rotated, mirrored or translated scene gives the rotated, mirrored or translated result.

use std::sync::Arc;

use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Engine, JointKind, Object, Scene, Span, Tool},
    task::{Job, Stroke, ToolMotion},
};

use crate::fixtures::{bar, brick, can, engines, row};

/// Simulates a scene and a push placed by `place` (a proper or mirrored motion of the plane).
fn outcome(simulator: &Simulator, objects: &[Object], place: &dyn Fn(Pose) -> Pose) -> Vec<Pose> {
    let placed = objects.iter().cloned().map(|mut object| {
        object.pose = place(object.pose);
        object
    });
    let scene = Scene::new(placed);
    // The bar's face is its front, so a mirrored bar is the bar at the mirrored pose.
    let tool: Arc<Tool> = bar();
    let stroke = Stroke {
        from: place(Pose::new(-0.07, 0.01, 0.1)),
        to: place(Pose::new(0.13, 0.02, 0.1)),
        duration: 2.0,
        settle: true,
    };
    let motion = ToolMotion { tool, lift: 0.002, strokes: vec![stroke] };
    let trajectory = simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
    trajectory.outcome().poses.clone()
}

fn cases() -> Vec<Vec<Object>> {
    let mut box_ = brick();
    box_.pose = Pose::new(0.0, 0.015, 0.35);
    let mut second = can();
    second.name = "second".into();
    second.pose = Pose::new(0.115, 0.035, 0.0);
    vec![vec![can()], vec![box_], vec![can(), second]]
}

/// Returns the maximum difference of a symmetric result, metres. In `f32` the 2-D engine differs
/// by 8 um. The 3-D engine is equally good for cuboids. A cylinder there rests on four points of
/// its rim, whose positions follow the last bits of its inclination: up to 2.2 mm in these pushes.
fn tolerance(engine: Engine, objects: &[Object]) -> f64 {
    match engine {
        Engine::Planar => 0.05e-3,
        Engine::Spatial if objects.iter().any(|object| object.shape.is_cylinder()) => 4e-3,
        Engine::Spatial | Engine::Upright => 0.1e-3,
    }
}

fn assert_symmetric(name: &str, place: &dyn Fn(Pose) -> Pose) {
    for simulator in engines() {
        for objects in cases() {
            let plain = outcome(&simulator, &objects, &|pose| pose);
            let moved = outcome(&simulator, &objects, place);
            for (a, b) in plain.iter().zip(&moved) {
                let error = (place(*a).position - b.position).norm();
                let limit = tolerance(simulator.engine(), &objects);
                assert!(
                    error < limit,
                    "{name}, {:?}, {} object(s): {error}",
                    simulator.engine(),
                    objects.len()
                );
            }
        }
    }
}

#[test]
fn turning_the_scene_turns_the_result() {
    for angle in [0.7, 1.9, -2.6] {
        let turn = Pose::new(0.3, -0.2, angle);
        assert_symmetric("turned", &|pose| turn * pose);
    }
}

#[test]
fn mirroring_the_scene_mirrors_the_result() {
    assert_symmetric("mirrored", &|pose| {
        Pose::new(pose.position.x, -pose.position.y, -pose.heading)
    });
}

#[test]
fn a_kilometre_away_everything_is_the_same() {
    let shift = Vector::new(1000.0, -700.0);
    assert_symmetric("shifted", &|pose| Pose { position: pose.position + shift, ..pose });
}

#[test]
fn a_square_looks_the_same_after_a_quarter_turn() {
    let mut square = brick();
    square.shape = Shape::Cuboid { size: [0.07, 0.07, 0.05] };
    square.pose = Pose::new(0.0, 0.02, 0.3);
    let mut turned = square.clone();
    turned.pose.heading += std::f64::consts::FRAC_PI_2;
    for simulator in engines() {
        let a = outcome(&simulator, &[square.clone()], &|pose| pose)[0];
        let b = outcome(&simulator, &[turned.clone()], &|pose| pose)[0];
        let error = (a.position - b.position).norm();
        assert!(error < tolerance(simulator.engine(), &[]), "{:?}: {error}", simulator.engine());
    }
}

#[test]
fn turning_a_jointed_scene_turns_the_result() {
    let kinds: [fn(Vector) -> JointKind; 3] = [
        |_| JointKind::Fixed,
        |at| JointKind::Revolute { at, limits: Some(Span::new(-0.1, 0.2)) },
        |_| JointKind::Prismatic { axis: Vector::x(), limits: Some(Span::new(-0.02, 0.03)) },
    ];
    let mut model = brick();
    model.pose.heading = std::f64::consts::FRAC_PI_2;
    for kind in kinds {
        let plain = row(3, &model, 0.12, kind);
        for angle in [0.7, 1.9, -2.6] {
            let turn = Pose::new(0.3, -0.2, angle);
            let mut turned = plain.clone();
            turned.objects.iter_mut().for_each(|object| object.pose = turn * object.pose);
            for joint in &mut turned.joints {
                match &mut joint.kind {
                    JointKind::Fixed => {}
                    JointKind::Revolute { at, .. } => *at = turn.point(*at),
                    JointKind::Prismatic { axis, .. } => *axis = turn.vector(*axis),
                }
            }
            let stroke = |place: Pose| Stroke {
                from: place * Pose::new(-0.05, 0.07, 0.0),
                to: place * Pose::new(0.1, 0.07, 0.0),
                duration: 1.5,
                settle: true,
            };
            for simulator in engines() {
                let end = |scene: &Scene, place: Pose| {
                    let strokes = vec![stroke(place)];
                    let motion = ToolMotion { tool: bar(), lift: 0.002, strokes };
                    let run =
                        simulator.run(scene, &Job::stated(scene, motion.clone()), Record::Outcome);
                    run.outcome().poses.clone()
                };
                let (a, b) = (end(&plain, Pose::default()), end(&turned, turn));
                for (a, b) in a.iter().zip(&b) {
                    let error = ((turn * *a).position - b.position).norm();
                    // Bodies that rotate or slide against their neighbours are more sensitive to
                    // rounding.
                    let fixed = plain.joints[0].kind == JointKind::Fixed;
                    let limit = if fixed { tolerance(simulator.engine(), &[]) } else { 1e-3 };
                    assert!(error < limit, "{:?}: {error}", simulator.engine());
                }
            }
        }
    }
}
