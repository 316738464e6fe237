//! JSON schemas (draft 2020-12) of the user's files, for editors.

use serde_json::{Map, Value as Json, json};

use super::spec::{Key, Value};
use super::strict::describe;

/// The schema of tool files.
pub fn tool_schema() -> Json {
    document("pushplan tool", &super::tool::TOOL)
}

/// The schema of task files.
pub fn task_schema() -> Json {
    document("pushplan task", &super::task::TASK)
}

/// The schema of plan files.
pub fn plan_schema() -> Json {
    document("pushplan plan", &super::saved::PLAN_FILE)
}

/// The schema of trajectory files.
pub fn trajectory_schema() -> Json {
    document("pushplan trajectory", &super::saved::TRAJECTORY_FILE)
}

/// The schema of recordings, with the format in words.
pub fn recording_schema() -> Json {
    let mut schema = document("pushplan recording", &super::recording::RECORDING);
    schema["description"] = json!(super::RECORDING_FORMAT);
    schema
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
            json!({"type": "string", "minLength": 1, "maxLength": 64, "pattern": "^[\\p{L}\\p{N}_-]+$"})
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
        Value::Either(values) => {
            json!({"anyOf": values.iter().map(schema).collect::<Vec<_>>()})
        }
    }
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
mod tests {
    use super::*;

    #[test]
    fn schemas_describe_every_key() {
        let saved = [plan_schema(), trajectory_schema(), recording_schema()];
        for schema in [tool_schema(), task_schema()].into_iter().chain(saved) {
            let properties = schema["properties"].as_object().unwrap();
            assert!(!properties.is_empty());
            assert!(properties.values().all(|p| p["description"].is_string()));
            assert_eq!(schema["additionalProperties"], json!(false));
        }
        assert_eq!(
            task_schema()["properties"]["scene"]["properties"]["objects"]["items"]["properties"]["mass"]
                ["minimum"],
            json!(0.001)
        );
    }
}
