//! Joints of a task file: parsing, and their consistency rules.
//!
//! The simulators handle a forest of joints. Every jointed group is a tree of at most [`GROUP`]
//! objects, of similar mass unless all its joints are fixed. A closed loop is refused, because its
//! constraints would pull from two sides and never quite agree.

use crate::asset::node::Node;
use crate::asset::spec::{ANGLE_LIMIT, Key, POSITION, Range, SHIFT_LIMIT, Value, numbers};
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, vector};
use crate::geometry::{Footprint, Pose, clearance};
use crate::scene::{DisjointSets, Joint, Object};

use super::bodies::{body, known_object};
use super::joint_kind::{kind_of, unit};
use super::world_joints;

/// Maximum number of objects in one jointed group.
const GROUP: usize = 12;

/// Maximum mass ratio within one group whose joints are not all fixed. Measured in a row of 12
/// boxes, alternately light and heavy, pushed by half a metre. The axes of revolute joints drift by
/// up to 0.8 mm at a ratio of 10 and by 4 mm at 30.
const GROUP_MASS_RATIO: f64 = 10.0;

/// Maximum mass ratio in a group of at most [`FEW`] objects, such as furniture with a door or a
/// drawer.
const FEW_MASS_RATIO: f64 = 100.0;
const FEW: usize = 3;

/// Maximum gap between jointed objects, metres.
const FAR: f64 = 0.5;

/// Specification of a joint.
pub(super) const JOINT: Value = Value::Map(KEYS);

/// Keys of a joint.
pub(in crate::asset) const KEYS: &[Key] = &[
    Key::required(
        "between",
        Value::List { of: &Value::Name, items: "object names", min: 2, max: 2 },
        "The names of the two objects. `world`, or an obstacle, in place of one of them joins the \
         other to the table, like a door or a drawer.",
    ),
    Key::required(
        "kind",
        Value::Word(&["fixed", "revolute", "prismatic"]),
        "Motion that it allows: none, rotation about a vertical axis, or sliding along a line.",
    ),
    Key::optional("at", POSITION, "Axis of a revolute joint, [x, y] in metres; no default."),
    Key::optional(
        "limits_deg",
        numbers(&ANGLE_LIMIT, 2),
        "Smallest and largest rotation of the second object relative to the first, [low, high] in \
         degrees counter-clockwise from the start (revolute joints only); by default unlimited.",
    ),
    Key::optional(
        "axis",
        numbers(&ALONG, 2),
        "Direction of displacement of a prismatic joint, [x, y] of any length; no default.",
    ),
    Key::optional(
        "limits",
        numbers(&SHIFT_LIMIT, 2),
        "Smallest and largest displacement of the second object relative to the first, [low, high] \
         in metres along the axis from the start (prismatic joints only); by default unlimited.",
    ),
    Key::optional(
        "guessed",
        Value::Switch,
        "Whether only the kind is known and `at` or `axis` is a guess; default false.",
    ),
];

const ALONG: Value = Value::Number(Range {
    what: "a component of a direction",
    low: -1000.0,
    high: 1000.0,
    advice: "only the direction counts: [1, 0] is +x",
});

/// Returns the joint; `None` if a required value is missing or faulty.
pub(in crate::asset) fn joint(node: &Node, objects: &[Object]) -> Option<Joint> {
    let index = |node: &Node| {
        let name = node.text()?;
        objects.iter().position(|object| object.name == name)
    };
    let between = match node.get("between")?.items() {
        [first, second] => [index(first)?, index(second)?],
        _ => return None,
    };
    let guessed = node.get("guessed").is_some_and(|node| node.switch() == Some(true));
    Some(Joint { between, kind: kind_of(node)?, guessed })
}

/// Reports every fault of the joints.
pub(super) fn check(joints: &[Node], objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let mut groups = Groups::of(objects.len());
    let mut known: Vec<[usize; 2]> = Vec::new();
    for node in joints {
        check_keys(node, ledger);
        check_limits(node, ledger);
        if let Some(name) = world_joints::moving(node, objects, obstacles) {
            world_joints::check(node, ledger);
            let Some(object) = known_object(name, objects, obstacles, ledger) else { continue };
            let index = objects.iter().position(|other| other.id == object.id);
            groups.hold(index.unwrap_or_default(), node, name_of(object).unwrap_or("?"), ledger);
            continue;
        }
        let Some(pair) = pair(node, objects, obstacles, ledger) else { continue };
        let [first, second] = pair.map(|index| &objects[index]);
        check_distances(node, first, second, ledger);
        let names = pair.map(|index| name_of(&objects[index]).unwrap_or_default());
        if known.contains(&pair) || known.contains(&[pair[1], pair[0]]) {
            ledger.fault(
                node,
                format!("`{}` and `{}` already have a joint", names[0], names[1]),
                "keep one of the two; two objects can have only one joint",
            );
            continue;
        }
        known.push(pair);
        groups.join(pair, node, names, ledger);
    }
    groups.check_masses(objects, ledger);
}

