//! Rules that span several keys of a goal.

use crate::asset::node::Node;
use crate::asset::shapes::shape;
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, vector};
use crate::geometry::{Footprint, Pose, clearance};

use super::bodies::{SLACK, body, known_object, passes};
use super::goals::{self, About, Asked, asking, is_key, lifts, ways_to_ask};
use super::part::parts;
use super::plates::is_plate;

/// Reports the faults of a goal.
pub(super) fn check(goal: &Node, scene: &Node, ledger: &mut Ledger) {
    let section = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let (objects, obstacles) = (section("objects"), section("obstacles"));
    demands(goal, ledger);
    let Some(name) = goal.get("object") else { return };
    goals::check(&Asked { goal, name, scene }, ledger);
    let Some(object) = known_object(name, objects, obstacles, ledger) else { return };
    let relative = goal.get("relative_to");
    let other = relative.and_then(|other| known_object(other, objects, obstacles, ledger));
    if let Some(node) = relative.filter(|_| other.is_some_and(|other| other.id == object.id)) {
        let advice = "name another object, or leave it out for the world";
        ledger.fault(node, "an object cannot be relative to itself", advice);
    }
    let solid = object.get("shape").and_then(shape);
    // A levered object may end on top of another body.
    if let Some(solid) = solid.as_ref().filter(|_| !is_plate(object)) {
        // Bodies in the frame of the goal: fixed bodies, or the object that the goal is relative
        // to.
        let fixed = obstacles.iter().filter(|fixed| !passes(object, fixed, SLACK));
        let there: Vec<(&Node, Footprint, Pose)> = match (relative, other) {
            (None, _) => fixed
                .filter_map(|fixed| body(fixed).map(|(solid, pose)| (fixed, solid, pose)))
                .collect(),
            (Some(_), Some(other)) if other.id != object.id => {
                let solid = other.get("shape").and_then(shape);
                solid.map(|solid| (other, solid.footprint(), Pose::default())).into_iter().collect()
            }
            _ => Vec::new(),
        };
        room_at_the_goal(goal, (name, &solid.footprint()), &there, ledger);
    }
    let round = solid.is_some_and(|solid| solid.is_cylinder()) && parts(object).is_empty();
    if let (Some(heading), true) = (goal.get("heading_deg"), round) {
        ledger.fault(
            heading,
            "a cylinder looks the same at every heading, so it cannot have a heading goal",
            "remove `heading_deg`, or make the object a cuboid",
        );
    }
}

/// Reports a goal that asks for nothing, or for one property twice.
fn demands(goal: &Node, ledger: &mut Ledger) {
    let has = |key: &str| goal.get(key).is_some();
    for (key, of, what) in [
        ("heading_tolerance_deg", ["heading_deg", "joint_deg"], "a heading tolerance"),
        ("symmetric", ["heading_deg", "heading_deg"], "`symmetric`"),
        ("tolerance", ["position", "joint"], "a tolerance"),
    ] {
        if let Some(node) = goal.get(key).filter(|_| !of.iter().any(|of| has(of))) {
            let needed = if key == "tolerance" { "position" } else { "heading" };
            let message = format!("{what} without a {needed}");
            ledger.fault(node, message, format!("add `{}`, or remove it", of[0]));
        }
    }
    for key in ["position", "joint"] {
        if let (Some(node), false) = (goal.get(key), has("tolerance")) {
            let message = format!("`{key}` needs a `tolerance`");
            ledger.fault(node, message, "add `tolerance: 0.02`, in metres");
        }
    }
    let (places, turns) =
        (asking(goal, &[About::Place, About::Pose]), asking(goal, &[About::Turn]));
    for twice in [&places, &turns].into_iter().filter(|keys| keys.len() > 1) {
        let message = format!("`{}` and `{}` constrain the same property", twice[0], twice[1]);
        ledger.fault(goal.get(twice[1]).unwrap_or(goal), message, "keep one of them");
    }
    for key in asking(goal, &[About::Pose]) {
        if let (Some(node), Some(turn)) = (goal.get(key), turns.first()) {
            let message = format!("`{key}` cannot be combined with `{turn}`");
            let advice = "keep one of them; a coverage has its own heading";
            ledger.fault(node, message, advice);
        }
    }
    if places.is_empty() && turns.is_empty() && !lifts(goal) {
        // A misspelt key is one fault, not two.
        let strange = goal.pairs().iter().any(|(key, _)| !is_key(key.text()));
        if !strange {
            let advice = format!("add {}", ways_to_ask());
            ledger.fault(goal, "the goal has no criterion", advice);
        }
    }
}

/// Reports a goal at which the object would penetrate another body at every heading and every
/// position within the tolerance.
fn room_at_the_goal(
    goal: &Node,
    (name, object): (&Node, &Footprint),
    there: &[(&Node, Footprint, Pose)],
    ledger: &mut Ledger,
) {
    let place = match goal.get("coverage").and_then(|coverage| coverage.get("position")) {
        Some(node) => Some((node, 0.0)),
        None => goal.get("position").zip(goal.get("tolerance").and_then(Node::number)),
    };
    let Some((node, tolerance)) = place else { return };
    let Some(at) = vector(node).map(|position| Pose { position, heading: 0.0 }) else { return };
    let core = Footprint::Disc { radius: object.inner_radius() - tolerance - SLACK };
    if core.inner_radius() <= 0.0 {
        return;
    }
    for (other, solid, pose) in there {
        if clearance((&core, &at), (solid, pose), SLACK) <= 0.0 {
            let [object, other] = [name.text(), name_of(other)].map(|n| n.unwrap_or("?"));
            ledger.fault(
                node,
                format!("at the goal `{object}` would overlap `{other}`"),
                "move the goal or the obstacle, or allow a larger tolerance",
            );
        }
    }
}
