//! Goals of a raised edge.

use serde_json::json;

use crate::asset::spec::{Key, Range, Value};
use crate::task::{Demand, Raised};

use super::ask::{About, Ask};

/// Entry for the height to which an edge is lifted.
pub(super) const RAISED: Ask = Ask {
    keys: &[Key::optional(
        "raised",
        Value::Number(Range {
            what: "a height in metres",
            low: 0.001,
            high: 1.0,
            advice: "2 cm is 0.02",
        }),
        "Height by which the edge must lie higher than at the start, on the blade at the end of a \
         lever-up, metres; by default any.",
    )],
    about: About::Lifted,
    read: |goal, _, _| Some(Demand::Raised(Raised { height: goal.get("raised")?.number()? })),
    write: |demand, _, _| {
        let Demand::Raised(raised) = demand else { return None };
        Some(json!({"raised": raised.height}))
    },
    check: |_, _| {},
};
