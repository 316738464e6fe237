//! Joints to the world in a task file: `between: [door, world]`, or with an obstacle, which is also
//! fixed.

use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;
use crate::scene::{Object, WorldJoint};

use super::joint_kind::kind_of;

/// Name of the world in place of one of a joint's objects.
pub(in crate::asset) const WORLD: &str = "world";

/// Returns the name of the object if the other end of the joint is the world or an obstacle.
pub(super) fn moving<'a>(
    joint: &'a Node,
    objects: &[Node],
    obstacles: &[Node],
) -> Option<&'a Node> {
    let named = |nodes: &[Node], name: &Node| {
        nodes.iter().any(|node| name_of(node).is_some() && name_of(node) == name.text())
    };
    let fixed = |name: &Node| {
        !named(objects, name) && (name.text() == Some(WORLD) || named(obstacles, name))
    };
    match joint.get("between")?.items() {
        [object, other] if fixed(other) && !fixed(object) => Some(object),
        [other, object] if fixed(other) && !fixed(object) => Some(object),
        _ => None,
    }
}

/// Returns the joint to the world; `None` if a required value is missing or faulty.
pub(in crate::asset) fn mount(
    joint: &Node,
    object: &Node,
    objects: &[Object],
) -> Option<WorldJoint> {
    let name = object.text()?;
    let object = objects.iter().position(|object| object.name == name)?;
    Some(WorldJoint::new(object, kind_of(joint)?))
}

/// Reports the faults that are specific to joints to the world.
pub(super) fn check(joint: &Node, ledger: &mut Ledger) {
    if joint.get("kind").and_then(Node::text) == Some("fixed") {
        ledger.fault(joint, "an object fixed to the world cannot move", "make it an obstacle");
    }
    if let Some(guessed) = joint.get("guessed").filter(|guessed| guessed.switch() == Some(true)) {
        let advice = "remove it; joints to the world must be known";
        ledger.fault(guessed, "a joint to the world cannot be a guess", advice);
    }
}
