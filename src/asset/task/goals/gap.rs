//! Goals of the gap between two bodies: touching, side by side, or clear of each other.

use serde_json::{Value as Json, json};

use crate::asset::diagnostic::did_you_mean;
use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, number_or};
use crate::{
    scene::{Body, Scene},
    task::{Demand, Gap},
};

use super::ask::{About, Ask, Asked};

/// Minimum difference between the limits, metres, because even simulators differ by millimetres.
const PLAY: f64 = 0.001;

/// Entry for the distance between two bodies.
pub(super) const GAP: Ask = Ask {
    keys: &[Key::optional(
        "gap",
        Value::Map(&[
            Key::required("to", Value::Name, "The other object, or an obstacle."),
            Key::optional(
                "min",
                Value::Number(Range {
                    what: "a distance in metres",
                    low: 0.0,
                    high: 10.0,
                    advice: "10 cm apart is 0.10",
                }),
                "Smallest distance in metres; default 0.",
            ),
            Key::optional(
                "max",
                Value::Number(Range {
                    what: "a distance in metres",
                    low: PLAY,
                    high: 10.0,
                    advice: "touching is 0.002; simulators themselves differ by millimetres",
                }),
                "Largest distance in metres; by default any.",
            ),
        ]),
        "Required distance between the object and another body at their final poses: the smallest \
         distance of their outlines, seen from above, with all parts. By default any.",
    )],
    about: About::Place,
    read: |goal, object, scene| Some(Demand::Gap(gap(goal.get("gap")?, object, scene)?)),
    write: |demand, _, scene| {
        let Demand::Gap(gap) = demand else { return None };
        Some(json!({"gap": emitted(gap, scene)}))
    },
    check,
};

/// Returns the gap in a goal of `object`.
fn gap(node: &Node, object: usize, scene: &Scene) -> Option<Box<Gap>> {
    let name = node.get("to")?.text()?;
    let obstacle = || scene.obstacles.iter().position(|obstacle| obstacle.name == name);
    let to = scene.object(name).map(Body::Object).or_else(|| obstacle().map(Body::Obstacle))?;
    let limits = [number_or(node, "min", 0.0)?, number_or(node, "max", f64::INFINITY)?];
    Gap::between(scene, object, to, limits)
}

/// Returns the gap as in a file.
fn emitted(gap: &Gap, scene: &Scene) -> Json {
    let mut json = json!({"to": gap.name(scene)});
    if gap.min > 0.0 || gap.max.is_infinite() {
        json["min"] = json!(gap.min);
    }
    if gap.max.is_finite() {
        json["max"] = json!(gap.max);
    }
    json
}

/// Reports the faults of a gap.
fn check(asked: &Asked, ledger: &mut Ledger) {
    let Some(gap) = asked.goal.get("gap") else { return };
    let bodies = [asked.section("objects"), asked.section("obstacles")];
    let others = || bodies.iter().flat_map(|bodies| bodies.iter()).filter_map(name_of);
    if let Some((node, to)) = gap.get("to").and_then(|node| Some((node, node.text()?))) {
        if Some(to) == asked.name.text() {
            ledger.fault(
                node,
                "an object has no gap to itself",
                "name another object, or an obstacle",
            );
        } else if !others().any(|other| other == to) {
            let advice = did_you_mean(to, others());
            ledger.fault(node, format!("no object and no obstacle is called `{to}`"), advice);
        }
    }
    let limit = |key| gap.get(key).and_then(Node::number);
    match (gap.get("min"), gap.get("max")) {
        (None, None) => {
            let advice = "add `min: 0.10` for 10 cm apart, or `max: 0.002` for touching";
            ledger.fault(gap, "every gap would satisfy the goal", advice);
        }
        (Some(node), Some(_)) => {
            if let (Some(min), Some(max)) = (limit("min"), limit("max"))
                && max - min < PLAY
            {
                let message = format!("a gap cannot be at least {min} and at most {max} m");
                ledger.fault(node, message, "leave at least 0.001 m between `min` and `max`");
            }
        }
        _ => {}
    }
}
