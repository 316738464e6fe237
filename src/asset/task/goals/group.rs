//! Goals of a group of objects.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::scene::Scene;
use crate::task::Goal;
use crate::task::demand::Group;

/// Minimum number of objects that must reach the goal.
pub(super) const AT_LEAST: Key = Key::optional(
    "at_least",
    Value::Count(Range {
        what: "a number of objects",
        low: 1.0,
        high: 16.0,
        advice: "2 of 3 objects are `at_least: 2`",
    }),
    "Number of the `objects` that must reach the goal; the planner chooses which. By default all.",
);

/// Returns the goals of the objects of one entry, or one group goal if `at_least` is given.
pub(super) fn grouped(goal: &Node, members: Vec<Goal>) -> Option<Vec<Goal>> {
    match goal.get("at_least") {
        Some(node) => Some(vec![Group::of(members, node.number()? as usize)?]),
        None => Some(members),
    }
}

/// Returns a group as in a file; `entry` writes the goal of one member.
pub(super) fn emitted(
    group: &Group,
    scene: &Scene,
    entry: impl Fn(&Goal) -> Vec<Json>,
) -> Option<Json> {
    let mut keys = entry(group.members.first()?).into_iter().next()?.as_object()?.clone();
    keys.remove("object");
    let names = group.members.iter().map(|member| json!(scene.objects[member.object].name));
    keys.insert("objects".to_owned(), names.collect());
    keys.insert("at_least".to_owned(), json!(group.at_least));
    Some(Json::Object(keys))
}

/// Reports `at_least` without objects, or above their number.
pub(super) fn check(goal: &Node, ledger: &mut Ledger) {
    let Some(node) = goal.get("at_least") else { return };
    let Some(names) = goal.get("objects").map(Node::items) else {
        ledger.fault(node, "`at_least` without `objects`", "name `objects`, or remove it");
        return;
    };
    if node.number().is_some_and(|count| count > names.len() as f64) {
        let message = format!("only {} objects are named", names.len());
        ledger.fault(node, message, "reduce `at_least`, or name more objects");
    }
    for key in ["joint", "joint_deg", "gap"] {
        if let Some(other) = goal.get(key) {
            let message = format!("`{key}` cannot be combined with `at_least`");
            ledger.fault(
                other,
                message,
                "it relates one object to another body; remove one of the two keys",
            );
        }
    }
}
