//! Baselines in scenes with joints: the projection holds them, and models can be told otherwise.

use std::sync::Arc;

use pushplan::{
    effect::{Assuming, EffectModel, EffectModels, Job, Projection, Simulated, Still},
    geometry::{Pose, Vector, wrap_angle},
    outcome::{Record, Trajectory},
    scene::{Assumptions, JointBelief, JointKind, Object, Scene, Span, State},
    sim::Simulator,
};

use crate::fixtures::hand_push;

/// A cylinder of 5 cm radius.
fn can(name: &str, x: f64, y: f64) -> Object {
    Object::cylinder(name, 0.05, 0.1).at(x, y, 0.0)
}

/// Two cans beside each other across the push, the first one straight in front of the hand.
fn pair(kind: JointKind) -> Scene {
    let objects = vec![can("a", 0.12, 0.0), can("b", 0.12, 0.101)];
    Scene::new(objects).with_joint([0, 1], kind)
}

/// A round hand pushes 0.3 m along x.
fn job(scene: &Scene) -> Job {
    Job::stated(scene, hand_push(Vector::zeros(), 0.0, 0.3, 0.1))
}

fn roll(model: &dyn EffectModel, scene: &Scene) -> Trajectory {
    model.rollout(scene, &[job(scene)], Record::Frames).remove(0)
}

/// The second object as the first one sees it.
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
    // The first slides on until the limit, then takes the second along.
    assert!((shift.x + 0.05).abs() < 1e-5 && (shift.y - 0.101).abs() < 1e-5, "{shift:?}");
}

#[test]
fn assumptions_replace_the_joints_and_nothing_else() {
    let scene = pair(JointKind::Fixed);
    let free = Scene { joints: Vec::new(), ..scene.clone() };
    let told = |belief| {
        let joints = Some(belief);
        Assuming::new(Projection, Assumptions { joints, ..Assumptions::default() })
    };
    let without = roll(&told(JointBelief::None), &scene);
    assert_eq!(without.by.to_string(), "projection,joints=none");
    assert_eq!(without.frames, roll(&Projection, &free).frames);
    let fixed = roll(&told(JointBelief::Fixed), &free);
    assert_eq!(fixed.frames, roll(&Projection, &scene).frames);
    let guessed = roll(&told(JointBelief::Guessed), &scene);
    assert_eq!(guessed.frames, roll(&Projection, &scene).frames);
}

/// Told that joints are guesses it used to end twice and more as far off as with the same geometry
/// taken for known.
#[test]
fn the_network_plays_a_guessed_joint_like_a_known_one() {
    let network = EffectModels::build(&"network".parse().expect("a model")).expect("its weights");
    for kind in [
        JointKind::Revolute { at: Vector::new(0.12, 0.0505), limits: None },
        JointKind::Prismatic { axis: Vector::y(), limits: None },
    ] {
        let known = pair(kind);
        let mut guessed = known.clone();
        guessed.joints[0].guessed = true;
        assert_eq!(roll(&network, &guessed).frames, roll(&network, &known).frames);
        let free = Scene { joints: Vec::new(), ..known.clone() };
        assert_ne!(roll(&network, &free).frames, roll(&network, &known).frames);
    }
}

#[test]
fn mistakes_change_friction_or_the_start_and_keep_joints_whole() {
    let scene = pair(JointKind::Fixed);
    let planar = Simulated::new(Simulator::planar());
    let told = Assumptions { friction: Some(70), ..Assumptions::default() };
    let slippery = Assuming::new(planar.clone(), told);
    assert_eq!(slippery.spec().to_string(), "planar,friction=70%");
    assert_eq!(slippery.trust(&scene, &job(&scene)).error(), None, "measured with what is true");
    let mut lighter = scene.clone();
    lighter.table_friction *= 0.7;
    lighter.objects.iter_mut().for_each(|object| object.friction *= 0.7);
    let mut with_lighter_tool = job(&lighter);
    let mut tool = (*with_lighter_tool.motion.slide().tool).clone();
    tool.friction *= 0.7;
    with_lighter_tool.motion.slide_mut().tool = Arc::new(tool);
    let expected = planar.rollout(&lighter, &[with_lighter_tool], Record::Frames).remove(0);
    assert_eq!(roll(&slippery, &scene).frames, expected.frames);

    let told = Assumptions { start: Some(100), ..Assumptions::default() };
    let moved = Assuming::new(Still, told);
    assert_eq!(moved.spec().to_string(), "still,start=100um");
    let start = roll(&moved, &scene).outcome().clone();
    let off = |k: usize| start.poses[k].position - scene.objects[k].pose.position;
    assert!((off(0).norm() - 1e-4).abs() < 1e-12);
    assert!((off(0) - off(1)).norm() < 1e-12, "joined objects move together");
    assert_eq!(roll(&moved, &scene).outcome(), &start);
}
