//! What a file may hold: keys, kinds of values, ranges and their meaning.
//!
//! One description serves three readers: the strict check (`strict.rs`), the JSON schema for
//! editors (`schema.rs`) and people, who meet its words in both.

use super::node::Node;

/// A key of a map.
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

/// A kind of value.
#[derive(Clone, Copy)]
pub(super) enum Value {
    /// Anything; the type that it is read into decides what it must be.
    Anything,
    /// No value, where that has a meaning.
    Nothing,
    /// True or false.
    Switch,
    /// Free text.
    Text,
    /// A short word that messages and other keys can refer to.
    Name,
    /// One of these words.
    Word(&'static [&'static str]),
    /// Any number of the range.
    Number(Range),
    /// A whole number of the range.
    Count(Range),
    /// Between `min` and `max` items.
    List { of: &'static Value, items: &'static str, min: usize, max: usize },
    /// A map with these keys and no others.
    Map(&'static [Key]),
    /// A map with exactly one of these keys.
    Variant(&'static [Key]),
    /// The first that fits the kind of the value.
    Either(&'static [Value]),
    /// One of these: the beginning of the value tells which.
    Told { by: fn(&Node) -> &'static Value, of: &'static [&'static Value] },
}

/// Numbers from `low` to `high`, both included.
#[derive(Clone, Copy)]
pub(super) struct Range {
    /// What the number is, with its unit.
    pub what: &'static str,
    pub low: f64,
    pub high: f64,
    /// What to try when a number is outside.
    pub advice: &'static str,
}

/// A list of exactly `n` numbers.
pub(super) const fn numbers(of: &'static Value, n: usize) -> Value {
    Value::List { of, items: "numbers", min: n, max: n }
}

const METRES: &str = "lengths are in metres: 50 mm is 0.05";
const DEGREES: &str = "angles are in degrees: a quarter turn is 90";

/// An extent of a body: from a coin's thickness to a room.
pub(super) const SIZE: Value =
    Value::Number(Range { what: "a size in metres", low: 0.001, high: 10.0, advice: METRES });

/// A coordinate.
pub(super) const COORDINATE: Value =
    Value::Number(Range { what: "a coordinate in metres", low: -10.0, high: 10.0, advice: METRES });

/// A position on the table.
pub(super) const POSITION: Value = numbers(&COORDINATE, 2);

/// Full extents.
pub(super) const EXTENTS: Value = numbers(&SIZE, 3);

/// A turn or direction.
pub(super) const ANGLE: Value =
    Value::Number(Range { what: "an angle in degrees", low: -360.0, high: 360.0, advice: DEGREES });

/// The end of a joint's turns. Near half a turn left and right meet, and a simulator no longer
/// knows which limit is near.
pub(super) const ANGLE_LIMIT: Value = Value::Number(Range {
    what: "a limit in degrees",
    low: -340.0,
    high: 340.0,
    advice: "limits are in degrees from the start; leave them out where a joint turns freely",
});

/// The end of a joint's shifts.
pub(super) const SHIFT_LIMIT: Value =
    Value::Number(Range { what: "a limit in metres", low: -10.0, high: 10.0, advice: METRES });

/// A friction value. Below 0.05 a body would slide on for seconds after a push, and without
/// friction it never stops; no dry pair of materials is above 2.
pub(super) const FRICTION: Value = Value::Number(Range {
    what: "a friction value",
    low: 0.05,
    high: 2.0,
    advice: "wood on wood is about 0.4, rubber about 0.8; without friction nothing comes to rest",
});

/// A mass.
pub(super) const MASS: Value = Value::Number(Range {
    what: "a mass in kg",
    low: 0.001,
    high: 1000.0,
    advice: "masses are in kilograms: 250 g is 0.25",
});

/// A force.
pub(super) const FORCE: Value = Value::Number(Range {
    what: "a force in newtons",
    low: 0.1,
    high: 1e6,
    advice: "pushing 1 kg over wood takes about 5 N; small arms press with 50 to 150 N",
});

#[cfg(test)]
mod tests;
