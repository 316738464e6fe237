//! Trivial models in scenes with joints: the projection holds them, and models accept other
//! assumptions.

use pushplan::{
    effect::{Assuming, EffectModel, Job, Simulated},
    geometry::{Pose, Vector, wrap_angle},
    outcome::{Record, Trajectory},
    scene::{Assumptions, JointBelief, JointKind, Object, Scene, Span, State},
    sim::Simulator,
};

use pushplan_lab::trivial::Projection;

use crate::fixtures::hand_push;

/// Returns a cylinder of 5 cm radius.
fn can(name: &str, x: f64, y: f64) -> Object {
    Object::cylinder(name, 0.05, 0.1).at(x, y, 0.0)
}

/// Returns two cans beside each other across the push, the first one straight in front of the hand.
fn pair(kind: JointKind) -> Scene {
    let objects = vec![can("a", 0.12, 0.0), can("b", 0.12, 0.101)];
    Scene::new(objects).with_joint([0, 1], kind)
}

/// Returns a push of 0.3 m along x by a round hand.
fn job(scene: &Scene) -> Job {
    Job::stated(scene, hand_push(Vector::zeros(), 0.0, 0.3, 0.1))
}

fn roll(model: &dyn EffectModel, scene: &Scene) -> Trajectory {
    model.rollout(scene, &[job(scene)], Record::Frames).remove(0)
}

/// Returns the pose of the second object relative to the first.
fn relative(state: &State) -> Pose {
    state.poses[0].inverse() * state.poses[1]
}

#[test]
fn a_fixed_pair_turns_as_one_body_in_the_projection_as_in_the_simulator() {
    let scene = pair(JointKind::Fixed);
    let before = relative(&scene.start());
    let projected = roll(&Projection, &scene);
    for frame in &projected.frames {
        let now = relative(&frame.state);
        assert!((now.position - before.position).norm() < 1e-5, "{now:?}");
        assert!(wrap_angle(now.heading - before.heading).abs() < 1e-5, "{now:?}");
    }
    let simulated = roll(&Simulated::new(Simulator::planar()), &scene);
    let turn = |trajectory: &Trajectory| trajectory.outcome().poses[0].heading;
    assert!(turn(&projected) > 0.3 && turn(&simulated) > 0.3, "both turn the same way round");
}

#[test]
fn the_other_joints_hold_in_the_projection() {
    let revolute = pair(JointKind::Revolute { at: Vector::new(0.12, 0.05), limits: None });
    let frames = revolute.joints[0].frames(&revolute.objects);
    for frame in &roll(&Projection, &revolute).frames {
        let [first, second] = [0, 1].map(|k| frame.state.poses[k] * frames[k]);
        assert!((first.position - second.position).norm() < 1e-5);
    }
    let limits = Some(Span::new(-0.05, 0.02));
    let prismatic = pair(JointKind::Prismatic { axis: Vector::x(), limits });
    let end = roll(&Projection, &prismatic);
    let shift = relative(end.outcome()).position;
    // The first slides up to the limit, then takes the second along.
    assert!((shift.x + 0.05).abs() < 1e-5 && (shift.y - 0.101).abs() < 1e-5, "{shift:?}");
}

#[test]
fn assumptions_replace_the_joints_and_nothing_else() {
    let scene = pair(JointKind::Fixed);
    let free = Scene { joints: Vec::new(), ..scene.clone() };
    let assuming = |belief| {
        let joints = Some(belief);
        Assuming::new(Projection, Assumptions { joints, ..Assumptions::default() })
    };
    let without = roll(&assuming(JointBelief::None), &scene);
    assert_eq!(without.by.to_string(), "projection,joints=none");
    assert_eq!(without.frames, roll(&Projection, &free).frames);
    let fixed = roll(&assuming(JointBelief::Fixed), &free);
    assert_eq!(fixed.frames, roll(&Projection, &scene).frames);
    let guessed = roll(&assuming(JointBelief::Guessed), &scene);
    assert_eq!(guessed.frames, roll(&Projection, &scene).frames);
}
