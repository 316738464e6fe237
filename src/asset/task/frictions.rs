//! Pair frictions in a task file: parsing, and their consistency rules.

use crate::asset::diagnostic::did_you_mean;
use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::name_of;
use crate::scene::{Object, Obstacle, PairFriction, Surface};

/// Minimum friction with the table; below it, an object hardly stops.
const LEAST_ON_TABLE: f64 = 0.05;

/// Words for the contact partners that have no name of their own.
const TABLE: &str = "table";
const TOOL: &str = "tool";

/// Key of the pair frictions of a scene.
pub(in crate::asset) const FRICTIONS: Key = Key::optional(
    "frictions",
    Value::List { of: &FRICTION, items: "frictions", min: 0, max: 256 },
    "Friction coefficients of pairs for which it is not the mean of the two values; by default \
     none.",
);

const FRICTION: Value = Value::Map(&[
    Key::required(
        "between",
        Value::List { of: &Value::Name, items: "names", min: 2, max: 2 },
        "An object and the body that it touches: another object, an obstacle, `table`, or `tool` \
         for any tool or pusher.",
    ),
    Key::required(
        "coefficient",
        Value::Number(Range {
            what: "a coefficient of friction",
            low: 0.0,
            high: 2.0,
            advice: "steel on steel with oil is about 0.1, rubber on wood about 0.8",
        }),
        "Friction coefficient of the pair.",
    ),
]);

/// Returns the friction of a pair; `None` if a required value is missing or faulty.
pub(super) fn friction(
    node: &Node,
    objects: &[Object],
    obstacles: &[Obstacle],
) -> Option<PairFriction> {
    let object = |name: &str| objects.iter().position(|object| object.name == name);
    let names: Vec<&str> = node.get("between")?.items().iter().filter_map(Node::text).collect();
    let [first, second] = names[..] else { return None };
    let (object, with) = match object(first) {
        Some(index) => (index, second),
        None => (object(second)?, first),
    };
    let with = match with {
        TABLE => Surface::Table,
        TOOL => Surface::Tool,
        name => match objects.iter().position(|object| object.name == name) {
            Some(index) => Surface::Object(index),
            None => Surface::Obstacle(obstacles.iter().position(|body| body.name == name)?),
        },
    };
    Some(PairFriction { object, with, coefficient: node.get("coefficient")?.number()? })
}

/// Reports every fault of the pair frictions.
pub(super) fn check(frictions: &[Node], objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let mut known: Vec<[&str; 2]> = Vec::new();
    for node in frictions {
        let Some(between) = node.get("between") else { continue };
        let names: Vec<&str> = between.items().iter().filter_map(Node::text).collect();
        let [first, second] = names[..] else { continue };
        let is_object = |name: &str| objects.iter().any(|object| name_of(object) == Some(name));
        let bodies = || objects.iter().chain(obstacles).filter_map(name_of);
        let strange = between.items().iter().find(|node| {
            let name = node.text().unwrap_or_default();
            ![TABLE, TOOL].contains(&name) && !bodies().any(|known| known == name)
        });
        let reserved = [first, second]
            .into_iter()
            .find(|name| [TABLE, TOOL].contains(name) && bodies().any(|known| known == *name));
        if let Some(node) = strange {
            let name = node.text().unwrap_or_default();
            let advice = did_you_mean(name, bodies().chain([TABLE, TOOL]));
            ledger.fault(node, format!("no body is called `{name}`"), advice);
        } else if let Some(name) = reserved {
            let message =
                format!("`{name}` is the name of a body and also the reserved word for the {name}");
            ledger.fault(between, message, "give the body another name");
        } else if first == second {
            let advice = "name two different bodies";
            ledger.fault(between, "a friction coefficient of a body with itself", advice);
        } else if !is_object(first) && !is_object(second) {
            let message = "neither of the two bodies is an object";
            ledger.fault(between, message, "name an object; only objects are pushed");
        } else if known.contains(&[first, second]) || known.contains(&[second, first]) {
            let message = format!("the friction of `{first}` and `{second}` is given twice");
            ledger.fault(node, message, "keep one of the two");
        }
        known.push([first, second]);
        if let Some(value) = node.get("coefficient")
            && let Some(coefficient) = value.number()
            && ((is_object(first) && second == TABLE) || (is_object(second) && first == TABLE))
            && coefficient < LEAST_ON_TABLE
        {
            let message = format!("a coefficient of {coefficient} between an object and the table");
            let advice = format!(
                "give at least {LEAST_ON_TABLE}; with less friction no object comes to rest"
            );
            ledger.fault(value, message, advice);
        }
    }
}

/// Returns the name of the other body of a pair in a file.
pub(in crate::asset) fn name_of_surface(
    surface: Surface,
    objects: &[Object],
    obstacles: &[Obstacle],
) -> String {
    match surface {
        Surface::Object(index) => objects[index].name.clone(),
        Surface::Obstacle(index) => obstacles[index].name.clone(),
        Surface::Table => TABLE.into(),
        Surface::Tool => TOOL.into(),
    }
}
