//! Models under assumptions about joints, friction and start.

use std::sync::Arc;

use pushplan::{
    effect::{Assuming, EffectModel, EffectModels, Job, Simulated, Still},
    geometry::Vector,
    outcome::{Record, Trajectory},
    scene::{Assumptions, JointKind, Object, Scene},
    sim::Simulator,
};

use crate::fixtures::hand_push;

/// Returns a cylinder of 5 cm radius.
fn can(name: &str, x: f64, y: f64) -> Object {
    Object::cylinder(name, 0.05, 0.1).at(x, y, 0.0)
}

/// Returns two cans side by side across the push, the first straight in front of the hand.
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

/// Joints marked as guesses used to cause more than twice the error of the same joints taken as
/// known.
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
    let assumptions = Assumptions { friction: Some(70), ..Assumptions::default() };
    let slippery = Assuming::new(planar.clone(), assumptions);
    assert_eq!(slippery.spec().to_string(), "planar,friction=70%");
    assert_eq!(slippery.trust(&scene, &job(&scene)).error(), None, "measured with the true values");
    let mut lighter = scene.clone();
    lighter.table_friction *= 0.7;
    lighter.objects.iter_mut().for_each(|object| object.friction *= 0.7);
    let mut with_lighter_tool = job(&lighter);
    let mut tool = (*with_lighter_tool.motion.slide().tool).clone();
    tool.friction *= 0.7;
    with_lighter_tool.motion.slide_mut().tool = Arc::new(tool);
    let expected = planar.rollout(&lighter, &[with_lighter_tool], Record::Frames).remove(0);
    assert_eq!(roll(&slippery, &scene).frames, expected.frames);

    let assumptions = Assumptions { start: Some(100), ..Assumptions::default() };
    let moved = Assuming::new(Still, assumptions);
    assert_eq!(moved.spec().to_string(), "still,start=100um");
    let start = roll(&moved, &scene).outcome().clone();
    let off = |k: usize| start.poses[k].position - scene.objects[k].pose.position;
    assert!((off(0).norm() - 1e-4).abs() < 1e-12);
    assert!((off(0) - off(1)).norm() < 1e-12, "joined objects move together");
    assert_eq!(roll(&moved, &scene).outcome(), &start);
}
