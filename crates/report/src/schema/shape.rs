//! Builder of schemas: closed objects with described keys, and the leaves below them.

use serde_json::{Map, Value as Json, json};

use pushplan::asset::plan_schema;

/// Closed object with its keys.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape {
    properties: Map<String, Json>,
    required: Vec<&'static str>,
}

impl Shape {
    /// Creates an object without keys.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a key that is always present; `meaning` states its unit.
    pub fn key(mut self, name: &'static str, meaning: &str, value: impl Into<Json>) -> Self {
        self.required.push(name);
        self.maybe(name, meaning, value)
    }

    /// Adds a key that may be absent; `meaning` states its unit.
    pub fn maybe(mut self, name: &'static str, meaning: &str, value: impl Into<Json>) -> Self {
        let mut value = value.into();
        value["description"] = json!(meaning);
        self.properties.insert(name.to_owned(), value);
        self
    }

    /// Returns the schema of a list of such objects.
    pub fn list(self) -> Json {
        list(self)
    }
}

impl From<Shape> for Json {
    fn from(Shape { properties, required }: Shape) -> Json {
        json!({
            "type": "object", "properties": properties, "required": required,
            "additionalProperties": false,
        })
    }
}

/// Returns the schema of a number.
pub(super) fn number() -> Json {
    json!({"type": "number"})
}

/// Returns the schema of a number from 0, such as a distance.
pub(super) fn unsigned() -> Json {
    json!({"type": "number", "minimum": 0})
}

/// Returns the schema of a share from 0 to 1.
pub(super) fn share() -> Json {
    json!({"type": "number", "minimum": 0, "maximum": 1})
}

/// Returns the schema of an integer from 0: a count or an index.
pub(super) fn count() -> Json {
    json!({"type": "integer", "minimum": 0})
}

/// Returns the schema of a text.
pub(super) fn text() -> Json {
    json!({"type": "string"})
}

/// Returns the schema of a truth value.
pub(super) fn flag() -> Json {
    json!({"type": "boolean"})
}

/// Returns the schema of one of these words.
pub(super) fn words(words: &[&str]) -> Json {
    json!({"enum": words})
}

/// Returns the schema of a list.
pub(super) fn list(of: impl Into<Json>) -> Json {
    json!({"type": "array", "items": of.into()})
}

/// Returns the schema of a list of exactly `length` items.
pub(super) fn row(of: impl Into<Json>, length: usize) -> Json {
    json!({"type": "array", "items": of.into(), "minItems": length, "maxItems": length})
}

/// Returns the schema of a value that may be null.
pub(super) fn nullable(of: impl Into<Json>) -> Json {
    json!({"anyOf": [of.into(), {"type": "null"}]})
}

/// Returns the schema of an object whose keys are free and whose values are alike.
pub(super) fn map(of: impl Into<Json>) -> Json {
    json!({"type": "object", "additionalProperties": of.into()})
}

/// Returns the schema of a value that has a word, or an object with the word as its only key.
pub(super) fn variant() -> Json {
    let object = json!({"type": "object", "minProperties": 1, "maxProperties": 1});
    json!({"anyOf": [{"type": "string"}, object]})
}

/// Returns the schema of warnings.
pub(super) fn warnings() -> Json {
    list(variant())
}

/// Returns the schema of a range of values.
pub(super) fn span() -> Shape {
    Shape::new().key("low", "Lower end.", number()).key("high", "Upper end.", number())
}

/// Returns the schema of a key of plan files.
pub(super) fn of_plan_file(key: &str) -> Json {
    plan_schema()["properties"][key].clone()
}

/// Returns the schema of an outcome, as in plan files.
pub(super) fn outcome() -> Json {
    of_plan_file("predicted")["anyOf"][0].clone()
}

/// Returns the schema of a state, as in plan files.
pub(super) fn state() -> Json {
    outcome()["properties"]["state"].clone()
}

/// Returns the schema of a plan, as in plan files.
pub(super) fn plan() -> Json {
    of_plan_file("plan")
}

/// Adds the files that a command has written, unless the document has its own list of files.
pub(super) fn files(shape: Shape) -> Shape {
    match shape.properties.contains_key("files") {
        true => shape,
        false => shape.maybe("files", "Paths of the written files.", list(text())),
    }
}
