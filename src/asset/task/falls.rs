//! Goals off the table: what is to fall over one of its edges.

use crate::asset::node::Node;
use crate::asset::spec::{Key, Value};
use crate::asset::strict::Ledger;
use crate::scene::{Edge, Fall, Scene};

use super::mounts::moving;

/// Over any edge.
const ANY: &str = "any";

/// Over which edge an object is to fall.
pub(super) const OFF_TABLE: Key = Key::optional(
    "off_table",
    Value::Word(&[ANY, "far", "near", "left", "right"]),
    "Over which edge of the table it is to fall instead of coming to rest, as the robot sees it: `any`, \
     `far` (+x), `near` (-x), `left` (+y) or `right` (-y). It falls once its centre of mass is beyond the \
     edge; everything else stays, unless it may fall. By default it is to stay.",
);

/// The fall of a goal of `object`.
pub(super) fn fall(node: &Node, object: usize, scene: &Scene) -> Option<Box<Fall>> {
    let name = node.text()?;
    let over = Edge::ALL.into_iter().find(|edge| edge.name() == name);
    Fall::of(scene, object, over)
}

/// As in a file.
pub(in crate::asset) fn emitted_fall(fall: &Fall) -> &'static str {
    fall.over.map_or(ANY, Edge::name)
}

/// Notes what is wrong with the fall of a goal's object, which `name` names.
pub(super) fn check_fall(goal: &Node, name: &Node, scene: &Node, ledger: &mut Ledger) {
    let Some(node) = goal.get("off_table") else { return };
    if scene.get("table").and_then(|table| table.get("size")).is_none() {
        let advice = "add `table: {size: [x, y]}` to the scene";
        ledger.fault(node, "the table ends nowhere, so nothing falls off it", advice);
    }
    if let Some(other) = goal.get("relative_to") {
        let advice = "leave it out: the table is where it is";
        ledger.fault(other, "`off_table` is relative to nothing", advice);
    }
    let section = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let held = section("joints").iter().find(|joint| {
        let moving = moving(joint, section("objects"), section("obstacles"));
        moving.is_some_and(|moving| moving.text() == name.text())
    });
    if held.is_some() {
        let message = format!("`{}` is joined to the world", name.text().unwrap_or("?"));
        ledger.fault(node, message, "what a joint holds does not fall");
    }
}
