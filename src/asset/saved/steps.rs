//! Keys of steps and of their results.

use crate::asset::spec::{Key, Range, Value, numbers};

use super::spec::{INDEX, POSE, POSITIVE, REAL, SHARE, UNSIGNED, VECTOR};

/// Specification of the steps of a plan.
pub(super) const STEPS: Value = Value::Map(&[Key::required(
    "steps",
    Value::List { of: &STEP, items: "steps", min: 0, max: 64 },
    "The steps in order; empty if the goal is already reached.",
)]);

const STEP: Value = Value::Variant(&[
    Key::optional("push", PUSH_STEP, "A push; no default."),
    Key::optional("lever_up", LEVER_STEP, "A lever-up; no default."),
]);

const PUSH_STEP: Value = Value::Map(&[
    Key::required("tool", Value::Name, "Name of the tool."),
    Key::required("grip_yaw", REAL, "Rotation of the end effector against world +x, radians."),
    Key::required("form", Value::Word(&["placed", "chained"]), "Start of the push."),
    Key::required("lift", UNSIGNED, "Height of the tool's underside above the table, metres."),
    Key::required("start", VECTOR, "End-effector position at the start, metres."),
    Key::required("direction", REAL, "Heading of the motion, radians from world +x."),
    Key::required("length", POSITIVE, "Travel, metres."),
    Key::required("speed", POSITIVE, "Speed, m/s."),
]);

const LEVER_STEP: Value = Value::Map(&[
    Key::required("tool", Value::Name, "Name of the tool."),
    Key::required("object", INDEX, "Index of the object to lever."),
    PLACE,
    DEPTH,
    PIVOT,
    ANGLE,
    SPEED,
    HOLD,
    RETREAT,
    Key::optional(
        "expected",
        POSE,
        "Expected pose of the object before the step; by default its pose in the task.",
    ),
]);

const PLACE: Key = Key::required(
    "place",
    Value::Map(&[
        Key::required("edge", INDEX, "The edge from this corner to the next."),
        Key::required("fraction", SHARE, "Position along the edge."),
    ]),
    "Place on the outline below which the blade enters.",
);
const DEPTH: Key = Key::required("depth", LEVER, "Distance of the tip behind the edge, metres.");
const PIVOT: Key =
    Key::required("pivot", REAL, "Distance of the axis from the edge, inward, metres.");
const ANGLE: Key = Key::required("angle", TURN, "Rotation of the blade, radians.");
const SPEED: Key = Key::required("speed", LEVER, "Speed of the tip, m/s.");
const HOLD: Key =
    Key::required("hold", UNSIGNED, "Time for which the blade then stands still, seconds.");
const RETREAT: Key =
    Key::required("retreat", UNSIGNED, "Distance by which the blade is then drawn back, metres.");

/// Large enough for any lever, small enough that no lever-up takes hours.
const LEVER: Value = Value::Number(Range {
    what: "a positive number",
    low: 1e-4,
    high: 10.0,
    advice: "lengths are in metres, speeds in m/s",
});

const TURN: Value = Value::Number(Range {
    what: "a rotation in radians",
    low: 0.0,
    high: 3.2,
    advice: "half a turn is 3.14",
});

pub(super) const POSE_IN_SPACE: Value = Value::Map(&[
    Key::required("position", numbers(&REAL, 3), "Metres."),
    Key::required("rotation", numbers(&REAL, 4), "A quaternion: x, y, z, w."),
]);

pub(super) const LIFT: Value = Value::Map(&[
    Key::required("object", INDEX, "Index of the levered object."),
    Key::required("raised", REAL, "Height gained by its edge at the end of the rotation, metres."),
    Key::required("held", Value::Switch, "Whether the object then lies on the blade."),
    Key::required("tilt", REAL, "Tilt of the object, radians."),
]);

pub(super) const SCORE: Value = Value::Number(Range {
    what: "a score",
    low: 0.0,
    high: f64::MAX,
    advice: "is the file damaged?",
});
