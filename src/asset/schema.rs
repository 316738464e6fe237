//! JSON schemas (draft 2020-12) of user files, for editors.

use serde_json::{Map, Value as Json, json};

use super::spec::{Key, Value};
use super::strict::describe;
use super::text::LONGEST_NAME;

/// Description of tool files.
const TOOL_RULES: &str = "A rigid body of upright solids, held at its grip, that pushes; or a flat \
    `blade`, held at the end of its shaft, that levers. Lengths are in metres, angles in degrees. \
    Unknown keys are errors.";

/// Description of task files.
const TASK_RULES: &str = "A scene, a robot, the tools and pushes that it allows, and a goal. \
    Lengths are in metres, masses in kilograms, angles in degrees. The table is the plane z = 0; x \
    points forward from the robot, whose base is the origin. The friction coefficient of any pair, \
    object and table included, is the mean of the two friction values. Up to 12 objects may be \
    connected by joints, without loops. The goal is reached when all objects rest and the object's \
    centre is within the tolerance, and its heading too if the goal has one. Headings at which the \
    object looks the same count alike unless the goal states otherwise. The position of a body is \
    its centre; the position of a prism, whose corners are written from any origin, is its centre \
    of mass. The moment of inertia of a prism equals that of a uniform plate with its base, about \
    its centre of mass. A task with `levers`, or a goal with `outside`, `raised` or `flipped`, \
    allows lever-ups: its objects are flat and stand on feet or on obstacles. The blade enters \
    level below an edge, pointing inward, and rotates about a level axis, which raises the edge. \
    The end effector holds the other end of the blade's shaft and stays within the reach. Unknown \
    keys are errors.";

/// Description of world files.
const WORLD_RULES: &str = "The ground truth of properties that a task leaves unknown, for \
    `pushplan run`. Properties that are not given here are as in the task, and no planner reads \
    this file. Lengths are in metres, masses in kilograms, angles in degrees. Unknown keys are \
    errors.";

/// Returns the schema of tool files.
pub fn tool_schema() -> Json {
    let mut schema = document("pushplan tool", &super::tool::TOOL_FILE);
    schema["description"] = json!(TOOL_RULES);
    schema
}

/// Returns the schema of task files.
pub fn task_schema() -> Json {
    let mut schema = document("pushplan task", &super::task::TASK);
    schema["description"] = json!(TASK_RULES);
    schema
}

/// Returns the schema of plan files.
pub fn plan_schema() -> Json {
    document("pushplan plan", &super::saved::PLAN_FILE)
}

/// Returns the schema of trajectory files.
pub fn trajectory_schema() -> Json {
    document("pushplan trajectory", &super::saved::TRAJECTORY_FILE)
}

/// Returns the schema of recordings, with the description of the format.
pub fn recording_schema() -> Json {
    let mut schema = document("pushplan recording", &super::recording::RECORDING);
    schema["description"] = json!(super::RECORDING_FORMAT);
    schema
}

/// Returns the schema of world files.
pub fn world_schema() -> Json {
    let mut schema = document("pushplan world", &super::world::WORLD);
    schema["description"] = json!(WORLD_RULES);
    schema
}

/// Extends schema `one` so that it also accepts everything that `other` accepts.
fn merge(one: &mut Json, other: Json) {
    if *one == other {
        return;
    }
    let is_map = |schema: &Json| schema["properties"].is_object();
    let is_list = |schema: &Json| schema["items"].is_object();
    if is_map(one) && is_map(&other) {
        if let (Some(Json::Array(own)), Json::Array(required)) =
            (one.get_mut("required"), &other["required"])
        {
            own.retain(|key| required.contains(key));
        }
        let Json::Object(mut properties) = other else { return };
        let Some(Json::Object(more)) = properties.remove("properties") else { return };
        for (key, value) in more {
            match one["properties"].get_mut(&key) {
                Some(known) => merge(known, value),
                None => one["properties"][key] = value,
            }
        }
    } else if is_list(one) && is_list(&other) {
        let limit = |key: &str| [&one[key], &other[key]].map(|limit| limit.as_u64().unwrap_or(0));
        let ([a, b], [c, d]) = (limit("minItems"), limit("maxItems"));
        one["minItems"] = json!(a.min(b));
        one["maxItems"] = json!(c.max(d));
        merge(&mut one["items"], other["items"].clone());
    } else {
        // Only the descriptions differ, or the schemas are equivalent for an editor.
        let words = one["description"].take();
        let mut other = other;
        let more = other["description"].take();
        if *one != other {
            *one = json!({"anyOf": [one.clone(), other]});
        }
        one["description"] = if words.is_null() { more } else { words };
    }
}

