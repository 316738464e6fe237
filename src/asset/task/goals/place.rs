//! Goals of a position.

use serde_json::json;

use crate::asset::spec::{Key, POSITION as POINT, Range, Value};
use crate::asset::take::position;
use crate::task::{AtPlace, Demand};

use super::ask::{About, Ask};

/// Entry for a position of the centre.
pub(super) const POSITION: Ask = Ask {
    keys: &[
        Key::optional(
            "position",
            POINT,
            "Required position of its centre, [x, y] in metres; by default any.",
        ),
        Key::optional(
            "tolerance",
            Value::Number(Range {
                what: "a tolerance in metres",
                low: 0.001,
                high: 1.0,
                advice: "2 cm is 0.02; simulators themselves differ by millimetres",
            }),
            "Largest distance from the position that still counts as success, metres; no default.",
        ),
    ],
    about: About::Place,
    read: |goal, _, _| {
        let (position, tolerance) = (position(goal)?, goal.get("tolerance")?.number()?);
        Some(Demand::Place(AtPlace { position, tolerance, relative: None }))
    },
    write: |demand, _, _| {
        let Demand::Place(AtPlace { position, tolerance, .. }) = demand else { return None };
        Some(json!({"position": [position.x, position.y], "tolerance": tolerance}))
    },
    check: |_, _| {},
};
