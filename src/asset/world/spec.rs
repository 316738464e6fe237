//! Specification of a world file.

use crate::asset::spec::{ANGLE, FRICTION, Key, MASS, MOST_BODIES, POSITION, Range, Value};
use crate::asset::task::OBJECT_SUPPORT;

use super::joints::JOINTS;

/// Specification of a world file.
pub(in crate::asset) static WORLD: Value = Value::Map(WORLD_KEYS);

/// Keys of a world file.
pub(in crate::asset) const WORLD_KEYS: &[Key] = &[
    Key::optional(
        "joints",
        JOINTS,
        "Joints, as in a task, at the objects' poses in this file; by default the task's. Joints \
         between objects replace all of the task's, and a joint to the world the one of its \
         object.",
    ),
    Key::optional(
        "objects",
        Value::List { of: &OBJECT, items: "objects", min: 0, max: MOST_BODIES },
        "Objects of the task whose properties differ; by default none.",
    ),
    Key::optional(
        "table_friction",
        FRICTION,
        "Friction value of the table; by default the task's.",
    ),
    Key::optional(
        "engine",
        Value::Word(&["planar", "3d"]),
        "Engine of the world: `planar` or `3d`; default planar.",
    ),
    Key::optional("noise", NOISE, "Observation errors; by default 1 mm and 0.5 degrees."),
    Key::optional("headings", Value::Switch, "Whether headings are observed; default true."),
    Key::optional("seed", SEED, "Seed of the observation errors; default 0."),
];

const OBJECT: Value = Value::Map(&[
    Key::required("name", Value::Name, "Name of an object of the task."),
    Key::optional("mass", MASS, "Mass in kg; by default the task's."),
    Key::optional("friction", FRICTION, "Friction value; by default the task's."),
    Key {
        meaning: "Support model: how the weight rests on the table; by default the task's.",
        ..OBJECT_SUPPORT
    },
    Key::optional("position", POSITION, "Centre, [x, y] in metres; by default the task's."),
    Key::optional("yaw_deg", ANGLE, "Heading, degrees; by default the task's."),
]);

const NOISE: Value = Value::Map(&[
    Key::optional(
        "position",
        Value::Number(Range {
            what: "a standard deviation in metres",
            low: 0.0,
            high: 0.1,
            advice: "1 mm is 0.001",
        }),
        "Standard deviation of each coordinate, metres; default 0.001.",
    ),
    Key::optional(
        "heading_deg",
        Value::Number(Range {
            what: "a standard deviation in degrees",
            low: 0.0,
            high: 30.0,
            advice: "a good camera is within half a degree: 0.5",
        }),
        "Standard deviation of headings, degrees; default 0.5.",
    ),
]);

const SEED: Value = Value::Count(Range {
    what: "a seed",
    low: 0.0,
    high: 1e15,
    advice: "any whole number is valid",
});
