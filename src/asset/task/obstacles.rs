//! Obstacles: keys, parsing, writing and checks.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::put::degrees;
use crate::asset::spec::{ANGLE, COORDINATE, EXTENTS, FRICTION, Key, MOST_BODIES, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, number_or, pose, triple};
use crate::scene::{Obstacle, Scene};

/// Key of the obstacles of a scene.
pub(in crate::asset) const OBSTACLES: Key = Key::optional(
    "obstacles",
    Value::List { of: &OBSTACLE, items: "obstacles", min: 0, max: MOST_BODIES },
    "Fixed cuboids, such as walls, shelves, and the floor and standoffs of a tray; by default \
     none.",
);

const OBSTACLE: Value = Value::Map(&[
    Key::required("name", Value::Name, "The obstacle's name, unique in the scene."),
    Key::required("size", EXTENTS, "Full extents [x, y, z] in metres."),
    Key::required(
        "position",
        PLACE,
        "Centre, [x, y] in metres; a third number is the height of its underside above the table, \
         0 if omitted.",
    ),
    Key::optional("yaw_deg", ANGLE, "Heading, degrees; default 0."),
    Key::optional("friction", FRICTION, "Friction value; default 0.5."),
]);

/// Position seen from above, optionally with a height.
pub(super) const PLACE: Value = Value::List { of: &COORDINATE, items: "numbers", min: 2, max: 3 };

/// Returns the third number of a position; `usual` if it is missing.
pub(super) fn height(place: &Node, usual: f64) -> Option<f64> {
    place.items().get(2).map_or(Some(usual), Node::number)
}

/// Returns the obstacle; `None` if a required value is missing or faulty.
pub(in crate::asset) fn obstacle(node: &Node) -> Option<Obstacle> {
    Some(Obstacle {
        name: name_of(node)?.into(),
        size: triple(node, "size")?,
        pose: pose(node)?,
        z: height(node.get("position")?, 0.0)?,
        friction: number_or(node, "friction", Scene::FRICTION)?,
    })
}

/// Reports obstacles that begin below the table.
pub(in crate::asset) fn check(obstacles: &[Node], ledger: &mut Ledger) {
    for node in obstacles {
        if let Some(place) = node.get("position")
            && let Some(z) = height(place, 0.0).filter(|z| *z < 0.0)
        {
            let name = name_of(node).unwrap_or("?");
            let message = format!(
                "the underside of `{name}` is {z} m above the table, which is below the table"
            );
            let advice = "the third number is the height of the underside; leave it out if the \
                          obstacle stands on the table";
            ledger.fault(place, message, advice);
        }
    }
}

/// Returns the obstacle as in a task file.
pub(in crate::asset) fn emitted(obstacle: &Obstacle) -> Json {
    let Obstacle { name, size, pose, z, friction } = obstacle;
    let mut at = vec![pose.position.x, pose.position.y];
    at.extend((*z != 0.0).then_some(*z));
    let yaw = degrees(pose.heading);
    json!({"name": name, "size": size, "friction": friction, "position": at, "yaw_deg": yaw})
}
