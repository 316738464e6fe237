//! What a task of levering may hold.

use crate::asset::spec::{ANGLE, CUBOID, FRICTION, Key, MASS, POSITION, Range, SIZE, Value};
use crate::asset::task::{
    MAX_FORCE, OBJECT_NAME, OBSTACLES, PLACE, PUSHES, REACH_KEY, ROBUSTNESS, TOOLS, UNKNOWN_KEY,
};
use crate::geometry::MAX_CORNERS;

/// What a task of levering may hold.
pub(in crate::asset) static LEVER_TASK: Value = Value::Map(LEVER_TASK_KEYS);

/// What holds a blade.
const HAND: Key = Key::optional(
    "hand",
    Value::Word(&["none"]),
    "`none` where what holds the tool has no body; by default there are fingers behind the blade, which need \
     2 cm on both sides of the shaft, and the usual hand about a tool that pushes.",
);

/// The keys of a task of levering.
pub(in crate::asset) const LEVER_TASK_KEYS: &[Key] = &[
    Key::optional("name", Value::Name, "The task's name; by default the file's."),
    Key::optional("description", Value::Text, "One line for people; by default empty."),
    Key::required("scene", SCENE, "What lies on the table."),
    UNKNOWN_KEY,
    Key::required(
        "robot",
        Value::Map(&[REACH_KEY, MAX_FORCE, HAND]),
        "Where the end effector can be.",
    ),
    TOOLS,
    Key::optional(
        "levers",
        LEVERS,
        "The lever-ups a plan may contain; every key has a default. A task with this key is one of \
         levering, as is one whose goal speaks of `outside`, `raised` or `flipped`.",
    ),
    Key::optional(
        "pushes",
        PUSHES,
        "The pushes that may follow a lever-up, to bring the object to `goal.position`; every key has \
         a default. `tools` then names some that push as well. By default a plan is one lever-up.",
    ),
    Key::required("goal", GOAL, "What must come of it; everything that is stated."),
    ROBUSTNESS,
];

const SCENE: Value = Value::Map(&[
    Key::optional(
        "table",
        Value::Map(&[Key::optional(
            "friction",
            FRICTION,
            "Friction value of the table top; default 0.5.",
        )]),
        "The table; by default of friction 0.5.",
    ),
    Key::required(
        "objects",
        Value::List { of: &OBJECT, items: "objects", min: 1, max: 8 },
        "The plates: what can move.",
    ),
    OBSTACLES,
]);

const OBJECT: Value = Value::Map(&[
    OBJECT_NAME,
    Key::required("shape", SHAPE, "The plate itself, lying flat; the blade goes under its edge."),
    Key::optional(
        "parts",
        Value::List { of: &PART, items: "parts", min: 0, max: 16 },
        "What is fixed on the plate, such as chips, of the same density; by default nothing.",
    ),
    Key::required("mass", MASS, "Mass in kg, parts included."),
    Key::required(
        "friction",
        FRICTION,
        "Friction value; the coefficient of a pair is the mean of the two values.",
    ),
    Key::optional(
        "clearance",
        HEIGHT,
        "Free height below the underside at its edge, metres. A plate that lies no higher stands \
         on feet of this height at its corners; default `z`.",
    ),
    Key::optional(
        "z",
        HEIGHT,
        "Height of the underside above the table, metres; default `clearance`. A plate that lies \
         higher than its clearance needs obstacles below it.",
    ),
    Key::required("position", POSITION, "Centre of the plate at the start, [x, y] in metres."),
    Key::optional("yaw_deg", ANGLE, "Heading at the start, degrees; default 0."),
]);

/// A flat solid.
const SHAPE: Value = Value::Variant(&[
    Key::optional("cuboid", CUBOID, "A cuboid with its faces along its own axes; no default."),
    Key::optional("prism", PRISM, "An upright prism on a convex polygon; no default."),
]);

const PRISM: Value = Value::Map(&[
    Key::required(
        "corners",
        Value::List { of: &POSITION, items: "corners", min: 3, max: MAX_CORNERS },
        "Corners of the convex base in order, [x, y] in metres, from any origin along the axes of \
         the body's own frame.",
    ),
    Key::required("height", SIZE, "Height in metres."),
    Key::optional(
        "origin",
        POSITION,
        "The point whose place `position` tells, [x, y] in metres from the origin of the corners; \
         by default the centroid of the base.",
    ),
]);