fn document(title: &str, value: &Value) -> Json {
    let mut schema = schema(value);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!(title);
    schema
}

fn schema(value: &Value) -> Json {
    match value {
        Value::Anything => json!({}),
        Value::Nothing => json!({"type": "null"}),
        Value::Switch => json!({"type": "boolean"}),
        Value::Text => json!({"type": "string"}),
        Value::Name => {
            json!({
                "type": "string", "minLength": 1, "maxLength": LONGEST_NAME,
                "pattern": name_pattern(),
            })
        }
        Value::Word(words) => json!({"enum": words}),
        Value::Number(range) => json!({
            "type": "number", "minimum": range.low, "maximum": range.high,
            "description": describe(value),
        }),
        Value::Count(range) => json!({
            "type": "integer", "minimum": range.low, "maximum": range.high,
            "description": describe(value),
        }),
        Value::List { of, min, max, .. } => {
            json!({"type": "array", "items": schema(of), "minItems": min, "maxItems": max})
        }
        Value::Map(keys) => {
            let required: Vec<&str> =
                keys.iter().filter(|key| key.required).map(|key| key.name).collect();
            json!({
                "type": "object", "properties": properties(keys),
                "required": required, "additionalProperties": false,
            })
        }
        Value::Variant(keys) => json!({
            "type": "object", "properties": properties(keys),
            "minProperties": 1, "maxProperties": 1, "additionalProperties": false,
        }),
        Value::Dependent { of, .. } => {
            let mut all = of.iter().map(|value| schema(value));
            let first = all.next().unwrap_or_default();
            all.fold(first, |mut merged, other| {
                merge(&mut merged, other);
                merged
            })
        }
        Value::Either(values) => {
            json!({"anyOf": values.iter().map(schema).collect::<Vec<_>>()})
        }
    }
}

/// Ranges of characters excluded from names: every character of ASCII, Latin-1 and general
/// punctuation except letters, digits, `-` and `_`. Classes of letters such as `\p{L}` are unknown
/// to Python. JavaScript needs a flag for them that schemas cannot set. The pattern therefore lists
/// the excluded characters. It accepts some signs of other scripts, which the reader then refuses.
const NOT_IN_NAMES: [(char, char); 15] = [
    ('\0', ','),
    ('.', '/'),
    (':', '@'),
    ('[', '^'),
    ('`', '`'),
    ('{', '\u{a9}'),
    ('\u{ab}', '\u{b1}'),
    ('\u{b4}', '\u{b4}'),
    ('\u{b6}', '\u{b8}'),
    ('\u{bb}', '\u{bb}'),
    ('\u{bf}', '\u{bf}'),
    ('\u{d7}', '\u{d7}'),
    ('\u{f7}', '\u{f7}'),
    ('\u{2000}', '\u{206f}'),
    ('\u{3000}', '\u{3004}'),
];

/// Returns a pattern with equal meaning in Python's `re` and in ECMA-262 without flags.
fn name_pattern() -> String {
    let escaped = |c: char| format!("\\u{:04x}", u32::from(c));
    let ranges = NOT_IN_NAMES.map(|(from, to)| format!("{}-{}", escaped(from), escaped(to)));
    format!("^[^{}]+$", ranges.concat())
}

fn properties(keys: &[Key]) -> Json {
    let mut properties = Map::new();
    for key in keys {
        let mut schema = schema(&key.value);
        schema["description"] = json!(key.meaning);
        properties.insert(key.name.into(), schema);
    }
    Json::Object(properties)
}

#[cfg(test)]
mod tests;
