//! Specification of the outcome and verdict of a plan in a file.

use crate::asset::spec::{Key, MOST_BODIES, Value};

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
        "Heading error, radians; by default the goal has no heading.",
    ),
    Key::required(
        "score",
        SCORE,
        "Largest error of all criteria, in units of their tolerances; at most 1 if all are met.",
    ),
    Key::optional(
        "raised",
        REAL,
        "Height by which the blade had lifted the edge at the end of its rotation, metres; by \
         default there was no lever-up.",
    ),
]);

pub(super) const OUTCOME: Value = Value::Map(&[
    Key::required("state", STATE, "Final poses of all objects."),
    Key::required(
        "goals",
        Value::List { of: &MISS, items: "goals", min: 0, max: MOST_BODIES },
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
        "Whether the plan breaks no rule, and reaches the goal in the nominal replays and in \
         enough of the perturbed ones.",
    ),
    Key::optional("reason", REASON, "Reason for the rejection; by default none."),
    Key::optional(
        "forbidden",
        WARNINGS,
        "Rules of the task that the plan breaks; by default none.",
    ),
    Key::required(
        "evidence",
        Value::List { of: &EVIDENCE, items: "replays", min: 0, max: 200_002 },
        "All replays, nominal ones first.",
    ),
    Key::optional(
        "robustness",
        Value::Either(&[SHARE, Value::Nothing]),
        "Share of the perturbed replays that reach the goal; by default there was no perturbed \
         replay.",
    ),
]);

const REASON: Value = Value::Variant(&[
    Key::optional("forbidden", Value::Anything, "The plan breaks a rule of its task; no default."),
    Key::optional("goes_wrong", GOES_WRONG, "The nominal replay fails; no default."),
    Key::optional("misses", MISSES, "The object misses the goal; no default."),
    Key::optional(
        "fragile",
        FRAGILE,
        "Too few of the perturbed replays reach the goal; no default.",
    ),
    Key::optional(
        "never_on",
        NEVER_ON,
        "With one support model no perturbed replay reaches the goal; no default.",
    ),
]);

const NEVER_ON: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Engine of the replays."),
    Key::required("support", Value::Anything, "Support model of the objects in these replays."),
    Key::required("replays", INDEX, "Number of perturbed replays with it."),
]);

const GOES_WRONG: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Engine of the replay."),
    Key::required("fault", Value::Anything, "The failure."),
]);

const MISSES: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Engine of the replay."),
    Key::required("error", UNSIGNED, "Largest distance of an object from its goal, metres."),
    Key::optional(
        "heading_error",
        HEADING_ERROR,
        "Heading error, radians; by default the goal has no heading.",
    ),
]);

const FRAGILE: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Engine in which fewer replays reach the goal."),
    Key::required("reached", INDEX, "Number of perturbed replays that reach the goal."),
    Key::required("replays", INDEX, "Number of perturbed replays."),
    Key::required("wanted", SHARE, "Required share."),
]);

const PERTURBED: Key = Key::required(
    "perturbed",
    Value::Map(&[Key::required("draw", DRAW, "Number of the perturbed replay, from 1.")]),
    "Small random changes of starts and frictions.",
);

const EVIDENCE: Value = Value::Map(&[
    Key::required("engine", ENGINE, "Engine of the replay."),
    Key::required(
        "perturbation",
        Value::Either(&[Value::Word(&["nominal"]), Value::Variant(&[PERTURBED])]),
        "Perturbation: `nominal` for none.",
    ),
    Key::required("outcome", OUTCOME, "Final state."),
    Key::optional("warnings", WARNINGS, "Warnings and notes; by default none."),
    Key::optional("force", FORCE, "Contact force of the tool; by default unknown."),
]);
