//! Goals of the side that faces up.

use serde_json::json;

use crate::asset::spec::{Key, Value};
use crate::task::{Demand, Flipped};

use super::ask::{About, Ask};

/// Entry for the side on which the object rests.
pub(super) const FLIPPED: Ask = Ask {
    keys: &[Key::optional(
        "flipped",
        Value::Switch,
        "Whether the object must lie upside down (true) or on its underside (false) at rest; by \
         default either.",
    )],
    about: About::Lifted,
    read: |goal, _, _| Some(Demand::Flipped(Flipped { flipped: goal.get("flipped")?.switch()? })),
    write: |demand, _, _| {
        let Demand::Flipped(own) = demand else { return None };
        Some(json!({"flipped": own.flipped}))
    },
    check: |_, _| {},
};
