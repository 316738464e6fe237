//! Tests of `solver`.

use super::*;
use crate::{
    contact::{
        AwakeIndex, Bodies, ListIndex, PairId, Pairs, Partner, SceneIndex, free_sliding::coast,
    },
    geometry::{Pose, Vector},
    scene::{Body, GRAVITY, Object, Part, Physics, Scene, Tool},
    task::FrameStep,
};
use pushplan_kernel::Motion;

/// A distant can, a can that a bar touches, and one behind it.
fn scene() -> Scene {
    let can = |x: f64| {
        Object::cylinder(format!("{x}"), 0.03, 0.1).mass(0.5).friction(0.5).at(x, 0.0, 0.0)
    };
    Scene::new([can(1.0), can(0.03), can(0.0905)])
}

fn bodies(scene: &Scene) -> Bodies {
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.1], Pose::new(-0.01, 0.0, 0.0));
    let tool = Tool::new("bar", [bar]).expect("one piece").friction(0.5);
    Bodies::new(scene, &tool, 0.002, &Physics::stated(scene))
}

/// Slow, so that table friction is nearly the only resistance.
fn step(travel: f64) -> FrameStep {
    FrameStep { from: Pose::default(), to: Pose::new(travel, 0.0, 0.0), duration: 0.5 }
}

#[test]
fn sleeping_objects_stay_and_awake_objects_keep_their_names() {
    let (scene, step) = (scene(), step(0.005));
    let (bodies, state) = (bodies(&scene), scene.start());
    let mut solver = FrameSolver::default();
    let problem = FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
    let frame = solver.solve(problem);
    assert_eq!(frame.motions.len(), 2);
    assert_eq!([0, 1].map(|k| frame.listed(AwakeIndex(k))), [1, 2].map(ListIndex));
    let mut motions = Vec::new();
    frame.fill(&mut motions);
    assert_eq!(motions[0], Motion::default());
    assert!(motions[1].shift.x > motions[2].shift.x && motions[2].shift.x > 0.004);
    let pairs = Pairs::new(3, 0, 1);
    let touched: Vec<PairId> = frame.touches().map(|touch| touch.pair).collect();
    let id = |object, with| pairs.id(SceneIndex(object), with);
    assert_eq!(touched, [id(1, Body::Part(0)), id(1, Body::Object(2))]);
}

#[test]
fn the_forces_are_those_of_friction_and_leave_the_motions_alone() {
    let (scene, step) = (scene(), step(0.005));
    let (bodies, state) = (bodies(&scene), scene.start());
    let problem = FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
    let mut solver = FrameSolver::default();
    let motions = solver.solve(problem).motions.to_vec();
    let (frame, forces) = solver.solve_with_forces(problem);
    assert_eq!(frame.motions, motions);
    let weight = 0.5 * 0.5 * GRAVITY;
    for (index, contact) in frame.contacts.iter().enumerate() {
        let pushed = if let Partner::Part(_) = contact.with { 2.0 } else { 1.0 };
        let force = forces.normal(index);
        assert!((force / (pushed * weight) - 1.0).abs() < 0.05, "{force} {contact:?}");
        assert!(forces.by_contact(index, contact.object).0.norm() > 0.0);
    }
    let (frame, forces) = solver.solve_with_forces_of_few(problem, 1);
    assert!(frame.motions == motions && forces.is_none());
    assert!(solver.solve_with_forces_of_few(problem, 2).1.is_some());
}

#[test]
fn where_nothing_is_near_everything_coasts() {
    let (scene, step) = (scene(), step(-0.01));
    let bodies = bodies(&scene);
    let mut state = scene.start();
    state.poses[1] = Pose::new(0.5, 0.5, 0.0);
    state.velocities[0].linear = Vector::new(0.1, 0.0);
    let mut solver = FrameSolver::default();
    let problem = FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
    let frame = solver.solve(problem);
    assert!(frame.motions.is_empty() && frame.contacts.is_empty());
    assert_eq!(frame.touches().count(), 0);
    let mut motions = Vec::new();
    frame.fill(&mut motions);
    let coasted = coast(&bodies.objects[0], &state.velocities[0], step.duration);
    assert_eq!(motions, [coasted, Motion::default(), Motion::default()]);
}