/// Returns the indices of the two different objects that a joint names.
fn pair(
    joint: &Node,
    objects: &[Node],
    obstacles: &[Node],
    ledger: &mut Ledger,
) -> Option<[usize; 2]> {
    let between = joint.get("between")?;
    let found: Vec<&Node> = between
        .items()
        .iter()
        .filter_map(|name| known_object(name, objects, obstacles, ledger))
        .collect();
    let index = |node: &Node| objects.iter().position(|object| object.id == node.id);
    match found[..] {
        [first, second] if first.id == second.id => {
            ledger.fault(between, "a joint of an object with itself", "name two different objects");
            None
        }
        [first, second] => Some([index(first)?, index(second)?]),
        _ => None,
    }
}

/// Checks that every key belongs to the joint's kind, and that the keys required by the kind are
/// present.
fn check_keys(joint: &Node, ledger: &mut Ledger) {
    let Some(kind) = joint.get("kind").and_then(Node::text) else { return };
    let keys = [("at", "revolute"), ("limits_deg", "revolute")]
        .into_iter()
        .chain([("axis", "prismatic"), ("limits", "prismatic")]);
    for (key, owner) in keys.filter(|(_, owner)| *owner != kind) {
        let Some(node) = joint.get(key) else { continue };
        let advice = match (key, kind) {
            ("limits", "revolute") => "limits of rotation are `limits_deg`, in degrees".into(),
            ("limits_deg", "prismatic") => "limits of displacement are `limits`, in metres".into(),
            _ => format!("remove it; only a {owner} joint has this key"),
        };
        ledger.fault(node, format!("a {kind} joint has no `{key}`"), advice);
    }
    let needed = match kind {
        "revolute" => ("at", "add `at: [x, y]`, the position of the axis"),
        "prismatic" => ("axis", "add `axis: [x, y]`, the direction of displacement"),
        _ => return,
    };
    // A misspelled key is one fault, not two.
    let strange = |key: &Node| !KEYS.iter().any(|known| key.text() == Some(known.name));
    let misspelled = joint.pairs().iter().any(|(key, _)| strange(key));
    match joint.get(needed.0) {
        None if !misspelled => {
            ledger.fault(joint, format!("a {kind} joint needs `{}`", needed.0), needed.1);
        }
        Some(axis) if needed.0 == "axis" && vector(axis).is_some_and(|v| unit(v).is_none()) => {
            let advice = "write a direction, such as [1, 0] for +x";
            ledger.fault(axis, "an axis of length zero has no direction", advice);
        }
        _ => {}
    }
}

/// Maximum difference between the limits of a revolute joint, degrees; beyond it, overshoot of one
/// limit cannot be distinguished from overshoot of the other.
const MOST_TURN: f64 = 340.0;

/// Checks that limits are in order and contain the start.
fn check_limits(joint: &Node, ledger: &mut Ledger) {
    for (key, what) in [("limits_deg", "turn"), ("limits", "shift")] {
        let Some(node) = joint.get(key) else { continue };
        let [Some(low), Some(high)] = [0, 1].map(|k| node.items().get(k).and_then(Node::number))
        else {
            continue;
        };
        if low >= high {
            ledger.fault(
                node,
                format!("the lower limit, {low}, is not below the upper, {high}"),
                "write [low, high]; a joint that cannot move is `kind: fixed`",
            );
        } else if key == "limits_deg" && high - low > MOST_TURN {
            ledger.fault(
                node,
                format!("the range from {low} to {high} is larger than {MOST_TURN} degrees"),
                "leave the limits out if the joint rotates freely",
            );
        } else if low > 0.0 || high < 0.0 {
            ledger.fault(
                node,
                format!("the start, a {what} of 0, violates the limits {low} to {high}"),
                "limits are relative to the poses at the start: widen them to contain 0, or move \
                 the objects",
            );
        }
    }
}

