//! Coverage goals: share of the object's outline at a goal pose that the object must cover.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::put::degrees;
use crate::asset::spec::{ANGLE, Key, POSITION, Range, Value};
use crate::asset::take::{angle, number_or, position};
use crate::geometry::Pose;
use crate::{
    scene::Scene,
    task::{Coverage, Demand},
};

use super::ask::{About, Ask};

/// Default share, as in Push-T.
const SHARE: f64 = 0.95;

/// Entry for the covered share of the object's own outline, and the pose of that outline.
pub(super) const COVERAGE: Ask = Ask {
    keys: &[Key::optional(
        "coverage",
        Value::Map(&[
            Key::optional(
                "share",
                Value::Number(Range {
                    what: "a share",
                    low: 0.1,
                    high: 0.99,
                    advice: "0.95 is 95 %; simulators themselves differ by millimetres",
                }),
                "The smallest share of the outline's area; default 0.95.",
            ),
            Key::required(
                "position",
                POSITION,
                "Position of the target outline, [x, y] in metres.",
            ),
            Key::optional(
                "heading_deg",
                ANGLE,
                "Heading of the target outline, degrees; default 0.",
            ),
        ]),
        "Required coverage of a target outline by the object, seen from above, with all parts. The \
         target outline is the object's own outline at a given pose, as in Push-T. By default any.",
    )],
    about: About::Pose,
    read: |goal, object, scene| {
        Some(Demand::Coverage(covering(goal.get("coverage")?, object, scene)?))
    },
    write: |demand, _, _| {
        let Demand::Coverage(coverage) = demand else { return None };
        Some(json!({"coverage": emitted(coverage)}))
    },
    check: |_, _| {},
};

/// Returns the coverage in a goal of `object`.
fn covering(node: &Node, object: usize, scene: &Scene) -> Option<Box<Coverage>> {
    let share = number_or(node, "share", SHARE)?;
    let heading = angle(node, "heading_deg", 0.0)?;
    Coverage::of(scene, object, Pose { position: position(node)?, heading }, share)
}

/// Returns the coverage as in a file.
fn emitted(coverage: &Coverage) -> Json {
    let position = coverage.place.position;
    json!({
        "share": coverage.share,
        "position": [position.x, position.y],
        "heading_deg": degrees(coverage.heading()),
    })
}
