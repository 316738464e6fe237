//! Keys that do not go together with lever-ups, each with the reason.

use crate::asset::node::{Content, Node};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;

use super::{goals, part, plates};

/// Reason for keys of a goal that only a task of pushes may have.
const NOT_PLANNED: &str = "no lever-up is planned for it";
/// Reason for keys of a scene.
const FREE: &str = "objects that are levered move freely, with frictions of their own";
/// Reason for keys of an object.
const STANDS: &str = "an object that is levered stands on its corners";
/// Reason for keys of a part.
const ALIKE: &str = "a blade lifts an object of one density and friction";
/// Reason for cylinders.
const EDGES: &str = "a blade goes under a straight edge";

/// Notes what a task that allows lever-ups has and cannot have.
pub(super) fn check(root: &Node, ledger: &mut Ledger) {
    let inner = |key| root.get("scene").and_then(|scene| scene.get(key));
    let arm = "lever-ups are planned for a hand, not for the joints of an arm";
    refuse(root.get("robot"), &["urdf"], arm, ledger);
    refuse(Some(root), &["keep_out"], "nothing watches regions while an object is levered", ledger);
    refuse(root.get("scene"), &["joints", "frictions", "push_height"], FREE, ledger);
    refuse(inner("table"), &["size"], "nothing watches the table's end here", ledger);
    let goals = root.get("goal").map(goals::each).unwrap_or_default();
    for goal in goals {
        let places = ["region", "gap", "coverage", "off_table", "joint_deg", "joint"];
        refuse(Some(goal), &places, NOT_PLANNED, ledger);
        refuse(Some(goal), &["relative_to", "weight"], NOT_PLANNED, ledger);
    }
    let objects = inner("objects").map(Node::items).unwrap_or_default();
    objects.iter().for_each(|one| object(one, ledger));
    for wanted in goals.iter().filter_map(|goal| goal.get("object")?.text()) {
        let levered = objects.iter().find(|object| name_of(object) == Some(wanted));
        if let Some(object) = levered.filter(|object| !plates::is_plate(object)) {
            let advice = "6 mm of feet are `clearance: 0.006`; `z` alone is a plate on obstacles";
            ledger.fault(object, "this object has neither `clearance` nor `z`", advice);
        }
    }
    if let [_, second, ..] = goals {
        ledger.fault(second, "lever-ups have one goal", "keep one of them");
    }
}

fn object(object: &Node, ledger: &mut Ledger) {
    refuse(Some(object), &["may_fall", "max_force"], STANDS, ledger);
    let is_plate = plates::is_plate(object);
    let friction = object.get("friction").and_then(Node::number);
    support(object, ledger);
    if is_plate {
        solid(object, ledger);
    }
    for part in part::parts(object) {
        refuse(Some(part), &["mass"], ALIKE, ledger);
        if part.get("friction").is_some_and(|own| own.number() != friction) {
            refuse(Some(part), &["friction"], ALIKE, ledger);
        }
        support(part, ledger);
        if is_plate {
            solid(part, ledger);
        }
    }
}

/// In three dimensions an object stands on its corners, or on its underside.
fn support(body: &Node, ledger: &mut Ledger) {
    if body.get("support").is_some_and(|support| support.text() != Some("even")) {
        refuse(Some(body), &["support"], STANDS, ledger);
    }
}

fn solid(body: &Node, ledger: &mut Ledger) {
    let shape = body.get("shape");
    refuse(shape, &["cylinder"], EDGES, ledger);
    let prism = shape.and_then(|shape| shape.get("prism"));
    refuse(prism, &["centre_of_mass"], ALIKE, ledger);
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
