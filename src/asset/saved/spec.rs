//! What plan and trajectory files may hold.

use crate::asset::spec::{Key, Range, Value, numbers};
use crate::asset::task::TASK_KEYS;
use crate::asset::tool::TOOL_KEYS;

/// Version of both formats; raised when a reader of this version could not read the new form.
pub const SCHEMA_VERSION: u32 = 1;

/// What a plan file may hold.
pub(in crate::asset) static PLAN_FILE: Value = Value::Map(&[
    Key::required("schema_version", VERSION, "Version of the format."),
    Key::required("kind", Value::Word(&["plan"]), "What the file is."),
    Key::required("task", Value::Map(TASK_KEYS), "The task, as in a task file."),
    Key::required("tool", Value::Map(TOOL_KEYS), "The tool, as in a tool file."),
    Key::required("plan", PLAN, "The pushes."),
    Key::optional("model", Value::Either(&[Value::Text, Value::Nothing]), MODEL),
    Key::optional(
        "predicted",
        Value::Either(&[OUTCOME, Value::Nothing]),
        "Where the model says the plan ends; by default unknown.",
    ),
    Key::optional(
        "verdict",
        Value::Either(&[VERDICT, Value::Nothing]),
        "Whether simulation confirms it; by default unknown.",
    ),
]);

/// What a trajectory file may hold.
pub(in crate::asset) static TRAJECTORY_FILE: Value = Value::Map(&[
    Key::required("schema_version", VERSION, "Version of the format."),
    Key::required("kind", Value::Word(&["trajectory"]), "What the file is."),
    Key::required("task", Value::Map(TASK_KEYS), "The task, as in a task file."),
    Key::required("tool", Value::Map(TOOL_KEYS), "The tool, as in a tool file."),
    Key::required("plan", PLAN, "The pushes."),
    Key::required("trajectory", TRAJECTORY, "What happened."),
]);

const MODEL: &str = "The effect model that predicted where the plan ends; by default unknown.";

pub(in crate::asset) const VERSION: Value = Value::Count(Range {
    what: "the schema version",
    low: SCHEMA_VERSION as f64,
    high: SCHEMA_VERSION as f64,
    advice: "the file is of another version of pushplan; make it again with this one",
});

/// Large enough for anything on a table, small enough to betray a blown-up simulation.
pub(super) const REAL: Value =
    Value::Number(Range { what: "a number", low: -1e6, high: 1e6, advice: "is the file damaged?" });

const POSITIVE: Value = Value::Number(Range {
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

const DRAW: Value = Value::Count(Range {
    what: "the number of a draw",
    low: 1.0,
    high: 1e6,
    advice: "is the file damaged?",
});

pub(super) const SHARE: Value =
    Value::Number(Range { what: "a share", low: 0.0, high: 1.0, advice: "half is 0.5" });

pub(super) const VECTOR: Value = numbers(&REAL, 2);

/// The pushes of a plan.
pub(super) const PLAN: Value = Value::Map(&[
    Key::required("tool", Value::Name, "Name of the tool."),
    Key::required("grip_yaw", REAL, "Turn of the end effector against world +x, radians."),
    Key::required("form", Value::Word(&["placed", "chained"]), "How the pushes start."),
    Key::required("lift", UNSIGNED, "Height of the tool's underside above the table, metres."),
    Key::required(
        "pushes",
        Value::List { of: &PUSH, items: "pushes", min: 0, max: 64 },
        "The pushes, in order; none if nothing is to be done.",
    ),
]);

const PUSH: Value = Value::Map(&[
    Key::required("start", VECTOR, "End-effector position at the start, metres."),
    Key::required("direction", REAL, "Heading of the motion, radians from world +x."),
    Key::required("length", POSITIVE, "Travel, metres."),
    Key::required("speed", POSITIVE, "Speed, m/s."),
]);

const POSE: Value = Value::Map(&[
    Key::required("position", VECTOR, "Position of the centre, metres."),
    Key::required("heading", REAL, "Turn about the vertical, radians."),
]);

const VELOCITY: Value = Value::Map(&[
    Key::required("linear", VECTOR, "Of the centre, m/s."),
    Key::required("angular", REAL, "About the vertical, rad/s."),
]);

const STATE: Value = Value::Map(&[
    Key::required(
        "poses",
        Value::List { of: &POSE, items: "poses", min: 1, max: 64 },
        "Poses of the objects, in the task's order.",
    ),
    Key::required(
        "velocities",
        Value::List { of: &VELOCITY, items: "velocities", min: 1, max: 64 },
        "Velocities of the objects, in the task's order.",
    ),
]);

const HEADING_ERROR: Value = Value::Either(&[UNSIGNED, Value::Nothing]);

const ENGINE: Value = Value::Word(&["planar", "spatial"]);

const OUTCOME: Value = Value::Map(&[
    Key::required("state", STATE, "Final poses of all objects."),
    Key::required("error", UNSIGNED, "Distance of the goal object from the goal, metres."),
    Key::optional(
        "heading_error",
        HEADING_ERROR,
        "Heading error, radians; by default none is asked for.",
    ),
    Key::required("reached", Value::Switch, "Whether the goal is reached at rest."),
]);

const WARNINGS: Value = Value::List { of: &Value::Anything, items: "warnings", min: 0, max: 1000 };

const VERDICT: Value = Value::Map(&[
    Key::required(
        "passed",
        Value::Switch,
        "Whether the plan breaks no rule and reaches the goal, as written and often enough disturbed.",
    ),
    Key::optional("reason", REASON, "Why not; by default unknown."),
    Key::optional("forbidden", WARNINGS, "What the task does not allow; by default nothing."),
    Key::required(
        "evidence",
        Value::List { of: &EVIDENCE, items: "replays", min: 0, max: 1000 },
        "All replays, nominal ones first.",
    ),
    Key::optional(
        "robustness",
        Value::Either(&[SHARE, Value::Nothing]),
        "Share of the disturbed replays that reach the goal; by default none was made.",
    ),
]);

const REASON: Value = Value::Variant(&[
    Key::optional(
        "forbidden",
        Value::Anything,
        "The plan does what its task does not allow; no default.",
    ),
    Key::optional(
        "goes_wrong",
        GOES_WRONG,
        "Something goes wrong when it is replayed as written; no default.",
    ),
    Key::optional("misses", MISSES, "The object misses the goal; no default."),
    Key::optional(
        "fragile",
        FRAGILE,
        "Too few of the disturbed replays reach the goal; no default.",
    ),
]);

const GOES_WRONG: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine says so."),
    Key::required("fault", Value::Anything, "What goes wrong."),
]);

