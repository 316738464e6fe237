//! Compound objects, of several solids: a mug with its handle, a T, a tray with its rim.
//!
//! A file describes a compound object as one object with `parts`. A scene has one object per solid,
//! see [`crate::scene::Whole`].

use crate::asset::node::{Content, Node};
use crate::asset::shapes::{self, placed, shape};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, number_or, pose};
use crate::scene::{Object, Whole, bearings, hanging};

use super::object;
use super::part::{part_name, parts, place, rise, shares};
use super::plates::{self, is_plate};
use super::support::support;

/// Returns the objects, followed by all their parts; `None` if a required value is missing or
/// faulty.
pub(super) fn objects(nodes: &[Node]) -> Option<Vec<Object>> {
    let (mut things, mut parts) = (Vec::new(), Vec::new());
    for node in nodes {
        let index = things.len();
        let own = object::object(node)?;
        let mut solids = match is_plate(node) {
            true => plates::solids(node, own, index)?,
            false => solids(node, own, index)?,
        }
        .into_iter();
        things.extend(solids.next());
        parts.extend(solids);
    }
    things.append(&mut parts);
    Some(things)
}

/// Returns the solids of the object with index `index` in the scene, the object itself first.
fn solids(node: &Node, object: Object, index: usize) -> Option<Vec<Object>> {
    let parts = parts(node);
    if parts.is_empty() {
        return Some(vec![object]);
    }
    let part = |(k, part): (usize, &Node)| {
        let place = place(part)?;
        Some(Object {
            friction: number_or(part, "friction", object.friction)?,
            pose: object.pose * place,
            support: support(part)?,
            may_fall: object.may_fall,
            z: rise(part, 0.0)?,
            whole: Some(Whole { object: index, place }),
            ..Object::new(part_name(&object.name, part, k), shape(part.get("shape")?)?)
        })
    };
    let mut solids = vec![object.clone()];
    for found in parts.iter().enumerate().map(part) {
        solids.push(found?);
    }
    let stated: Vec<Option<f64>> = std::iter::once(None)
        .chain(parts.iter().map(|part| part.get("mass").and_then(Node::number)))
        .collect();
    let left = object.mass - stated.iter().flatten().sum::<f64>();
    let masses = shares(left, &solids, &stated);
    solids.iter_mut().zip(masses).for_each(|(solid, mass)| solid.mass = mass);
    Some(solids)
}

/// Reports the faults of an object's parts.
pub(super) fn check(object: &Node, ledger: &mut Ledger) {
    let parts = parts(object);
    let mut names = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        shapes::check(part.get("shape"), ledger);
        let name = part_name("", part, k);
        if names.contains(&name) {
            let message = format!("two parts are called `{}`", &name[1..]);
            ledger.fault(part.get("name").unwrap_or(part), message, "rename one of them");
        }
        names.push(name);
        if let (Some(z), Some(_)) =
            (part.get("z"), part.get("position").and_then(|at| at.items().get(2)))
        {
            ledger.fault(
                z,
                "the height of this part is given twice",
                "keep `z`, or the third number",
            );
        }
    }
    if !is_plate(object) {
        above(object, ledger);
    }
    let stated = parts.iter().filter_map(|part| part.get("mass").and_then(Node::number));
    let (stated, whole) = (stated.sum::<f64>(), object.get("mass"));
    if let (Some(node), Some(mass)) = (whole, whole.and_then(Node::number))
        && stated >= mass
    {
        ledger.fault(
            node,
            format!(
                "the parts alone have {stated} kg, so no mass is left for the object's own solid"
            ),
            "`mass` is the total mass, including parts",
        );
    }
}

/// Reports parts above the table that are unsupported or tip the object over.
fn above(object: &Node, ledger: &mut Ledger) {
    let parts = parts(object);
    let Some(solids) = object::object(object).and_then(|own| solids(object, own, 0)) else {
        return;
    };
    if !solids.iter().any(Object::is_raised) {
        return;
    }
    let hanging = hanging(&solids);
    for (k, part) in parts.iter().enumerate() {
        let solid = &solids[k + 1];
        if hanging.contains(&(k + 1)) {
            let message = format!(
                "`{}` hangs in the air: it touches no other solid of its object",
                solid.name
            );
            let advice = "move it until it touches another part, seen from above and from the side";
            ledger.fault(part.get("z").unwrap_or(part), message, advice);
        }
        if let Some(support) = part.get("support").filter(|_| solid.is_raised()) {
            let message =
                format!("`{}` is above the table and has no support below it", solid.name);
            ledger.fault(support, message, "leave `support` out, or `z`");
        }
    }
    if bearings(&solids.iter().collect::<Vec<_>>()).is_none() {
        ledger.fault(
            object.get("parts").unwrap_or(object),
            "the object would topple: its centre of mass is not above its support",
            "solids above the table carry no weight; make them lighter, or add solids that stand \
             on the table",
        );
    }
}

/// Returns every solid as an object with its pose in the scene, paired with the index of the object
/// it belongs to. The rules about overlaps use this list.
pub(super) fn apart(objects: &[Node]) -> Vec<(Node, usize)> {
    let mut all = Vec::new();
    for (k, object) in objects.iter().enumerate() {
        all.push((object.clone(), k));
        let Some(at) = placed(object) else { continue };
        let name = name_of(object).unwrap_or("?");
        for (number, part) in parts(object).iter().enumerate() {
            // The position keeps its reference point; the consumer of the pose computes the centre
            // from it.
            let (Some(named), Some(shape)) = (pose(part), part.get("shape")) else { continue };
            let pose = at * named;
            let node = |content| Node { id: part.id, content };
            let text = |text: &str| node(Content::Text(text.to_owned()));
            let number_of = |value: f64| node(Content::Number(value));
            let z = rise(part, 0.0).unwrap_or(0.0);
            let position = vec![pose.position.x, pose.position.y, z].into_iter().map(number_of);
            let pairs = vec![
                (text("name"), text(&part_name(name, part, number))),
                (text("shape"), shape.clone()),
                (text("position"), node(Content::List(position.collect()))),
                (text("yaw_deg"), number_of(pose.heading.to_degrees())),
            ];
            all.push((node(Content::Map(pairs)), k));
        }
    }
    all
}
