//! Specification of a recording file.

use crate::asset::saved::{SCHEMA_VERSION, version};
use crate::asset::shapes::{CUBOID, CYLINDER};
use crate::asset::spec::{
    ANGLE, FRICTION, Key, MASS, MOST_BODIES, POSITION, Range, Value, numbers,
};
use crate::asset::task::{
    self, FRICTIONS, JOINTS, OBJECT_NAME, OBJECT_SHAPE, OBJECT_SUPPORT, OBSTACLES, PUSH_HEIGHT,
    TABLE,
};
use crate::asset::tool::TOOL_KEYS;

/// Defaults of optional keys; the descriptions of the keys below repeat them.
pub(super) mod default {
    /// Mass of an object, kg: a full mug.
    pub const MASS: f64 = 0.5;
}

/// Specification of a recording file.
pub(in crate::asset) static RECORDING: Value = Value::Map(RECORDING_KEYS);

/// Keys of a recording.
pub(in crate::asset) const RECORDING_KEYS: &[Key] = &[
    Key::required("schema_version", version(SCHEMA_VERSION), "Version of the format, 1."),
    Key::required("kind", Value::Word(&["recording"]), "Kind of the file."),
    Key::optional("name", Value::Name, "The recording's name; by default the file's."),
    Key::optional("description", Value::Text, "One line for people; by default empty."),
    Key::required("scene", SCENE, "The scene on the table."),
    Key::required("pusher", Value::Map(PUSHER_KEYS), "The body that pushes the objects."),
    Key::optional(
        "frame_time",
        TIME_STEP,
        "Time between two frames, seconds; no default, a recording has either this or `times`.",
    ),
    Key::optional(
        "times",
        Value::List { of: &TIME, items: "times", min: 2, max: MOST_FRAMES },
        "Time of each frame, seconds; no default, a recording has either this or `frame_time`.",
    ),
    Key::required(
        "frames",
        Value::List { of: &FRAME, items: "frames", min: 2, max: MOST_FRAMES },
        "Poses of all bodies, instant by instant; in the first frame every object rests unless it \
         states a `velocity`.",
    ),
];

const MOST_FRAMES: usize = 100_000;

const SCENE: Value = Value::Map(&[
    TABLE,
    PUSH_HEIGHT,
    Key::required(
        "objects",
        Value::List { of: &OBJECT, items: "objects", min: 1, max: MOST_BODIES },
        "The movable objects, in the order of the frames.",
    ),
    Key::optional(
        "joints",
        JOINTS,
        "Joints between objects, at their poses in the first frame; by default none.",
    ),
    OBSTACLES,
    FRICTIONS,
]);

const OBJECT: Value = Value::Map(&[
    OBJECT_NAME,
    OBJECT_SHAPE,
    OBJECT_SUPPORT,
    Key::optional("mass", MASS, "Mass in kg; default 0.5."),
    Key::optional("friction", FRICTION, "Friction value; default 0.4."),
    Key::optional(
        "position",
        POSITION,
        "Centre at the start, [x, y] in metres; by default the position in the first frame, which \
         any stated value must equal.",
    ),
    Key::optional(
        "yaw_deg",
        ANGLE,
        "Heading at the start, degrees, for objects whose frames hold positions only; default 0.",
    ),
    Key::optional(
        "velocity",
        VELOCITY,
        "Velocity of the centre in the first frame, [x, y] in m/s; default [0, 0].",
    ),
    Key::optional(
        "spin_deg",
        SPIN,
        "Angular velocity in the first frame, degrees per second, counter-clockwise; default 0.",
    ),
]);

const VELOCITY: Value = numbers(
    &Value::Number(Range {
        what: "a speed in m/s",
        low: -10.0,
        high: 10.0,
        advice: "speeds are in metres per second: 50 mm/s is 0.05",
    }),
    2,
);

const SPIN: Value = Value::Number(Range {
    what: "an angular velocity in degrees per second",
    low: -7200.0,
    high: 7200.0,
    advice: "one rotation per second is 360",
});

/// Keys of a pusher.
pub(super) const PUSHER_KEYS: &[Key] = &[
    Key::optional(
        "cylinder",
        CYLINDER,
        "An upright cylinder; no default, a pusher has either this, `cuboid` or `tool`.",
    ),
    Key::optional(
        "cuboid",
        CUBOID,
        "A cuboid; no default, a pusher has either this, `cylinder` or `tool`.",
    ),
    Key::optional(
        "tool",
        Value::Map(TOOL_KEYS),
        "A tool, as in a tool file; no default, a pusher has either this, `cylinder` or `cuboid`.",
    ),
    Key::optional("friction", FRICTION, "Friction value of a cylinder or cuboid; default 0.4."),
    Key::optional(
        "lift",
        task::LIFT,
        "Height of its underside above the table in metres; default 0.002.",
    ),
];

const TIME_STEP: Value = Value::Number(Range {
    what: "a time step in seconds",
    low: 1e-4,
    high: 10.0,
    advice: "thirty frames per second are 0.0333",
});

const TIME: Value = Value::Number(Range {
    what: "a time in seconds",
    low: -1e10,
    high: 1e10,
    advice: "times are in seconds; only their differences matter",
});

const FRAME: Value = Value::Map(&[
    Key::required("pusher", POSE, "Pose of the pusher, [x, y] or [x, y, yaw_deg]."),
    Key::optional(
        "objects",
        Value::List { of: &POSE, items: "poses, one per object", min: 1, max: MOST_BODIES },
        "Pose of each object, [x, y] or [x, y, yaw_deg], in the order of the scene; by default not \
         observed, which is allowed between the first and the last frame.",
    ),
    Key::optional(
        "lifted",
        Value::Switch,
        "Whether the pusher was lifted before this frame and set down here; default false.",
    ),
]);

/// Pose of a body. The range covers metres and degrees, because the third number is an angle;
/// `units.rs` checks the metres.
const POSE: Value = Value::List {
    of: &Value::Number(Range {
        what: "a finite number",
        low: -1e6,
        high: 1e6,
        advice: "leave out frames in which a body was not observed, and give `times`",
    }),
    items: "numbers, [x, y] or [x, y, yaw_deg]",
    min: 2,
    max: 3,
};