const PART: Value = Value::Map(&[
    Key::required("shape", SHAPE, "The part's solid, standing upright."),
    Key::required(
        "position",
        PLACE,
        "Its centre from the origin of the plate's corners, or from the centre of a cuboid, metres; \
         a third number is the height of its underside above the plate's; without one it lies on \
         top.",
    ),
    Key::optional("yaw_deg", ANGLE, "Turn of the part on the plate, degrees; default 0."),
]);

const HEIGHT: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 1.0,
    advice: "6 mm is 0.006",
});

const LEVERS: Value = Value::Map(&[
    Key::optional(
        "depth",
        Value::List { of: &DEPTH, items: "depths", min: 2, max: 2 },
        "Smallest and largest depth of the blade's tip behind the edge, metres; default 0.008 and \
         0.020.",
    ),
    Key::optional(
        "angle_deg",
        Value::List { of: &TURN, items: "angles in degrees", min: 2, max: 2 },
        "Smallest and largest turn of the blade, degrees; default 30 and 150.",
    ),
    Key::optional(
        "pivot",
        Value::Either(&[
            PIVOT_WORD,
            PIVOT_NUMBER,
            Value::List {
                of: &Value::Either(&[PIVOT_WORD, PIVOT_NUMBER]),
                items: "pivots",
                min: 1,
                max: 8,
            },
        ]),
        "Where the axis lies that the blade turns about: its distance from the edge, inward, in \
         metres (below zero behind the edge, to pry), or `auto`, the line that the plate turns \
         about; default auto, 0.16 and -0.012.",
    ),
    Key::optional(
        "speed",
        Value::Number(Range {
            what: "a speed in m/s",
            low: 0.01,
            high: 1.0,
            advice: "10 cm/s is 0.10",
        }),
        "Speed of the blade's tip in m/s; default 0.10.",
    ),
    Key::optional(
        "hold",
        Value::Number(Range {
            what: "a time in seconds",
            low: 0.0,
            high: 10.0,
            advice: "a fifth of a second is 0.2",
        }),
        "How long the blade stands still at the end, seconds; default 0.2.",
    ),
    Key::optional(
        "retreat",
        Value::Number(Range {
            what: "a distance in metres",
            low: 0.02,
            high: 1.0,
            advice: "10 cm is 0.10",
        }),
        "How far the blade is drawn back along its shaft, and from how far it comes, metres; default \
         0.10.",
    ),
]);

const PIVOT_WORD: Value = Value::Word(&["auto"]);

const PIVOT_NUMBER: Value = Value::Number(Range {
    what: "a distance in metres",
    low: -0.2,
    high: 1.0,
    advice: "16 cm in front of the edge is 0.16, 12 mm behind it -0.012",
});

/// How far a blade goes under an edge.
const DEPTH: Value = Value::Number(Range {
    what: "a depth in metres",
    low: 0.002,
    high: 0.2,
    advice: "12 mm is 0.012",
});

const TURN: Value = Value::Number(Range {
    what: "a turn in degrees",
    low: 1.0,
    high: 150.0,
    advice: "plates turn over at about 90 degrees",
});

const GOAL: Value = Value::Map(&[
    Key::required("object", Value::Name, "Name of the object that is levered."),
    Key::optional(
        "outside",
        Value::Name,
        "Name of an obstacle, such as the floor of a tray: at rest the object's centre of mass \
         lies outside of it, seen from above; by default not asked for.",
    ),
    Key::optional(
        "raised",
        Value::Number(Range {
            what: "a height in metres",
            low: 0.001,
            high: 1.0,
            advice: "2 cm is 0.02",
        }),
        "At the end of the turn the edge lies on the blade, this much higher than at the start, \
         metres; by default not asked for.",
    ),
    Key::optional(
        "flipped",
        Value::Switch,
        "At rest the object lies upside down (true) or on its underside (false); by default not \
         asked for.",
    ),
    Key::optional(
        "position",
        POSITION,
        "Where its centre of mass is at rest, [x, y] in metres; by default anywhere.",
    ),
    Key::optional(
        "tolerance",
        Value::Number(Range {
            what: "a tolerance in metres",
            low: 0.001,
            high: 1.0,
            advice: "2 cm is 0.02",
        }),
        "Largest distance from that position that still counts as success, metres; no default, it \
         goes with `position`.",
    ),
]);
