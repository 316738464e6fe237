//! Goals of falling off the table, over any edge or a given one.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::spec::{Key, SHIFT_LIMIT, Value, numbers};
use crate::asset::strict::Ledger;
use crate::asset::take::vector;
use crate::asset::task::world_joints::moving;
use crate::{
    scene::{Scene, Span},
    task::{Demand, Edge, Fall},
};

use super::ask::{About, Ask, Asked};

/// Word for any edge.
const ANY: &str = "any";

/// Minimum length of the part of an edge that a goal may name, metres.
const SHORTEST: f64 = 0.02;

/// Entry for the edge over which an object must fall.
pub(super) const OFF_TABLE: Ask = Ask {
    keys: &[Key::optional(
        "off_table",
        Value::Either(&[
            Value::Word(&[ANY, "far", "near", "left", "right"]),
            Value::Map(&[
                Key::required(
                    "edge",
                    Value::Word(&["far", "near", "left", "right"]),
                    "The edge, seen from the robot.",
                ),
                Key::required(
                    "between",
                    numbers(&SHIFT_LIMIT, 2),
                    "Range along the edge in which the centre of mass must leave the table, [low, \
                     high] in metres: x for the left and the right edge, y for the others.",
                ),
            ]),
        ]),
        "Edge of the table over which the object must fall instead of coming to rest, seen from \
         the robot: `any`, `far` (+x), `near` (-x), `left` (+y) or `right` (-y). A map of `edge` \
         and `between` restricts it to a range of the edge. The object falls once its centre of \
         mass is beyond the edge; all other objects must stay unless they may fall. By default the \
         object must stay.",
    )],
    about: About::Pose,
    read: |goal, object, scene| Some(Demand::Fall(fall(goal.get("off_table")?, object, scene)?)),
    write: |demand, _, _| {
        let Demand::Fall(fall) = demand else { return None };
        Some(json!({"off_table": emitted(fall)}))
    },
    check,
};

/// Returns the fall in a goal of `object`.
fn fall(node: &Node, object: usize, scene: &Scene) -> Option<Box<Fall>> {
    let name = node.get("edge").unwrap_or(node).text()?;
    let over = Edge::ALL.into_iter().find(|edge| edge.name() == name);
    let fall = Fall::of(scene, object, over)?;
    match node.get("between") {
        Some(node) => Some(Box::new(fall.between(span(node)?))),
        None => Some(fall),
    }
}

fn span(node: &Node) -> Option<Span> {
    match node.items() {
        [low, high] => Some(Span::new(low.number()?, high.number()?)),
        _ => None,
    }
}

/// Returns the fall as in a file.
fn emitted(fall: &Fall) -> Json {
    let name = fall.over.map_or(ANY, Edge::name);
    match fall.between {
        Some(Span { low, high }) => json!({"edge": name, "between": [low, high]}),
        None => json!(name),
    }
}

/// Reports the faults of a fall.
fn check(asked: &Asked, ledger: &mut Ledger) {
    let Asked { goal, name, scene } = *asked;
    let Some(node) = goal.get("off_table") else { return };
    if let Some(between) = node.get("between") {
        check_part(between, node.get("edge").and_then(Node::text), scene, ledger);
    }
    if scene.get("table").and_then(|table| table.get("size")).is_none() {
        let advice = "add `table: {size: [x, y]}` to the scene";
        ledger.fault(node, "the table has no edges, so no object can fall off it", advice);
    }
    if let Some(other) = goal.get("relative_to") {
        let advice = "leave it out; the edges of the table are fixed in the world";
        ledger.fault(other, "`off_table` cannot be relative to an object", advice);
    }
    let section = |key| asked.section(key);
    let held = section("joints").iter().find(|joint| {
        let moving = moving(joint, section("objects"), section("obstacles"));
        moving.is_some_and(|moving| moving.text() == name.text())
    });
    if held.is_some() {
        let message = format!("`{}` is joined to the world", name.text().unwrap_or("?"));
        ledger.fault(node, message, "an object joined to the world cannot fall");
    }
}

/// Checks that a part of an edge lies on the table and that its limits are in order.
fn check_part(between: &Node, edge: Option<&str>, scene: &Node, ledger: &mut Ledger) {
    let Some(Span { low, high }) = span(between) else { return };
    if high - low < SHORTEST {
        let message = format!("the range from {low} to {high} is reversed or too short");
        let advice =
            format!("write the smaller value first, with at least {SHORTEST} m between them");
        ledger.fault(between, message, advice);
        return;
    }
    let Some(edge) = Edge::ALL.into_iter().find(|one| Some(one.name()) == edge) else { return };
    let Some(table) = scene.get("table") else { return };
    let Some(size) = table.get("size").and_then(vector) else { return };
    let middle = table.get("position").and_then(vector).unwrap_or_default();
    let [half, middle] = [0.5 * size, middle].map(|place| edge.along().dot(&place));
    if low > middle + half || high < middle - half {
        let (name, from, to) = (edge.name(), middle - half, middle + half);
        let message = format!("the {name} edge ranges only from {from:.3} to {to:.3}");
        ledger.fault(between, message, "give a range within it");
    }
}
