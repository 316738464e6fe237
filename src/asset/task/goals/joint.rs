//! Goals of a joint's displacement.

use crate::asset::node::Node;
use crate::asset::spec::{ANGLE, Key, SHIFT_LIMIT};
use crate::asset::strict::Ledger;
use crate::asset::take::{angle, angle_of};
use crate::asset::task::world_joints::moving;
use crate::geometry::Pose;
use crate::{
    scene::{JointKind, Scene},
    task::{AtPlace, Demand, Facing},
};

use super::ask::{About, Ask, Asked};
use super::heading::HEADING_TOLERANCE;

/// Entry for the rotation of a revolute joint, stored as the resulting heading.
pub(super) const TURN: Ask = Ask {
    keys: &[Key::optional(
        "joint_deg",
        ANGLE,
        "Required rotation of its revolute joint, degrees counter-clockwise from the start, \
         relative to the joined body. The rotation stays within the joint's limits, even if that \
         is the longer way; without limits the shorter way counts. By default any.",
    )],
    about: About::Turn,
    read: |goal, object, scene| {
        let within = angle(goal, "heading_tolerance_deg", HEADING_TOLERANCE)?;
        let (there, relative) = come(scene, object, angle_of(goal.get("joint_deg")?)?)?;
        Some(Demand::Heading(Facing { relative, ..Facing::new(there.heading, within) }))
    },
    write: |_, _, _| None,
    check: |asked, ledger| has_joint(asked, ("joint_deg", "revolute"), ledger),
};

/// Entry for the displacement of a prismatic joint, stored as the resulting position.
pub(super) const SHIFT: Ask = Ask {
    keys: &[Key::optional(
        "joint",
        SHIFT_LIMIT,
        "Required displacement of its prismatic joint, metres along the axis from the start, \
         relative to the joined body; by default any.",
    )],
    about: About::Place,
    read: |goal, object, scene| {
        let (there, relative) = come(scene, object, goal.get("joint")?.number()?)?;
        let (position, tolerance) = (there.position, goal.get("tolerance")?.number()?);
        Some(Demand::Place(AtPlace { position, tolerance, relative }))
    },
    write: |_, _, _| None,
    check: |asked, ledger| has_joint(asked, ("joint", "prismatic"), ledger),
};

/// Checks that the object of a joint goal has exactly one movable joint, of the right kind.
fn has_joint(asked: &Asked, (key, kind): (&str, &str), ledger: &mut Ledger) {
    let Some(node) = asked.goal.get(key) else { return };
    let joints = asked.section("joints");
    let own = joints.iter().filter(|joint| {
        let between = joint.get("between").map(Node::items).unwrap_or_default();
        between.iter().any(|name| name.text() == asked.name.text())
            && joint.get("kind").and_then(Node::text) != Some("fixed")
    });
    let own: Vec<&Node> = own.collect();
    let name = asked.name.text().unwrap_or("?");
    match own[..] {
        [joint] if joint.get("kind").and_then(Node::text) == Some(kind) => {
            within_limits(node, joint, asked, ledger);
        }
        [_] => {
            let message = format!("the joint of `{name}` is not {kind}");
            let advice = "use `joint_deg` for rotations and `joint` for displacements";
            ledger.fault(node, message, advice);
        }
        [] => {
            let message = format!("`{name}` has no joint that can move");
            ledger.fault(node, message, "name an object with a revolute or prismatic joint");
        }
        _ => {
            let message =
                format!("`{name}` has several joints, so the choice of the joint is ambiguous");
            ledger.fault(node, message, "state a position or a heading instead");
        }
    }
    if let Some(other) = asked.goal.get("relative_to") {
        let advice = "leave it out; a joint is measured relative to the joined body";
        ledger.fault(other, format!("`{key}` is already relative to the joined body"), advice);
    }
}

/// Checks that the wanted displacement is within the limits of the joint.
fn within_limits(wanted: &Node, joint: &Node, asked: &Asked, ledger: &mut Ledger) {
    let limits = joint.get("limits").or_else(|| joint.get("limits_deg"));
    let [Some(low), Some(high)] =
        [0, 1].map(|k| limits.and_then(|limits| limits.items().get(k)).and_then(Node::number))
    else {
        return;
    };
    let to_world = moving(joint, asked.section("objects"), asked.section("obstacles")).is_some();
    let between = joint.get("between").map(Node::items).unwrap_or_default();
    let first = between.first().and_then(Node::text) == asked.name.text();
    // Limits describe the motion of the second object relative to the first.
    let (low, high) = if first && !to_world { (-high, -low) } else { (low, high) };
    if wanted.number().is_some_and(|wanted| wanted < low || wanted > high) {
        let name = asked.name.text().unwrap_or("?");
        let message = format!("the joint of `{name}` moves only from {low} to {high}");
        ledger.fault(wanted, message, "choose a value in this range, or widen the joint's limits");
    }
}

/// Returns the pose of an object after its joint has moved by `by`, radians or metres. The pose is
/// in the world, or in the frame of the object at the other end of the joint.
fn come(scene: &Scene, object: usize, by: f64) -> Option<(Pose, Option<usize>)> {
    let start = scene.objects[object].pose;
    if let Some(mount) = scene.mounts.iter().find(|mount| mount.object == object) {
        return Some((mount.pose(&start, by), None));
    }
    let moves = |kind: &JointKind| *kind != JointKind::Fixed;
    let mut joints = scene.joints.iter().filter(|joint| moves(&joint.kind));
    let joint = joints.find(|joint| joint.between.contains(&object))?;
    let [first, second] = joint.between;
    // Displacements describe the motion of the second object relative to the first.
    let (other, by) = if second == object { (first, by) } else { (second, -by) };
    let frame = scene.objects[other].pose.inverse() * start;
    let there = match joint.kind {
        JointKind::Prismatic { axis, .. } => {
            let axis = scene.objects[other].pose.local_vector(axis);
            Pose { position: frame.position + by * axis, ..frame }
        }
        _ => Pose { heading: frame.heading + by, ..frame },
    };
    Some((there, Some(other)))
}
