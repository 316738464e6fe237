//! Support model: distribution of an object's weight over its underside.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::put;
use crate::asset::shapes::origin;
use crate::asset::spec::{Key, POSITION, Range, Value};
use crate::asset::take::vector;
use crate::scene::Support;

/// Key of an object's support.
pub(in crate::asset) const OBJECT_SUPPORT: Key = Key::optional(
    "support",
    SUPPORT,
    "Support model: how the weight rests on the table; default `even`.",
);

/// Specification of the distribution of an object's weight over its underside.
const SUPPORT: Value = Value::Either(&[
    Value::Word(&["even", "corners"]),
    Value::Variant(&[
        Key::optional(
            "spread",
            Value::Number(Range {
                what: "a share",
                low: 0.1,
                high: 1.0,
                advice: "1 is the corners, or the rim; even pressure is like 0.5 to 0.7",
            }),
            "Radius of the support relative to the corners' distance or the radius; no default.",
        ),
        Key::optional(
            "points",
            Value::List { of: &POSITION, items: "points", min: 3, max: 8 },
            "Support points, [x, y] in metres in the object's frame, or in the frame of a prism's \
             corners; no default.",
        ),
    ]),
]);

/// Reads the support of an object or of a part.
pub(in crate::asset) fn support(object: &Node) -> Option<Support> {
    let Some(node) = object.get("support") else { return Some(Support::Even) };
    if let Some(word) = node.text() {
        return Some(if word == "corners" { Support::Corners } else { Support::Even });
    }
    if let Some(spread) = node.get("spread") {
        return spread.number().map(Support::Spread);
    }
    let origin = origin(object.get("shape")?)?;
    let points = node.get("points")?.items().iter().map(|point| Some(vector(point)? - origin));
    points.collect::<Option<_>>().map(Support::Points)
}

/// Returns a support as in a task file.
pub(in crate::asset) fn emitted(support: &Support) -> Json {
    match support {
        Support::Even => json!("even"),
        Support::Corners => json!("corners"),
        Support::Spread(share) => json!({"spread": share}),
        Support::Points(points) => {
            json!({"points": points.iter().map(|point| put::vector(*point)).collect::<Vec<_>>()})
        }
    }
}
