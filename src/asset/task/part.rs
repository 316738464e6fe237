//! Additional solids of an object: keys, pose and share of the mass.

use crate::asset::node::Node;
use crate::asset::shapes::{PLACED_SHAPE, placed};
use crate::asset::spec::{ANGLE, FRICTION, Key, MASS, Range, Value};
use crate::asset::take::name_of;
use crate::geometry::Pose;
use crate::scene::Object;

use super::obstacles::{PLACE, height};
use super::support::OBJECT_SUPPORT;

/// Key of an object's additional solids.
pub(super) const PARTS: Key = Key::optional(
    "parts",
    Value::List { of: &PART, items: "parts", min: 0, max: 64 },
    "Further solids that are rigidly attached, like the handle of a mug; by default none.",
);

/// Height of a part above its object's underside, metres; limited like the heights of solids.
const RISE: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 10.0,
    advice: "heights are in metres, measured up from the underside of the object: 60 mm is 0.06",
});

const PART: Value = Value::Map(&[
    Key::optional(
        "name",
        Value::Name,
        "Name in messages, after the object's name and a slash; by default its number.",
    ),
    Key::required("shape", PLACED_SHAPE, "The part's solid, which stands upright."),
    Key::required(
        "position",
        PLACE,
        "Its centre in the object's frame, [x, y] in metres; [0, 0] is the object's position. A \
         third number is `z`. On an object with `clearance` or `z`, positions are from the origin \
         of its corners.",
    ),
    Key::optional("yaw_deg", ANGLE, "Rotation in the object's frame, degrees; default 0."),
    Key::optional(
        "z",
        RISE,
        "Height of its underside above the object's, metres; default 0, or on top of an object \
         with `clearance` or `z`. A part above 0 carries no weight, and lower bodies can pass \
         below it.",
    ),
    Key::optional(
        "mass",
        MASS,
        "Mass of the part, kg; by default a share, by volume, of the mass that the other parts \
         leave.",
    ),
    Key::optional("friction", FRICTION, "Friction value; by default the object's."),
    OBJECT_SUPPORT,
]);

/// Returns the parts of an object in a file.
pub(super) fn parts(object: &Node) -> &[Node] {
    object.get("parts").map(Node::items).unwrap_or_default()
}

/// Returns the name of part `number` of an object in messages.
pub(super) fn part_name(object: &str, part: &Node, number: usize) -> String {
    match name_of(part) {
        Some(name) => format!("{object}/{name}"),
        None => format!("{object}/{}", number + 1),
    }
}

/// Returns the pose of a part in its object's frame.
pub(super) fn place(part: &Node) -> Option<Pose> {
    placed(part)
}

/// Returns the height of a part's underside above its object's, metres; `usual` if none is stated.
pub(super) fn rise(part: &Node, usual: f64) -> Option<f64> {
    match part.get("z") {
        Some(z) => z.number(),
        None => height(part.get("position")?, usual),
    }
}

/// Returns the mass of every solid, kg: the stated mass, or a volume-proportional share of the
/// remainder.
pub(in crate::asset) fn shares(left: f64, solids: &[Object], stated: &[Option<f64>]) -> Vec<f64> {
    let volume = |solid: &Object| solid.shape.footprint().area() * solid.shape.height();
    let open = || solids.iter().zip(stated).filter(|(_, stated)| stated.is_none());
    let all: f64 = open().map(|(solid, _)| volume(solid)).sum();
    let share = |(solid, stated): (&Object, &Option<f64>)| {
        stated.unwrap_or_else(|| left * (volume(solid) / all))
    };
    solids.iter().zip(stated).map(share).collect()
}
