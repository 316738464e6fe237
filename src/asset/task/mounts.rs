//! Joints to the world in a task file: `between: [door, world]`, or an obstacle, which is as fixed.

use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;

/// What a joint may name instead of one of its objects.
pub(in crate::asset) const WORLD: &str = "world";

/// Which of a joint's two names is that of an object, where the other is of what does not move.
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

/// Notes what is wrong with a joint to the world besides what is with any joint.
pub(super) fn check(joint: &Node, ledger: &mut Ledger) {
    if joint.get("kind").and_then(Node::text) == Some("fixed") {
        ledger.fault(joint, "what is fixed to the world does not move", "make it an obstacle");
    }
    if let Some(guessed) = joint.get("guessed").filter(|guessed| guessed.switch() == Some(true)) {
        let advice = "remove it; what joins an object to the world is always known";
        ledger.fault(guessed, "a joint to the world cannot be a guess", advice);
    }
}
