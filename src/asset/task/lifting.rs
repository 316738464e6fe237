//! Goals of lever-ups: outside of an obstacle, an edge raised, turned over.

use crate::asset::fault::did_you_mean;
use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;
use crate::scene::Scene;
use crate::task::{Demand, Flipped, Goal, Outside, Raised};

/// An obstacle that the object leaves.
pub(super) const OUTSIDE: Key = Key::optional(
    "outside",
    Value::Name,
    "Name of an obstacle, such as the floor of a tray: at rest the object's centre of mass lies \
     outside of it, seen from above; by default not asked for.",
);

/// How far an edge is lifted.
pub(super) const RAISED: Key = Key::optional(
    "raised",
    Value::Number(Range {
        what: "a height in metres",
        low: 0.001,
        high: 1.0,
        advice: "2 cm is 0.02",
    }),
    "At the end of a lever-up the edge lies on the blade, this much higher than at the start, metres; \
     by default not asked for.",
);

/// Which side is up.
pub(super) const FLIPPED: Key = Key::optional(
    "flipped",
    Value::Switch,
    "At rest the object lies upside down (true) or on its underside (false); by default not asked for.",
);

/// Keys of demands that lever-ups meet.
pub(super) const KEYS: [&str; 3] = [OUTSIDE.name, RAISED.name, FLIPPED.name];

/// Returns `true` if a goal asks for something that lever-ups bring about.
pub(super) fn lifts(goal: &Node) -> bool {
    KEYS.iter().any(|key| goal.get(key).is_some())
}

/// Adds these demands to a goal; `None` if one of them is faulty.
pub(super) fn lifted(node: &Node, scene: &Scene, mut goal: Goal) -> Option<Goal> {
    if let Some(name) = node.get("outside") {
        let name = name.text()?;
        let obstacle = scene.obstacles.iter().position(|obstacle| obstacle.name == name)?;
        goal = goal.with(Demand::Outside(Outside::of(scene, obstacle)?));
    }
    if let Some(height) = node.get("raised") {
        goal = goal.with(Demand::Raised(Raised { height: height.number()? }));
    }
    if let Some(flipped) = node.get("flipped") {
        goal = goal.with(Demand::Flipped(Flipped { flipped: flipped.switch()? }));
    }
    Some(goal)
}

/// Notes an obstacle that is not there.
pub(super) fn check_lifting(goal: &Node, [objects, obstacles]: [&[Node]; 2], ledger: &mut Ledger) {
    let Some((node, name)) = goal.get("outside").and_then(|node| Some((node, node.text()?))) else {
        return;
    };
    let is_named = |body: &Node| name_of(body) == Some(name);
    if obstacles.iter().any(is_named) {
        return;
    }
    let message = match objects.iter().any(is_named) {
        true => format!("`{name}` is not an obstacle"),
        false => format!("no obstacle is called `{name}`"),
    };
    ledger.fault(node, message, did_you_mean(name, obstacles.iter().filter_map(name_of)));
}
