//! Goals outside of an obstacle.

use serde_json::json;

use crate::asset::diagnostic::did_you_mean;
use crate::asset::node::Node;
use crate::asset::spec::{Key, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;
use crate::task::{Demand, Outside};

use super::ask::{About, Ask, Asked};

/// Entry for an obstacle that the object must leave.
pub(super) const OUTSIDE: Ask = Ask {
    keys: &[Key::optional(
        "outside",
        Value::Name,
        "Name of an obstacle, such as the floor of a tray, outside of which the object's centre of \
         mass must be at rest, seen from above; by default none.",
    )],
    about: About::Lifted,
    read: |goal, _, scene| {
        let name = goal.get("outside")?.text()?;
        let obstacle = scene.obstacles.iter().position(|obstacle| obstacle.name == name)?;
        Some(Demand::Outside(Outside::of(scene, obstacle)?))
    },
    write: |demand, _, _| {
        let Demand::Outside(outside) = demand else { return None };
        Some(json!({"outside": outside.name}))
    },
    check,
};

/// Reports an unknown obstacle.
fn check(asked: &Asked, ledger: &mut Ledger) {
    let Some((node, name)) = asked.goal.get("outside").and_then(|node| Some((node, node.text()?)))
    else {
        return;
    };
    let is_named = |body: &Node| name_of(body) == Some(name);
    let obstacles = asked.section("obstacles");
    if obstacles.iter().any(is_named) {
        return;
    }
    let message = match asked.section("objects").iter().any(is_named) {
        true => format!("`{name}` is not an obstacle"),
        false => format!("no obstacle is called `{name}`"),
    };
    ledger.fault(node, message, did_you_mean(name, obstacles.iter().filter_map(name_of)));
}
