//! Independence of the analytic model from the description of a scene: the world's axes and the
//! order of lists.

use std::sync::Arc;

use pushplan::{
    asset::ToolLibrary,
    effect::{EffectModel, Prior},
    geometry::{Pose, Shape},
    outcome::Record,
    scene::{JointKind, State, Tool},
    task::Job,
};
use pushplan_lab::bench::{Case, Suite, SuiteKind, crowd_cases};

/// Tolerance, metres. The effect of rounding is up to a hundredth of it, in pushes of touching
/// cuboids.
const SAME: f64 = 1e-8;

/// Returns held-out pushes of single and touching objects, and crowds with joints.
fn cases() -> Vec<Case> {
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let mut cases = Suite::draw(SuiteKind::Single, &library, 11, 60).cases;
    cases.extend(Suite::draw(SuiteKind::Touching, &library, 11, 60).cases);
    cases.extend(crowd_cases(8, 11, 4));
    cases
}

fn predict(case: &Case) -> State {
    let Case { scene, motion } = case;
    let job = Job::stated(scene, motion.clone());
    Prior::default().rollout(scene, &[job], Record::Outcome)[0].outcome().clone()
}

fn assert_same(a: &State, b: &State) {
    for (p, q) in a.poses.iter().zip(&b.poses) {
        assert!((p.position - q.position).norm() < SAME, "{p:?} {q:?}");
    }
}

#[test]
fn turning_and_shifting_the_world_does_the_same_to_the_prior() {
    let by = Pose::new(0.3, -0.2, 0.7);
    for case in cases() {
        let mut there = case.clone();
        there.scene.objects.iter_mut().for_each(|o| o.pose = by * o.pose);
        there.scene.obstacles.iter_mut().for_each(|o| o.pose = by * o.pose);
        for joint in &mut there.scene.joints {
            match &mut joint.kind {
                JointKind::Revolute { at, .. } => *at = by.point(*at),
                JointKind::Prismatic { axis, .. } => *axis = by.vector(*axis),
                JointKind::Fixed => {}
            }
        }
        for stroke in &mut there.motion.strokes {
            (stroke.from, stroke.to) = (by * stroke.from, by * stroke.to);
        }
        let back = predict(&there).poses.iter().map(|p| by.inverse() * *p).collect();
        assert_same(&predict(&case), &State::at_rest(back));
    }
}

#[test]
fn the_order_of_objects_and_parts_does_not_matter_to_the_prior() {
    for case in cases() {
        let mut other = case.clone();
        let last = other.scene.objects.len() - 1;
        other.scene.objects.reverse();
        other.scene.joints.reverse();
        other.scene.joints.iter_mut().for_each(|j| j.between = j.between.map(|k| last - k));
        let tool = Tool::clone(&other.motion.tool);
        let parts: Vec<_> = tool.parts().iter().rev().cloned().collect();
        other.motion.tool = Arc::new(tool.with_parts(parts).expect("one piece"));
        let mut there = predict(&other);
        there.poses.reverse();
        assert_same(&predict(&case), &there);
    }
}

#[test]
fn another_description_of_the_same_solid_changes_nothing_for_the_prior() {
    for case in cases() {
        let mut other = case.clone();
        // Joints are relative to the objects' poses, so only free objects are rewritten.
        let jointed: Vec<usize> = case.scene.joints.iter().flat_map(|j| j.between).collect();
        for (k, object) in other.scene.objects.iter_mut().enumerate() {
            if jointed.contains(&k) {
                continue;
            }
            match &mut object.shape {
                Shape::Cuboid { size: [length, width, _] } => {
                    std::mem::swap(length, width);
                    object.pose.heading += std::f64::consts::FRAC_PI_2;
                }
                Shape::Cylinder { .. } => object.pose.heading += 1.0,
                Shape::Prism { .. } => {}
            }
        }
        assert_same(&predict(&case), &predict(&other));
    }
}