/// Reports joints between bodies that are too far apart.
fn check_distances(joint: &Node, first: &Node, second: &Node, ledger: &mut Ledger) {
    let (Some(a), Some(b)) = (body(first), body(second)) else { return };
    let gap = |a: &(Footprint, Pose), b: &(Footprint, Pose)| {
        clearance((&a.0, &a.1), (&b.0, &b.1), f64::MAX)
    };
    let names = || [first, second].map(|node| name_of(node).unwrap_or_default());
    let apart = gap(&a, &b);
    if apart > FAR {
        let [a, b] = names();
        ledger.fault(
            joint.get("between").unwrap_or(joint),
            format!("`{a}` and `{b}` are {apart:.2} m apart; a joint spans at most {FAR} m"),
            "move them closer together; lengths are in metres",
        );
    }
    let Some(node) = joint.get("at") else { return };
    let Some(at) = vector(node) else { return };
    let point = (Footprint::Disc { radius: 0.0 }, Pose { position: at, heading: 0.0 });
    let beyond = gap(&point, &a).min(gap(&point, &b));
    if beyond > FAR {
        let [a, b] = names();
        ledger.fault(
            node,
            format!("the axis is {beyond:.2} m away from `{a}` and `{b}`; the limit is {FAR} m"),
            "`at` is in the world frame, in metres",
        );
    }
}

/// Jointed groups of objects.
struct Groups {
    sets: DisjointSets,
    /// Whether the group that begins with an object has a joint that is not fixed.
    moves: Vec<bool>,
    /// Whether the group is joined to the world.
    held: Vec<bool>,
}

impl Groups {
    fn of(objects: usize) -> Self {
        Self {
            sets: DisjointSets::new(objects),
            moves: vec![false; objects],
            held: vec![false; objects],
        }
    }

    fn size(&self, group: usize) -> usize {
        (0..self.moves.len()).filter(|&object| self.sets.lowest(object) == group).count()
    }

    /// Joins the group of an object to the world; reports a fault if it is already joined.
    fn hold(&mut self, object: usize, node: &Node, name: &str, ledger: &mut Ledger) {
        let group = self.sets.lowest(object);
        if std::mem::replace(&mut self.held[group], true) {
            let message =
                format!("`{name}` is joined to the world twice, maybe through another object");
            ledger.fault(node, message, "remove one of the joints; joined objects must form trees");
        }
    }

    /// Joins the groups of a pair; reports a fault if this closes a loop or the group becomes too
    /// large.
    fn join(&mut self, pair: [usize; 2], node: &Node, names: [&str; 2], ledger: &mut Ledger) {
        let [a, b] = pair.map(|index| self.sets.lowest(index));
        if a == b {
            ledger.fault(
                node,
                format!(
                    "this joint of `{}` and `{}` closes a loop, which is not supported",
                    names[0], names[1]
                ),
                "remove one joint of the loop; joined objects must form trees",
            );
            return;
        }
        let (a_size, b_size) = (self.size(a), self.size(b));
        if a_size <= GROUP && b_size <= GROUP && a_size + b_size > GROUP {
            ledger.fault(
                node,
                format!(
                    "this joint connects {} objects; at most {GROUP} joined objects can be \
                     simulated",
                    a_size + b_size
                ),
                "remove a joint, or write objects with fixed joints as one cuboid",
            );
        }
        if self.held[a] && self.held[b] {
            let message = format!(
                "this joint closes a loop through the world: `{}` and `{}` are both joined to it",
                names[0], names[1]
            );
            ledger.fault(
                node,
                message,
                "remove one joint of the loop; joined objects must form trees",
            );
        }
        self.sets.join(pair);
        let fixed = node.get("kind").and_then(Node::text) == Some("fixed");
        let joined = a.min(b);
        self.held[joined] = self.held[a] || self.held[b];
        self.moves[joined] = self.moves[a] || self.moves[b] || !fixed;
    }

    fn check_masses(&self, objects: &[Node], ledger: &mut Ledger) {
        for group in (0..objects.len()).filter(|&group| self.moves[group]) {
            let mut masses: Vec<(f64, &Node)> = objects
                .iter()
                .enumerate()
                .filter(|(index, _)| self.sets.lowest(*index) == group)
                .filter_map(|(_, object)| object.get("mass"))
                .filter_map(|node| Some((node.number()?, node)))
                .collect();
            masses.sort_by(|a, b| a.0.total_cmp(&b.0));
            let (Some(lightest), Some(heaviest)) = (masses.first(), masses.last()) else {
                continue;
            };
            let ratio = heaviest.0 / lightest.0;
            let most = if masses.len() <= FEW { FEW_MASS_RATIO } else { GROUP_MASS_RATIO };
            if ratio > most {
                ledger.fault(
                    heaviest.1,
                    format!(
                        "this object has {ratio:.1} times the mass of the lightest object joined \
                         to it ({} kg); at most {most} times can be simulated",
                        lightest.0
                    ),
                    "bring the masses of joined objects closer together",
                );
            }
        }
    }
}
