//! What plan and trajectory files of levering may hold.

use crate::asset::lever::{BLADE_TOOL_KEYS, LEVER_TASK_KEYS};
use crate::asset::spec::{Key, Range, Value, numbers};
use crate::asset::tool::TOOL_KEYS;

use super::spec::{INDEX, PLAN as PUSHES, REAL, SHARE, UNSIGNED, VECTOR, VERSION};

/// What a plan file of levering may hold.
pub(in crate::asset) static LEVER_PLAN_FILE: Value = Value::Map(&[
    Key::required("schema_version", VERSION, "Version of the format."),
    Key::required("kind", Value::Word(&["lever_plan"]), "What the file is."),
    TASK,
    TOOL,
    Key::required("plan", PLAN, "The lever-up."),
    Key::optional(
        "follow_up",
        Value::Either(&[FOLLOW_UP, Value::Nothing]),
        "The pushes that follow it; by default none.",
    ),
    Key::optional(
        "model",
        Value::Either(&[Value::Text, Value::Nothing]),
        "Name of the model that predicted what comes of it; by default unknown.",
    ),
    Key::optional(
        "predicted",
        Value::Either(&[OUTCOME, Value::Nothing]),
        "What the model says comes of it; by default unknown.",
    ),
    Key::optional(
        "verdict",
        Value::Either(&[VERDICT, Value::Nothing]),
        "Whether simulation confirms it; by default unknown.",
    ),
]);

/// What a trajectory file of levering may hold.
pub(in crate::asset) static LEVER_TRAJECTORY_FILE: Value = Value::Map(&[
    Key::required("schema_version", VERSION, "Version of the format."),
    Key::required("kind", Value::Word(&["lever_trajectory"]), "What the file is."),
    TASK,
    TOOL,
    Key::required("plan", PLAN, "The lever-up."),
    Key::required("trajectory", TRAJECTORY, "How the levered object moved."),
    Key::required("motion", MOTION, "Everything that moved, over time."),
]);

const TASK: Key =
    Key::required("task", Value::Map(LEVER_TASK_KEYS), "The task, as in a task file.");

const TOOL: Key = Key::required("tool", Value::Map(BLADE_TOOL_KEYS), "The tool, as in its file.");

const PLAN: Value = Value::Map(&[
    Key::required("tool", Value::Name, "Name of the tool."),
    Key::required("lever", LEVER, "The lever-up."),
]);

const FOLLOW_UP: Value = Value::Map(&[
    Key::required("tool", Value::Map(TOOL_KEYS), "The tool that pushes, as in its file."),
    Key::required("plan", PUSHES, "The pushes."),
]);

const LEVER: Value = Value::Map(&[
    Key::required("plate", INDEX, "Index of the object that is levered."),
    Key::required(
        "place",
        Value::Map(&[
            Key::required("edge", INDEX, "The edge from this corner to the next."),
            Key::required("fraction", SHARE, "How far along it."),
        ]),
        "Where the blade goes under its outline.",
    ),
    Key::required("depth", POSITIVE, "How far the tip lies behind the edge, metres."),
    Key::required("pivot", REAL, "Distance of the axis from the edge, inward, metres."),
    Key::required("angle", ANGLE, "Turn of the blade, radians."),
    Key::required("speed", POSITIVE, "Speed of the tip, m/s."),
    Key::required("hold", UNSIGNED, "How long the blade then stands still, seconds."),
    Key::required("retreat", UNSIGNED, "How far it is then drawn back, metres."),
]);

/// Large enough for any lever, small enough that none takes hours.
const POSITIVE: Value = Value::Number(Range {
    what: "a positive number",
    low: 1e-4,
    high: 10.0,
    advice: "lengths are in metres, speeds in m/s",
});

const ANGLE: Value = Value::Number(Range {
    what: "a turn in radians",
    low: 0.0,
    high: 3.2,
    advice: "half a turn is 3.14",
});

const OUTCOME: Value = Value::Map(&[
    Key::required("reached", Value::Switch, "Whether the goal is reached."),
    Key::required("score", SCORE, "The demand that is met worst, at most 1 if it is met."),
    Key::required("raised", REAL, "How much higher the edge lies at the end, metres."),
    Key::required("ending", ENDING, "How the object lies at rest."),
    Key::required("rest", VECTOR, "Its centre of mass at rest, metres."),
    Key::required("warnings", WARNINGS, "What went wrong on the way."),
]);

const SCORE: Value = Value::Number(Range {
    what: "a score",
    low: 0.0,
    high: f64::MAX,
    advice: "is the file damaged?",
});

const ENDING: Value = Value::Word(&["back", "flipped", "leaning"]);

const WARNINGS: Value = Value::List {
    of: &Value::Word(&["slipped", "jammed", "moving", "set_down"]),
    items: "warnings",
    min: 0,
    max: 8,
};

const VERDICT: Value = Value::Map(&[
    Key::required("passed", Value::Switch, "Whether it works."),
    Key::optional("reason", Value::Anything, "Why not; by default it does."),
    Key::optional(
        "forbidden",
        Value::List { of: &Value::Anything, items: "rules", min: 0, max: 64 },
        "What it does that it must not; by default nothing.",
    ),
    Key::required(
        "evidence",
        Value::List {
            of: &Value::Map(&[
                Key::required("disturbance", Value::Anything, "What was changed."),
                Key::required("outcome", OUTCOME, "What came of it."),
            ]),
            items: "replays",
            min: 0,
            max: 100_001,
        },
        "All replays, the nominal one first.",
    ),
    Key::required(
        "robustness",
        Value::Either(&[SHARE, Value::Nothing]),
        "Share of the disturbed replays that reach the goal.",
    ),
]);

const POSE: Value = Value::Map(&[
    Key::required("position", numbers(&REAL, 3), "Metres."),
    Key::required("rotation", numbers(&REAL, 4), "A quaternion: x, y, z, w."),
]);

const TRAJECTORY: Value = Value::Map(&[
    Key::required("lift", POSES, "Its pose during the turn, at even times."),
    Key::required(
        "held",
        Value::List { of: &Value::Switch, items: "switches", min: 1, max: 100 },
        "Whether it lay on the blade then.",
    ),
    Key::required("rest", POSE, "Its pose when everything rests."),
    Key::required("ending", ENDING, "How it lies then."),
    Key::required("warnings", WARNINGS, "What went wrong on the way."),
]);

const POSES: Value = Value::List { of: &POSE, items: "poses", min: 1, max: 100 };

const MOTION: Value = Value::Map(&[Key::required(
    "frames",
    Value::List {
        of: &Value::Map(&[
            Key::required("time", REAL, "Since the turn began, seconds."),
            Key::required("blade", POSE, "The blade's centre."),
            Key::required("plates", POSES, "The objects, in the task's order."),
            Key::required("force", UNSIGNED, "Force on the blade, newtons."),
        ]),
        items: "frames",
        min: 0,
        max: 100_000,
    },
    "In order.",
)]);
