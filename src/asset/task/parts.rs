//! Objects of several solids: a mug with its handle, a T, a tray with its rim.
//!
//! A file says them as one object with `parts`; a scene has one object for every solid, see
//! [`crate::scene::Whole`].

use crate::asset::node::{Content, Node};
use crate::asset::spec::{ANGLE, FRICTION, Key, MASS, PLACED_SHAPE, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, number_or, placed, pose, shape};
use crate::geometry::Pose;
use crate::scene::{Object, Whole, bearings, hanging};

use super::build::support;
use super::object;
use super::obstacles::{PLACE, height};
use super::plates::{self, is_plate};
use super::spec::OBJECT_SUPPORT;

/// What else belongs to an object.
pub(super) const PARTS: Key = Key::optional(
    "parts",
    Value::List { of: &PART, items: "parts", min: 0, max: 16 },
    "Further solids that are one with it, as a mug's handle is; by default none.",
);

/// How high above its object's underside a part may begin: as high as solids may be.
const RISE: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 10.0,
    advice: "heights are in metres, upward from the underside of the object: 60 mm is 0.06",
});

const PART: Value = Value::Map(&[
    Key::optional(
        "name",
        Value::Name,
        "What messages call it, after the object's name and a slash; by default its number.",
    ),
    Key::required("shape", PLACED_SHAPE, "The part's solid, upright."),
    Key::required(
        "position",
        PLACE,
        "Its centre in the object's frame, [x, y] in metres; [0, 0] is the object's position. A third \
         number is `z`. On an object with `clearance` or `z`, from the origin of its corners.",
    ),
    Key::optional("yaw_deg", ANGLE, "Its turn in the object's frame, degrees; default 0."),
    Key::optional(
        "z",
        RISE,
        "Height of its underside above the object's, metres; default 0, or on top of an object with \
         `clearance` or `z`. What is higher than 0 carries no weight, and lower things pass below it.",
    ),
    Key::optional(
        "mass",
        MASS,
        "Its share of the object's mass, kg; by default what the others leave, by volume.",
    ),
    Key::optional("friction", FRICTION, "Friction value; by default the object's."),
    OBJECT_SUPPORT,
]);

/// The parts of an object in a file.
pub(super) fn parts(object: &Node) -> &[Node] {
    object.get("parts").map(Node::items).unwrap_or_default()
}

/// What messages call part `number` of an object.
pub(super) fn part_name(object: &str, part: &Node, number: usize) -> String {
    match name_of(part) {
        Some(name) => format!("{object}/{name}"),
        None => format!("{object}/{}", number + 1),
    }
}

/// Where a part is in its object's frame.
pub(super) fn place(part: &Node) -> Option<Pose> {
    placed(part)
}

/// Height of a part's underside above its object's, metres; `usual` where none is stated.
pub(super) fn rise(part: &Node, usual: f64) -> Option<f64> {
    match part.get("z") {
        Some(z) => z.number(),
        None => height(part.get("position")?, usual),
    }
}

/// Objects with all their parts, these after all of those; `None` if anything needed is missing or was
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

/// The solids of an object that has number `index` in the scene, the object itself first.
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

/// The mass of every solid, kg: what is stated of it, or its share by volume of what that leaves.
pub(in crate::asset) fn shares(left: f64, solids: &[Object], stated: &[Option<f64>]) -> Vec<f64> {
    let volume = |solid: &Object| solid.shape.footprint().area() * solid.shape.height();
    let open = || solids.iter().zip(stated).filter(|(_, stated)| stated.is_none());
    let all: f64 = open().map(|(solid, _)| volume(solid)).sum();
    let share = |(solid, stated): (&Object, &Option<f64>)| {
        stated.unwrap_or_else(|| left * (volume(solid) / all))
    };
    solids.iter().zip(stated).map(share).collect()
}

/// Notes what is wrong with the parts of an object.
pub(super) fn check(object: &Node, ledger: &mut Ledger) {
    let parts = parts(object);
    let mut names = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        crate::asset::prism::check(part.get("shape"), ledger);
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
    if is_plate(object) {
        return;
    }
    above(object, ledger);
    let stated = parts.iter().filter_map(|part| part.get("mass").and_then(Node::number));
    let (stated, whole) = (stated.sum::<f64>(), object.get("mass"));
    if let (Some(node), Some(mass)) = (whole, whole.and_then(Node::number))
        && stated >= mass
    {
        ledger.fault(
            node,
            format!(
                "the parts alone have {stated} kg, so nothing is left for the object's own solid"
            ),
            "`mass` is that of everything, parts included",
        );
    }
}

/// What is above the table is held by what stands there, and does not bring it down.
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
            let message =
                format!("`{}` hangs in the air: it touches nothing of its object", solid.name);
            let advice = "move it until it touches another part, seen from above and from the side";
            ledger.fault(part.get("z").unwrap_or(part), message, advice);
        }
        if let Some(support) = part.get("support").filter(|_| solid.is_raised()) {
            let message = format!("`{}` is above the table and rests on nothing", solid.name);
            ledger.fault(support, message, "leave `support` out, or `z`");
        }
    }
    if bearings(&solids.iter().collect::<Vec<_>>()).is_none() {
        ledger.fault(
            object.get("parts").unwrap_or(object),
            "the object would fall: its centre of mass does not lie above what it stands on",
            "what is above the table carries nothing; make it lighter, or let more stand",
        );
    }
}

/// The solids of objects, each as an object of its own at its place in the scene, and the number of the
/// object that it belongs to: what rules about room look at.
pub(super) fn apart(objects: &[Node]) -> Vec<(Node, usize)> {
    let mut all = Vec::new();
    for (k, object) in objects.iter().enumerate() {
        all.push((object.clone(), k));
        let Some(at) = placed(object) else { continue };
        let name = name_of(object).unwrap_or("?");
        for (number, part) in parts(object).iter().enumerate() {
            // The point that the position names: whoever takes the pose finds the centre from it.
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
