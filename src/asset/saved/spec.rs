//! Specification of plan and trajectory files.

use crate::asset::node::Node;
use crate::asset::spec::{Key, MOST_BODIES, Range, Value, numbers};
use crate::asset::task::TASK_KEYS;
use crate::asset::tool::TOOL_FILE;

use super::steps::{LIFT, POSE_IN_SPACE, STEPS};
use super::verdict::{OUTCOME, VERDICT, WARNINGS};

/// Version of recordings and of the output of commands; raised when older readers would fail.
pub const SCHEMA_VERSION: u32 = 1;

/// Version of plan and trajectory files.
pub const PLAN_VERSION: u32 = 2;

/// Keys of a plan file.
pub(in crate::asset) static PLAN_FILE: Value = Value::Map(&[
    Key::required("schema_version", version(PLAN_VERSION), "Version of the format."),
    Key::required("kind", Value::Word(&["plan"]), "Kind of the file."),
    TASK,
    TOOLS,
    Key::required("plan", STEPS, "The steps."),
    Key::optional("model", Value::Either(&[Value::Text, Value::Nothing]), MODEL),
    Key::optional("fit", Value::Anything, FIT),
    PREDICTED,
    JUDGED,
    Key::optional(
        "joints",
        Value::Anything,
        "Joint trajectory with which the task's arm executes the plan: positions and velocities at \
         times; by default none.",
    ),
]);

/// Keys of a trajectory file.
pub(in crate::asset) static TRAJECTORY_FILE: Value = Value::Map(&[
    Key::required("schema_version", version(PLAN_VERSION), "Version of the format."),
    Key::required("kind", Value::Word(&["trajectory"]), "Kind of the file."),
    TASK,
    TOOLS,
    Key::required("plan", STEPS, "The steps."),
    Key::required("trajectory", TRAJECTORY, "The trajectory."),
]);

const TASK: Key = Key::required("task", Value::Map(TASK_KEYS), "The task, as in a task file.");

const TOOLS: Key = Key::required(
    "tools",
    Value::List { of: &OF_TOOL_FILE, items: "tools", min: 0, max: 64 },
    "The tools named by the steps, as in tool files.",
);

static OF_TOOL_FILE: Value = Value::Dependent { by: tool_of_file, of: &TOOLS_OF_FILES };
static TOOLS_OF_FILES: [&Value; 1] = [&TOOL_FILE];

fn tool_of_file(_: &Node) -> &'static Value {
    &TOOL_FILE
}

const PREDICTED: Key = Key::optional(
    "predicted",
    Value::Either(&[OUTCOME, Value::Nothing]),
    "Predicted end of the plan; by default unknown.",
);

const JUDGED: Key = Key::optional(
    "verdict",
    Value::Either(&[VERDICT, Value::Nothing]),
    "Result of the verification in simulation; by default unknown.",
);

const MODEL: &str = "The effect model that predicted the end of the plan; by default unknown.";

/// Returns the specification of a format version; any other version is refused.
pub(in crate::asset) const fn version(number: u32) -> Value {
    Value::Count(Range {
        what: "the schema version",
        low: number as f64,
        high: number as f64,
        advice: "the file is from another version of pushplan; create it again with this one",
    })
}

/// Large enough for anything on a table, small enough to reveal a diverged simulation.
pub(super) const REAL: Value =
    Value::Number(Range { what: "a number", low: -1e6, high: 1e6, advice: "is the file damaged?" });

pub(super) const POSITIVE: Value = Value::Number(Range {
    what: "a positive number",
    low: 1e-4,
    high: 100.0,
    advice: "lengths are in metres, speeds in m/s",
});

pub(super) const UNSIGNED: Value = Value::Number(Range {
    what: "a number from zero",
    low: 0.0,
    high: 1e6,
    advice: "is the file damaged?",
});

pub(super) const INDEX: Value =
    Value::Count(Range { what: "an index", low: 0.0, high: 1e6, advice: "is the file damaged?" });