const MISSES: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine says so."),
    Key::required("error", UNSIGNED, "Distance of the goal object from the goal, metres."),
    Key::optional(
        "heading_error",
        HEADING_ERROR,
        "Heading error, radians; by default none is asked for.",
    ),
]);

const FRAGILE: Value = Value::Map(&[
    Key::required("engine", ENGINE, "In which engine fewer reach it."),
    Key::required("reached", INDEX, "Disturbed replays that reach the goal."),
    Key::required("replays", INDEX, "Disturbed replays."),
    Key::required("wanted", SHARE, "Share that was asked for."),
]);

const DISTURBED: Key = Key::required(
    "disturbed",
    Value::Map(&[Key::required("draw", DRAW, "Number of the draw, from 1.")]),
    "Starts and frictions were, by little and at random.",
);

const EVIDENCE: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine replayed it."),
    Key::required(
        "disturbance",
        Value::Either(&[Value::Word(&["nominal"]), Value::Variant(&[DISTURBED])]),
        "What was changed: `nominal` for nothing.",
    ),
    Key::required("outcome", OUTCOME, "Where it ended."),
    Key::optional("warnings", WARNINGS, "What a reader should know; by default nothing."),
    Key::optional("force", FORCE, "How hard the tool pressed; by default unknown."),
]);

const TRAJECTORY: Value = Value::Map(&[
    Key::required("by", Value::Text, "The model or engine that computed it."),
    Key::required(
        "frames",
        Value::List { of: &FRAME, items: "frames", min: 1, max: 100_000 },
        "The recorded instants, in order of time.",
    ),
    Key::required(
        "contacts",
        Value::List { of: &CONTACT, items: "contacts", min: 0, max: 100_000 },
        "First contacts, in order of time.",
    ),
    Key::required("warnings", WARNINGS, "What a reader should know."),
    Key::optional("force", FORCE, "How hard the tool pressed; by default unknown."),
]);

const FORCE: Value = Value::Map(&[
    Key::required("peak", UNSIGNED, "Largest force in one time step, newtons."),
    Key::required("lasting", UNSIGNED, "Largest force that lasted three time steps, newtons."),
]);

const FRAME: Value = Value::Map(&[
    Key::required("time", UNSIGNED, "Since the start, seconds."),
    Key::required("stroke", INDEX, "Index of the push that this instant belongs to."),
    Key::required("tool", POSE, "Pose of the tool frame."),
    Key::required("state", STATE, "Every object."),
]);

const CONTACT: Value = Value::Map(&[
    Key::required("frame", INDEX, "Index of the frame that ends with the contact made."),
    Key::required("object", INDEX, "Index of the object that is touched."),
    Key::required(
        "with",
        Value::Variant(&[
            Key::optional("object", INDEX, "Index of an object; no default."),
            Key::optional("obstacle", INDEX, "Index of an obstacle; no default."),
            Key::optional(
                "part",
                INDEX,
                "Index of a piece of the tool's outline, in which flush parts are one; no default.",
            ),
        ]),
        "What it touches.",
    ),
]);
