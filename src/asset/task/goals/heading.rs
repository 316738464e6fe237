//! Goals of a heading.

use serde_json::json;

use crate::asset::put::degrees;
use crate::asset::spec::{ANGLE, Key, Range, Value};
use crate::asset::take::angle;
use crate::task::{Demand, Facing};

use super::ask::{About, Ask};

/// Default tolerance of a heading, degrees.
pub(super) const HEADING_TOLERANCE: f64 = 10.0;

/// Entry for a heading in the world or in the frame of an object.
pub(super) const HEADING: Ask = Ask {
    keys: &[
        Key::optional("heading_deg", ANGLE, "Required heading, degrees; by default any."),
        Key::optional(
            "heading_tolerance_deg",
            Value::Number(Range {
                what: "a tolerance in degrees",
                low: 0.1,
                high: 180.0,
                advice: "5 to 15 degrees are usual",
            }),
            "Largest heading error that still counts as success, degrees; default 10.",
        ),
        Key::optional(
            "symmetric",
            Value::Switch,
            "Whether headings at which the object looks the same count alike: quarter turns of a \
             square, half turns of a rectangle, n-th turns of a regular prism; default true. Write \
             false if the sides differ, for example by a mark.",
        ),
    ],
    about: About::Turn,
    read: |goal, _, _| {
        let within = angle(goal, "heading_tolerance_deg", HEADING_TOLERANCE)?;
        Some(Demand::Heading(Facing::new(angle(goal, "heading_deg", 0.0)?, within)))
    },
    write: |demand, goal, scene| {
        let Demand::Heading(facing) = demand else { return None };
        let [heading, within] = [facing.heading, facing.tolerance].map(degrees);
        let mut json = json!({"heading_deg": heading, "heading_tolerance_deg": within});
        let usual = goal.clone().looking_alike(scene);
        if usual.heading().is_some_and(|usual| usual.symmetry != facing.symmetry) {
            json["symmetric"] = json!(false);
        }
        Some(json)
    },
    check: |_, _| {},
};