pub(super) const DRAW: Value = Value::Count(Range {
    what: "the number of a perturbed replay",
    low: 1.0,
    high: 1e6,
    advice: "is the file damaged?",
});

pub(super) const SHARE: Value =
    Value::Number(Range { what: "a share", low: 0.0, high: 1.0, advice: "half is 0.5" });

pub(super) const VECTOR: Value = numbers(&REAL, 2);

pub(super) const POSE: Value = Value::Map(&[
    Key::required("position", VECTOR, "Position of the centre, metres."),
    Key::required("heading", REAL, "Rotation about the vertical, radians."),
]);

const VELOCITY: Value = Value::Map(&[
    Key::required("linear", VECTOR, "Velocity of the centre, m/s."),
    Key::required("angular", REAL, "Angular velocity about the vertical, rad/s."),
]);

pub(super) const STATE: Value = Value::Map(&[
    Key::required(
        "poses",
        Value::List { of: &POSE, items: "poses", min: 1, max: MOST_BODIES },
        "Poses of the objects, in the task's order.",
    ),
    Key::required(
        "velocities",
        Value::List { of: &VELOCITY, items: "velocities", min: 1, max: MOST_BODIES },
        "Velocities of the objects, in the task's order.",
    ),
    Key::optional(
        "space",
        Value::List { of: &POSE_IN_SPACE, items: "poses", min: 1, max: MOST_BODIES },
        "3-D poses, once an object has left the plane; by default none.",
    ),
]);

const TRAJECTORY: Value = Value::Map(&[
    Key::required("by", Value::Text, "The model or engine that computed it."),
    Key::required("frames", FRAMES, "The recorded instants, in order of time."),
    Key::required("contacts", CONTACTS, "First contacts, in order of time."),
    Key::required("warnings", WARNINGS, "Warnings and notes."),
    Key::optional("force", FORCE, "Contact force of the tool; by default unknown."),
    Key::optional("spreads", SPREADS, "Errors of the objects' final poses; by default unknown."),
    Key::optional(
        "lifts",
        Value::List { of: &LIFT, items: "lever-ups", min: 0, max: 64 },
        "Result of each lever-up; by default there is none.",
    ),
]);

const FIT: &str = "Table fit that the model used, see `fit --save-fit`; by default none.";

const FRAMES: Value = Value::List { of: &FRAME, items: "frames", min: 1, max: 100_000 };
const CONTACTS: Value = Value::List { of: &CONTACT, items: "contacts", min: 0, max: 100_000 };
const SPREADS: Value = Value::List { of: &SPREAD, items: "objects", min: 0, max: 100_000 };
const SPREAD: Value = Value::Map(&[
    Key::required("position", UNSIGNED, "Mean error, metres."),
    Key::required("heading", UNSIGNED, "Mean error, radians."),
]);

pub(super) const FORCE: Value = Value::Map(&[
    Key::required("peak", UNSIGNED, "Largest force in one time step, newtons."),
    Key::required("lasting", UNSIGNED, "Largest force that lasted three time steps, newtons."),
]);

const FRAME: Value = Value::Map(&[
    Key::required("time", UNSIGNED, "Since the start, seconds."),
    Key::required("stroke", INDEX, "Index of the push at this instant."),
    Key::required("tool", POSE, "Pose of the tool frame."),
    Key::required("state", STATE, "States of all objects."),
    Key::optional(
        "blade",
        POSE_IN_SPACE,
        "Position of the blade's middle during a lever-up; by default none.",
    ),
]);

const CONTACT: Value = Value::Map(&[
    Key::required("frame", INDEX, "Index of the frame at whose end the contact is made."),
    Key::required("object", INDEX, "Index of the touched object."),
    Key::required(
        "with",
        Value::Variant(&[
            Key::optional("object", INDEX, "Index of an object; no default."),
            Key::optional("obstacle", INDEX, "Index of an obstacle; no default."),
            Key::optional(
                "part",
                INDEX,
                "Index of the tool part that moves at that time, in the order of its file; no \
                 default.",
            ),
        ]),
        "The body that it touches.",
    ),
]);
