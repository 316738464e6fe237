//! Specification of the outcome and verdict of a plan in a file.

use crate::asset::spec::{Key, Value};

use super::spec::{DRAW, FORCE, INDEX, REAL, SHARE, STATE, UNSIGNED};
use super::steps::SCORE;

const HEADING_ERROR: Value = Value::Either(&[UNSIGNED, Value::Nothing]);

const ENGINE: Value = Value::Word(&["planar", "spatial"]);

const MISS: Value = Value::Map(&[
    Key::required("object", INDEX, "Index into the scene's objects."),
    Key::required("error", UNSIGNED, "Distance from its goal, metres."),
    Key::optional(
        "heading_error",
        HEADING_ERROR,
        "Heading error, radians; by default none is asked for.",
    ),
    Key::required("score", SCORE, "The demand that is met worst, at most 1 if it is met."),
    Key::optional(
        "raised",
        REAL,
        "Height by which a blade had lifted an edge at the end of its turn, metres; by default none did.",
    ),
]);

pub(super) const OUTCOME: Value = Value::Map(&[
    Key::required("state", STATE, "Final poses of all objects."),
    Key::required(
        "goals",
        Value::List { of: &MISS, items: "goals", min: 0, max: 64 },
        "Errors of the goals, in the order of the task.",
    ),
    Key::required("reached", Value::Switch, "Whether all goals are reached at rest."),
]);

pub(super) const WARNINGS: Value =
    Value::List { of: &Value::Anything, items: "warnings", min: 0, max: 1000 };

pub(super) const VERDICT: Value = Value::Map(&[
    Key::required(
        "passed",
        Value::Switch,
        "Whether the plan breaks no rule and reaches the goal, as written and often enough disturbed.",
    ),
    Key::optional("reason", REASON, "Why not; by default unknown."),
    Key::optional("forbidden", WARNINGS, "What the task does not allow; by default nothing."),
    Key::required(
        "evidence",
        Value::List { of: &EVIDENCE, items: "replays", min: 0, max: 200_002 },
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
    Key::optional("never_on", NEVER_ON, "On one support none of them does; no default."),
]);

const NEVER_ON: Value = Value::Map(&[
    Key::required("engine", ENGINE, "In which engine."),
    Key::required("support", Value::Anything, "What objects rest on then."),
    Key::required("replays", INDEX, "Disturbed replays on it."),
]);

const GOES_WRONG: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine says so."),
    Key::required("fault", Value::Anything, "What goes wrong."),
]);

const MISSES: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine says so."),
    Key::required("error", UNSIGNED, "Largest distance of an object from its goal, metres."),
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

const PERTURBED: Key = Key::required(
    "perturbed",
    Value::Map(&[Key::required("draw", DRAW, "Number of the draw, from 1.")]),
    "Starts and frictions were, by little and at random.",
);

const EVIDENCE: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Which engine replayed it."),
    Key::required(
        "perturbation",
        Value::Either(&[Value::Word(&["nominal"]), Value::Variant(&[PERTURBED])]),
        "What was changed: `nominal` for nothing.",
    ),
    Key::required("outcome", OUTCOME, "Where it ended."),
    Key::optional("warnings", WARNINGS, "What a reader should know; by default nothing."),
    Key::optional("force", FORCE, "How hard the tool pressed; by default unknown."),
]);
