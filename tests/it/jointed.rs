//! Predictions of jointed scenes: symmetries and joint constraints.

use pushplan::{
    effect::{EffectModel, Network, Prior},
    geometry::{Pose, Shape, Vector, perpendicular, wrap_angle},
    network::PredictorWeights,
    outcome::Record,
    scene::{Joint, JointKind, Scene, Span, State},
    task::{Job, Stroke, ToolMotion},
};

use super::network::assert_same;
use super::random_network::{half_stroke, object, stroke, tool, weights};

/// Returns a box in front of the tool, hinged to a cylinder, which slides along a second box, which
/// is fixed to a second cylinder.
fn scene() -> Scene {
    let cylinder = |x, y| object(Shape::Cylinder { radius: 0.04, height: 0.1 }, x, y, 0.0);
    let objects = vec![
        object(Shape::Cuboid { size: [0.08, 0.05, 0.1] }, 0.075, 0.012, 0.2),
        cylinder(0.17, 0.03),
        object(Shape::Cuboid { size: [0.06, 0.05, 0.1] }, 0.19, 0.10, 0.7),
        cylinder(0.12, 0.14).mass(0.9),
    ];
    let limits = Some(Span::new(-0.3, 0.2));
    let at = Vector::new(0.125, 0.02);
    let axis = Vector::new(0.8, 0.6);
    let joints = vec![
        Joint::new([0, 1], JointKind::Revolute { at, limits }),
        Joint::new([1, 2], JointKind::Prismatic { axis, limits: None }),
        Joint::new([2, 3], JointKind::Fixed),
    ];
    Scene { joints, ..Scene::new(objects).on_table(0.4) }
}

/// Returns random weights whose correction is small compared to the analytic model, because ten
/// frames of noise through three joints amplify any rounding.
fn gentle() -> PredictorWeights {
    let mut weights = weights(64);
    for name in ["motion.even", "motion.odd"] {
        if let Some(values) = weights.parameters.values.get_mut(name) {
            values.iter_mut().for_each(|value| *value *= 0.1);
        }
    }
    weights
}

fn moved(by: Pose) -> Scene {
    let mut scene = scene();
    scene.objects.iter_mut().for_each(|object| object.pose = by * object.pose);
    for joint in &mut scene.joints {
        match &mut joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute { at, .. } => *at = by.point(*at),
            JointKind::Prismatic { axis, .. } => *axis = by.vector(*axis),
        }
    }
    scene
}

fn rollout(model: &dyn EffectModel, scene: &Scene, stroke: Stroke) -> State {
    let motion = ToolMotion { tool: tool(), lift: 0.002, strokes: vec![stroke] };
    let job = Job::stated(scene, motion);
    model.rollout(scene, &[job], Record::Outcome)[0].outcome().clone()
}

#[test]
fn turning_and_shifting_a_jointed_scene_turns_and_shifts_the_prediction() {
    let model = Network::new(gentle());
    let plain = rollout(&model, &scene(), half_stroke());
    for by in [Pose::new(0.7, -1.3, 2.2), Pose::new(-4.0, 2.0, -0.4)] {
        let turned =
            Stroke { from: by * half_stroke().from, to: by * half_stroke().to, ..half_stroke() };
        let there = rollout(&model, &moved(by), turned);
        let back = State::at_rest(there.poses.iter().map(|p| by.inverse() * *p).collect());
        assert_same(&plain, &back);
    }
}

#[test]
fn the_order_of_objects_and_joints_does_not_matter() {
    let model = Network::new(gentle());
    let plain = rollout(&model, &scene(), stroke());
    let mut other = scene();
    let last = other.objects.len() - 1;
    other.objects.reverse();
    other.joints.reverse();
    other.joints.iter_mut().for_each(|joint| joint.between = joint.between.map(|k| last - k));
    let mut there = rollout(&model, &other, stroke());
    there.poses.reverse();
    assert_same(&plain, &there);
}

#[test]
fn naming_the_two_objects_of_a_joint_the_other_way_round_changes_nothing() {
    let plain = rollout(&Prior::default(), &scene(), stroke());
    let mut other = scene();
    for joint in &mut other.joints {
        joint.between.reverse();
        if let JointKind::Revolute { limits: Some(limits), .. } = &mut joint.kind {
            *limits = Span::new(-limits.high, -limits.low);
        }
    }
    assert_same(&plain, &rollout(&Prior::default(), &other, stroke()));
}

/// Returns the largest joint violation: metres, or radians at 5 cm.
fn violation(scene: &Scene, state: &State) -> f64 {
    let off = |joint: &Joint| {
        let frames = joint.frames(&scene.objects);
        let [a, b] = [0, 1].map(|k| state.poses[joint.between[k]] * frames[k]);
        let apart = b.position - a.position;
        let turned = 0.05 * wrap_angle(b.heading - a.heading);
        match joint.kind {
            JointKind::Fixed => apart.norm().max(turned.abs()),
            JointKind::Revolute { .. } => {
                let limits = joint.limits().unwrap_or(Span::new(-9.0, 9.0));
                let turned = turned / 0.05;
                let beyond = (turned - turned.clamp(limits.low, limits.high)).abs();
                apart.norm().max(0.05 * beyond)
            }
            JointKind::Prismatic { .. } => {
                apart.dot(&perpendicular(a.vector(Vector::x()))).abs().max(turned.abs())
            }
        }
    };
    scene.joints.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn joints_hold_for_every_output_of_the_network() {
    let long = Stroke { to: Pose::new(0.6, 0.1, 0.0), duration: 4.0, ..stroke() };
    let models: [Box<dyn EffectModel>; 2] =
        [Box::new(Network::new(gentle())), Box::new(Prior::default())];
    for model in models {
        let end = rollout(&*model, &scene(), long);
        let travel = (end.poses[3].position - scene().objects[3].pose.position).norm();
        assert!(travel > 0.05, "{}: the whole group is pushed, {travel} m", model.spec());
        let off = violation(&scene(), &end);
        assert!(off < 1e-8, "{}: off by {off} m after 60 frames", model.spec());
    }
}

#[test]
fn objects_without_a_push_stay_jointed_or_not() {
    let aside =
        Stroke { from: Pose::new(0.0, -0.5, 0.0), to: Pose::new(0.2, -0.5, 0.0), ..stroke() };
    let end = rollout(&Network::new(gentle()), &scene(), aside);
    assert_eq!(end, scene().start());
}

#[test]
fn a_fixed_pair_is_predicted_as_the_one_body_it_is() {
    // Two squares side by side, fixed, are one rectangle with twice the mass.
    let square = |y| object(Shape::Cuboid { size: [0.06, 0.06, 0.1] }, 0.06, y, 0.0);
    let both =
        Scene::new([square(0.0), square(0.06)]).on_table(0.4).with_joint([0, 1], JointKind::Fixed);
    let whole = object(Shape::Cuboid { size: [0.06, 0.12, 0.1] }, 0.06, 0.03, 0.0).mass(0.8);
    let one = Scene { objects: vec![whole], joints: Vec::new(), ..both.clone() };
    let (pair, single) =
        (rollout(&Prior::default(), &both, stroke()), rollout(&Prior::default(), &one, stroke()));
    let middle = (pair.poses[0].position + pair.poses[1].position) / 2.0;
    // The support models differ: two ellipsoids instead of one.
    assert!((middle - single.poses[0].position).norm() < 2e-3, "{pair:?} {single:?}");
    assert!((pair.poses[0].heading - single.poses[0].heading).abs() < 0.03);
}
