//! Scenes and motions shared by several tests.

use std::sync::Arc;

use pushplan::effect::{EffectModel, Prior, Simulated};
use pushplan::geometry::{Pose, Shape, Vector, wrap_angle};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::{Joint, JointKind, Object, Part, Scene, State, Tool},
    task::{Job, Push, ToolMotion},
};

/// Returns the analytic model and the engines, by name.
pub fn models() -> [(&'static str, Box<dyn EffectModel>); 4] {
    [
        ("prior", Box::new(Prior::default())),
        ("planar", Box::new(Simulated::new(Simulator::planar()))),
        ("upright", Box::new(Simulated::new(Simulator::upright()))),
        ("spatial", Box::new(Simulated::new(Simulator::spatial()))),
    ]
}

/// Returns the state at the end of a motion.
pub fn end(model: &dyn EffectModel, scene: &Scene, motion: &ToolMotion) -> State {
    let job = Job::stated(scene, motion.clone());
    model.rollout(scene, &[job], Record::Outcome)[0].outcome().clone()
}

/// Returns a cylinder of 10 cm diameter and height at the origin.
pub fn can() -> Object {
    Object::cylinder("can", 0.05, 0.1)
}

/// Returns a cuboid of 10 x 6 x 5 cm at the origin.
pub fn brick() -> Object {
    Object::cuboid("brick", [0.10, 0.06, 0.05])
}

/// Returns a bar of 2 x 20 x 5 cm across x, with its front face at the end effector.
pub fn bar() -> Arc<Tool> {
    let part = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::new(-0.01, 0.0, 0.0));
    Arc::new(Tool::new("bar", [part]).expect("one part is one piece"))
}

/// Returns a settled straight push of the bar, with its face across the direction of motion.
pub fn push(start: Vector, direction: f64, length: f64, speed: f64) -> ToolMotion {
    ToolMotion::pushes(bar(), 0.002, direction, &[Push { start, direction, length, speed }], true)
}

/// Returns both engines at their default step.
pub fn engines() -> [Simulator; 2] {
    [Simulator::planar(), Simulator::spatial()]
}

/// Returns a hand as in Tekden (2020): a cylinder of 10 cm diameter about the end effector.
pub fn hand() -> Arc<Tool> {
    let shape = Shape::Cylinder { radius: 0.05, height: 0.1 };
    let part = Part::new("hand", shape, Pose::default());
    Arc::new(Tool::new("hand", [part]).expect("one part is one piece"))
}

/// Returns a settled straight push of the hand.
pub fn hand_push(start: Vector, direction: f64, length: f64, speed: f64) -> ToolMotion {
    ToolMotion::pushes(hand(), 0.002, 0.0, &[Push { start, direction, length, speed }], true)
}

/// Returns `count` objects like `model` in a row along y, `pitch` metres apart, each joined to the
/// next by the joint `kind` at the midpoint between them.
pub fn row(count: usize, model: &Object, pitch: f64, kind: fn(Vector) -> JointKind) -> Scene {
    let object = |k: usize| Object {
        name: format!("o{k}"),
        pose: Pose::new(0.0, pitch * k as f64, model.pose.heading),
        ..model.clone()
    };
    let joint = |k: usize| {
        let between = Vector::new(0.0, pitch * (k as f64 - 0.5));
        Joint::new([k - 1, k], kind(between))
    };
    Scene { joints: (1..count).map(joint).collect(), ..Scene::new((0..count).map(object)) }
}

/// Returns the displacement of the second object of joint `index` relative to the first:
/// translation in the joint's own frame (metres) and rotation (radians).
pub fn opened(scene: &Scene, state: &State, index: usize) -> Pose {
    let joint = &scene.joints[index];
    let [first, second] = joint.frames(&scene.objects);
    let [a, b] = joint.between.map(|object| state.poses[object]);
    let relative = (a * first).inverse() * (b * second);
    Pose { heading: wrap_angle(relative.heading), ..relative }
}

/// Returns the largest constraint violation over all joints and frames: distance (metres) and angle
/// (radians).
pub fn drift(scene: &Scene, trajectory: &Trajectory) -> (f64, f64) {
    let (mut distance, mut angle) = (0f64, 0f64);
    for frame in &trajectory.frames {
        for (index, joint) in scene.joints.iter().enumerate() {
            let Pose { position, heading } = opened(scene, &frame.state, index);
            let (held, turned) = match joint.kind {
                JointKind::Fixed => (position.norm(), heading),
                JointKind::Revolute { .. } => (position.norm(), 0.0),
                JointKind::Prismatic { .. } => (position.y.abs(), heading),
            };
            (distance, angle) = (distance.max(held), angle.max(turned.abs()));
        }
    }
    (distance, angle)
}
