//! Specification of files: keys, kinds of values, ranges and descriptions.
//!
//! A single specification serves the strict check (`strict.rs`), the JSON schema for editors
//! (`schema.rs`) and human readers, who see its descriptions in both.

use super::node::Node;

/// Key of a map.
#[derive(Clone, Copy)]
pub(super) struct Key {
    pub name: &'static str,
    pub required: bool,
    pub value: Value,
    /// Meaning, unit and default.
    pub meaning: &'static str,
}

impl Key {
    pub const fn required(name: &'static str, value: Value, meaning: &'static str) -> Self {
        Self { name, required: true, value, meaning }
    }

    pub const fn optional(name: &'static str, value: Value, meaning: &'static str) -> Self {
        Self { name, required: false, value, meaning }
    }
}

/// Kind of a value.
#[derive(Clone, Copy)]
pub(super) enum Value {
    /// Any value; the target type checks it.
    Anything,
    /// Null, for keys where null has a meaning.
    Nothing,
    /// Boolean.
    Switch,
    /// Free text.
    Text,
    /// Short word that messages and other keys can refer to.
    Name,
    /// Word from a list.
    Word(&'static [&'static str]),
    /// Number in a range.
    Number(Range),
    /// Integer in a range.
    Count(Range),
    /// List of `min` to `max` items.
    List { of: &'static Value, items: &'static str, min: usize, max: usize },
    /// Map with these keys and no others.
    Map(&'static [Key]),
    /// Map with exactly one of these keys.
    Variant(&'static [Key]),
    /// First alternative whose kind matches the value.
    Either(&'static [Value]),
    /// Alternative selected by the beginning of the value.
    Dependent { by: fn(&Node) -> &'static Value, of: &'static [&'static Value] },
}

/// Interval from `low` to `high`, both included.
#[derive(Clone, Copy)]
pub(super) struct Range {
    /// Name of the quantity, with its unit.
    pub what: &'static str,
    pub low: f64,
    pub high: f64,
    /// Suggested fix for a number outside the range.
    pub advice: &'static str,
}

/// Returns a list of exactly `n` numbers.
pub(super) const fn numbers(of: &'static Value, n: usize) -> Value {
    Value::List { of, items: "numbers", min: n, max: n }
}

const METRES: &str = "lengths are in metres: 50 mm is 0.05";
const DEGREES: &str = "angles are in degrees: a quarter turn is 90";

/// Maximum number of objects, of obstacles or of joints in a file.
pub(super) const MOST_BODIES: usize = 200;

/// Extent of a body, from the thickness of a coin to a room.
pub(super) const SIZE: Value =
    Value::Number(Range { what: "a size in metres", low: 0.001, high: 10.0, advice: METRES });

/// Coordinate.
pub(super) const COORDINATE: Value =
    Value::Number(Range { what: "a coordinate in metres", low: -10.0, high: 10.0, advice: METRES });

/// Position on the table.
pub(super) const POSITION: Value = numbers(&COORDINATE, 2);

/// Full extents.
pub(super) const EXTENTS: Value = numbers(&SIZE, 3);

/// Rotation or direction.
pub(super) const ANGLE: Value =
    Value::Number(Range { what: "an angle in degrees", low: -360.0, high: 360.0, advice: DEGREES });

/// Limit of a revolute joint. Near half a turn, left and right coincide, and a simulator can no
/// longer distinguish the two limits.
pub(super) const ANGLE_LIMIT: Value = Value::Number(Range {
    what: "a limit in degrees",
    low: -340.0,
    high: 340.0,
    advice: "limits are in degrees from the start; leave them out if the joint rotates freely",
});

/// Limit of a prismatic joint.
pub(super) const SHIFT_LIMIT: Value =
    Value::Number(Range { what: "a limit in metres", low: -10.0, high: 10.0, advice: METRES });

/// Friction value. Below 0.05 a body would slide for seconds after a push, and without friction it
/// never stops. No dry pair of materials is above 2.
pub(super) const FRICTION: Value = Value::Number(Range {
    what: "a friction value",
    low: 0.05,
    high: 2.0,
    advice: "wood on wood is about 0.4, rubber about 0.8; without friction no object comes to rest",
});

/// Mass.
pub(super) const MASS: Value = Value::Number(Range {
    what: "a mass in kg",
    low: 0.001,
    high: 1000.0,
    advice: "masses are in kilograms: 250 g is 0.25",
});

/// Force.
pub(super) const FORCE: Value = Value::Number(Range {
    what: "a force in newtons",
    low: 0.1,
    high: 1e6,
    advice: "pushing 1 kg over wood takes about 5 N; small arms exert 50 to 150 N",
});

#[cfg(test)]
mod tests;
