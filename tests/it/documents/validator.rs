//! Validator of the part of JSON Schema that our schemas use. An unknown keyword is a fault, so
//! that no rule is left unchecked. Patterns are left to the tests of the schemas of files.

use serde_json::Value as Json;

/// Keywords without an effect on validity, and patterns.
const WORDS: [&str; 5] = ["$schema", "title", "description", "default", "pattern"];

/// Returns all faults of a value, each with its path.
pub fn faults(schema: &Json, value: &Json) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, value, "$", &mut found);
    found
}

fn check(schema: &Json, value: &Json, path: &str, found: &mut Vec<String>) {
    let Some(rules) = schema.as_object() else { panic!("{path}: the schema is {schema}") };
    for (keyword, rule) in rules {
        let sound = match keyword.as_str() {
            "type" => is_of_type(rule.as_str().expect("a type"), value),
            "const" => rule == value,
            "enum" => rule.as_array().expect("words").contains(value),
            "minimum" => value.as_f64().is_none_or(|own| own >= number(rule)),
            "maximum" => value.as_f64().is_none_or(|own| own <= number(rule)),
            "minLength" => {
                value.as_str().is_none_or(|own| size(own.chars().count()) >= number(rule))
            }
            "maxLength" => {
                value.as_str().is_none_or(|own| size(own.chars().count()) <= number(rule))
            }
            "minItems" => value.as_array().is_none_or(|own| size(own.len()) >= number(rule)),
            "maxItems" => value.as_array().is_none_or(|own| size(own.len()) <= number(rule)),
            "minProperties" => value.as_object().is_none_or(|own| size(own.len()) >= number(rule)),
            "maxProperties" => value.as_object().is_none_or(|own| size(own.len()) <= number(rule)),
            "required" => value.as_object().is_none_or(|own| {
                let keys = rule.as_array().expect("keys");
                keys.iter().all(|key| own.contains_key(key.as_str().expect("a key")))
            }),
            "anyOf" => {
                let choices = rule.as_array().expect("schemas");
                let each: Vec<Vec<String>> = choices.iter().map(|one| faults(one, value)).collect();
                // The alternative with the fewest faults is the one that was meant.
                match each.into_iter().min_by_key(Vec::len).expect("an alternative") {
                    least if least.is_empty() => true,
                    least => {
                        found.extend(least.iter().map(|fault| format!("{path} any of: {fault}")));
                        true
                    }
                }
            }
            "items" => {
                for (k, item) in value.as_array().into_iter().flatten().enumerate() {
                    check(rule, item, &format!("{path}[{k}]"), found);
                }
                true
            }
            "properties" => {
                for (key, own) in rule.as_object().expect("properties") {
                    if let Some(item) = value.get(key) {
                        check(own, item, &format!("{path}.{key}"), found);
                    }
                }
                true
            }
            "additionalProperties" => {
                let known =
                    |key: &String| rules.get("properties").is_some_and(|p| p.get(key).is_some());
                let more = value.as_object().into_iter().flatten();
                for (key, item) in more.filter(|(key, _)| !known(key)) {
                    match rule {
                        Json::Bool(allowed) if !allowed => {
                            found.push(format!("{path}.{key} is unknown"))
                        }
                        Json::Bool(_) => {}
                        rule => check(rule, item, &format!("{path}.{key}"), found),
                    }
                }
                true
            }
            known => {
                assert!(WORDS.contains(&known), "{path}: the validator has no `{known}`");
                true
            }
        };
        if !sound {
            let text = value.to_string();
            let shown: String = text.chars().take(80).collect();
            found.push(format!("{path}: {shown} breaks {keyword} {rule}"));
        }
    }
}

fn is_of_type(kind: &str, value: &Json) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|own| own.fract() == 0.0),
        other => panic!("the validator has no type `{other}`"),
    }
}

fn number(rule: &Json) -> f64 {
    rule.as_f64().expect("a number")
}

fn size(count: usize) -> f64 {
    count as f64
}

#[test]
fn the_validator_finds_every_kind_of_fault() {
    let schema = serde_json::json!({
        "type": "object", "required": ["a"], "additionalProperties": false,
        "properties": {
            "a": {"type": "integer", "minimum": 0},
            "b": {"anyOf": [{"type": "null"}, {"type": "array", "items": {"enum": ["x"]}}]},
            "c": {"type": "object", "additionalProperties": {"type": "number"}, "maxProperties": 1},
        },
    });
    let count = |text: &str| faults(&schema, &serde_json::from_str(text).expect("JSON")).len();
    assert_eq!(count(r#"{"a": 1, "b": ["x"], "c": {"free": 0.5}}"#), 0);
    assert_eq!(count(r#"{"a": 1, "b": null}"#), 0);
    for wrong in [
        "[]",
        "{}",
        r#"{"a": -1}"#,
        r#"{"a": 0.5}"#,
        r#"{"a": 1, "d": 2}"#,
        r#"{"a": 1, "b": ["y"]}"#,
        r#"{"a": 1, "c": {"free": "text"}}"#,
        r#"{"a": 1, "c": {"one": 1, "two": 2}}"#,
    ] {
        assert_eq!(count(wrong), 1, "{wrong}");
    }
}
