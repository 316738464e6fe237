//! Keys that do not go together with lever-ups, each with the reason.

use crate::asset::node::{Content, Node};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;

use super::{goals, part, plates};

/// Reason for cylinders.
const EDGES: &str = "a blade goes under a straight edge";
/// Reason for a centre of mass of a solid.
const EVEN: &str = "give parts with a `mass` of their own to what a blade lifts";

/// Notes what a task that allows lever-ups has and cannot have.
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
    // Something must be there for a blade: the object of a goal.
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

/// Notes the keys that a node has and cannot have.
fn refuse(node: Option<&Node>, keys: &[&str], reason: &str, ledger: &mut Ledger) {
    for key in keys {
        // What is written back may name none of something.
        let none = Content::List(Vec::new());
        let found = node.and_then(|node| node.get(key)).filter(|found| found.content != none);
        if let Some(found) = found {
            ledger.fault(found, format!("`{key}` does not go together with lever-ups"), reason);
        }
    }
}

/// Notes objects that say how high they are where nothing is levered.
pub(super) fn check_heights(objects: &[Node], ledger: &mut Ledger) {
    let advice =
        "add `levers`, or remove it: pushes alone are planned for what stands on the table";
    for object in objects {
        for key in ["clearance", "z"] {
            if let Some(node) = object.get(key) {
                let message = format!("`{key}` needs lever-ups, which this task does not allow");
                ledger.fault(node, message, advice);
            }
        }
    }
}
