//! Keys that are incompatible with lever-ups, each with the reason.

use crate::asset::node::{Content, Node};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;

use super::{goals, part, plates};

/// Reason against cylinders.
const EDGES: &str = "a blade can enter only below a straight edge";
/// Reason against a stated centre of mass of a solid.
const EVEN: &str = "to shift the centre of mass of a levered object, give it parts with their own \
    `mass`";

/// Reports the keys that a task with lever-ups cannot have.
pub(super) fn check(root: &Node, ledger: &mut Ledger) {
    let inner = |key| root.get("scene").and_then(|scene| scene.get(key));
    let arm = "lever-ups are planned for a hand, not for the joints of an arm";
    refuse(root.get("robot"), &["urdf"], arm, ledger);
    let objects = inner("objects").map(Node::items).unwrap_or_default();
    for object in objects.iter().filter(|object| plates::is_plate(object)) {
        std::iter::once(object).chain(part::parts(object)).for_each(|one| solid(one, ledger));
    }
    let goals = root.get("goal").map(goals::each).unwrap_or_default();
    let of = |goal: &Node| {
        let wanted = goal.get("object")?.text();
        objects.iter().find(|one| name_of(one) == wanted)
    };
    let is_plate = |goal: &Node| of(goal).is_none_or(plates::is_plate);
    // At least one object of a goal must have clearance for a blade.
    let none = !goals.iter().any(is_plate);
    let needs =
        |(k, goal): &(usize, &Node)| (goals::lifts(goal) || none && *k == 0) && !is_plate(goal);
    for object in goals.iter().enumerate().filter(needs).filter_map(|(_, goal)| of(goal)) {
        let advice = "6 mm of feet are `clearance: 0.006`; `z` alone is a plate on obstacles";
        ledger.fault(object, "this object has neither `clearance` nor `z`", advice);
    }
}

fn solid(body: &Node, ledger: &mut Ledger) {
    let shape = body.get("shape");
    refuse(shape, &["cylinder"], EDGES, ledger);
    refuse(shape.and_then(|shape| shape.get("prism")), &["centre_of_mass"], EVEN, ledger);
}

/// Reports the keys of `node` that are refused.
fn refuse(node: Option<&Node>, keys: &[&str], reason: &str, ledger: &mut Ledger) {
    for key in keys {
        // An empty list is accepted, because written files may contain one.
        let none = Content::List(Vec::new());
        let found = node.and_then(|node| node.get(key)).filter(|found| found.content != none);
        if let Some(found) = found {
            ledger.fault(found, format!("`{key}` cannot be combined with lever-ups"), reason);
        }
    }
}

/// Reports objects that state a height in a task without lever-ups.
pub(super) fn check_heights(objects: &[Node], ledger: &mut Ledger) {
    let advice =
        "add `levers`, or remove it; in tasks of pushes only, all objects stand on the table";
    for object in objects {
        for key in ["clearance", "z"] {
            if let Some(node) = object.get(key) {
                let message = format!("`{key}` needs lever-ups, which this task does not allow");
                ledger.fault(node, message, advice);
            }
        }
    }
}
