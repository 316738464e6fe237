//! Goals of a task file: one entry per kind of demand, and the keys that all entries share.
//!
//! A new kind of demand needs a file in `goals` with its [`Ask`], and a line in [`ASKS`].

mod ask;
mod coverage;
mod fall;
mod flipped;
mod gap;
mod group;
mod heading;
mod joint;
mod outside;
mod place;
mod raised;
mod region;

use serde_json::{Map, Value as Json, json};

use crate::asset::diagnostic::one_of;
use crate::asset::node::{Content, Node};
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::number_or;
use crate::{
    scene::Scene,
    task::{Demand, Goal, Kind},
};

use ask::Ask;
pub(super) use ask::{About, Asked};

/// Entries for the demands of a goal, positions first.
const ASKS: [Ask; 11] = [
    place::POSITION,
    region::REGION,
    gap::GAP,
    coverage::COVERAGE,
    fall::OFF_TABLE,
    outside::OUTSIDE,
    raised::RAISED,
    flipped::FLIPPED,
    heading::HEADING,
    joint::TURN,
    joint::SHIFT,
];

/// Meaning of the key that names the object.
const OBJECT: &str = "Name of the object to bring to the goal.";

/// Keys of a goal that state no demand.
const SHARED: [Key; 5] = [
    Key::optional(
        "object",
        Value::Name,
        "Name of an object of the scene; by default `objects` names several.",
    ),
    Key::optional(
        "objects",
        Value::List { of: &Value::Name, items: "names of objects", min: 1, max: 16 },
        "Names of objects that must all be brought to the goal; by default `object` names one.",
    ),
    group::AT_LEAST,
    Key::optional(
        "relative_to",
        Value::Name,
        "Another object that defines the frame of position, region and heading, at its final pose; \
         by default the world.",
    ),
    Key::optional(
        "weight",
        Value::Number(Range {
            what: "a weight",
            low: 0.001,
            high: 1000.0,
            advice: "1 is usual, 2 counts twice",
        }),
        "Weight of the goal if not all of several goals can be met: a plan meets the goals of the \
         largest total weight and is called partial; default 1.",
    ),
];

const fn count() -> usize {
    let (mut count, mut k) = (SHARED.len(), 0);
    while k < ASKS.len() {
        count += ASKS[k].keys.len();
        k += 1;
    }
    count
}

static KEYS: [Key; count()] = {
    let mut keys = [SHARED[0]; count()];
    let (mut next, mut k) = (1, 0);
    while k < ASKS.len() {
        let mut own = 0;
        while own < ASKS[k].keys.len() {
            keys[next] = ASKS[k].keys[own];
            next += 1;
            own += 1;
        }
        k += 1;
    }
    let mut shared = 1;
    while shared < SHARED.len() {
        keys[next] = SHARED[shared];
        next += 1;
        shared += 1;
    }
    keys
};

/// Specification of a goal.
pub(super) const GOAL: Value = Value::Map(&KEYS);

/// Returns the entries whose key is present in a goal.
fn asks(goal: &Node) -> impl Iterator<Item = &'static Ask> {
    const ALL: &[Ask] = &ASKS;
    ALL.iter().filter(|ask| goal.get(ask.keys[0].name).is_some())
}

/// Reports the faults of a goal's demands that span several keys.
pub(super) fn check(asked: &Asked, ledger: &mut Ledger) {
    asks(asked.goal).for_each(|ask| (ask.check)(asked, ledger));
}

/// Returns the keys of a goal that state a demand on one of the given properties.
pub(super) fn asking(goal: &Node, about: &[About]) -> Vec<&'static str> {
    asks(goal).filter(|ask| about.contains(&ask.about)).map(|ask| ask.keys[0].name).collect()
}

/// Returns `true` if a goal has a demand that only lever-ups fulfil.
pub(super) fn lifts(goal: &Node) -> bool {
    !asking(goal, &[About::Lifted]).is_empty()
}

/// Lists the keys that state a demand, in words.
pub(super) fn ways_to_ask() -> String {
    let names: Vec<String> = ASKS.iter().map(|ask| format!("`{}`", ask.keys[0].name)).collect();
    one_of(&names)
}

/// Returns `true` if a goal may have this key.
pub(super) fn is_key(name: Option<&str>) -> bool {
    KEYS.iter().any(|key| name == Some(key.name))
}

/// Returns the goals under a task's key, which holds a goal or a list of goals.
fn written(node: &Node) -> &[Node] {
    match &node.content {
        Content::List(_) => node.items(),
        _ => std::slice::from_ref(node),
    }
}

/// Returns the goals under a task's key, with one goal per named object.
pub(super) fn each(node: &Node) -> Vec<Node> {
    written(node).iter().flat_map(single).collect()
}

/// Splits a goal into one goal per object.
fn single(goal: &Node) -> Vec<Node> {
    let Some(names) = goal.get("objects") else { return vec![goal.clone()] };
    let of = |name: &Node| {
        let key = |(key, value): &(Node, Node)| match key.text() {
            Some("objects") => {
                (Node { content: Content::Text("object".to_owned()), ..key.clone() }, name.clone())
            }
            _ => (key.clone(), value.clone()),
        };
        let pairs = goal.pairs().iter().map(key).collect();
        Node { id: goal.id, content: Content::Map(pairs) }
    };
    names.items().iter().map(of).collect()
}

/// Reports goals that name no object, or an object twice.
pub(super) fn check_names(node: &Node, ledger: &mut Ledger) {
    for goal in written(node) {
        match (goal.get("object"), goal.get("objects")) {
            (None, None) if goal.pairs().iter().all(|(key, _)| is_key(key.text())) => {
                ledger.fault(goal, "missing key `object`", OBJECT);
            }
            (Some(_), Some(names)) => {
                let advice = "keep one of them";
                ledger.fault(names, "`object` and `objects` name the same", advice);
            }
            _ => {}
        }
        group::check(goal, ledger);
        let names = goal.get("objects").map(Node::items).unwrap_or_default();
        for (k, name) in names.iter().enumerate().filter(|(_, name)| name.text().is_some()) {
            if names[..k].iter().any(|before| before.text() == name.text()) {
                let message = format!("`{}` is named twice", name.text().unwrap_or_default());
                ledger.fault(name, message, "name it once");
            }
        }
    }
}

/// Returns the goals under a task's key; `None` if a required value is missing or faulty.
pub(super) fn goals(node: &Node, scene: &Scene) -> Option<Vec<Goal>> {
    let of = |written: &Node| {
        let members =
            single(written).iter().map(|node| goal(node, scene)).collect::<Option<_>>()?;
        group::grouped(written, members)
    };
    let goals: Option<Vec<Vec<Goal>>> = written(node).iter().map(of).collect();
    Some(goals?.into_iter().flatten().collect())
}

/// Returns the goal of one object; `None` if a required value is missing or faulty.
fn goal(node: &Node, scene: &Scene) -> Option<Goal> {
    let object = scene.object(node.get("object")?.text()?)?;
    let read = |ask: &Ask| (ask.read)(node, object, scene);
    let mut goal = Goal::of(object);
    goal.weight = number_or(node, "weight", goal.weight)?;
    goal.demands = asks(node).map(read).collect::<Option<_>>()?;
    if let Some(other) = node.get("relative_to") {
        goal = goal.relative_to(scene.object(other.text()?)?);
    }
    // Positions come first, as in plan files, then headings.
    let order = |demand: &Demand| {
        let kind = demand.kind();
        (kind.tolerance().is_none(), kind.facing().is_none())
    };
    goal.demands.sort_by_key(order);
    let symmetric = match node.get("symmetric") {
        Some(symmetric) => symmetric.switch()?,
        None => true,
    };
    let goal = if symmetric { goal.looking_alike(scene) } else { goal };
    Some(goal.within_limits(scene))
}

/// Returns goals as in a file, with as many entries per object as its demands need.
pub(in crate::asset) fn emitted_goals(goals: &[Goal], scene: &Scene) -> Json {
    let mut all: Vec<Json> = goals.iter().flat_map(|goal| emitted(goal, scene)).collect();
    match all.len() {
        1 => all.remove(0),
        _ => Json::Array(all),
    }
}

/// Returns a goal as in a file, with a further entry for each demand that does not fit in the last
/// one.
fn emitted(goal: &Goal, scene: &Scene) -> Vec<Json> {
    let name = &scene.objects[goal.object].name;
    let mut entries: Vec<(Map<String, Json>, Vec<&Demand>)> = Vec::new();
    let mut groups = Vec::new();
    for demand in &goal.demands {
        if let Demand::Group(own) = demand {
            groups.extend(group::emitted(own, scene, |member| emitted(member, scene)));
            continue;
        }
        let fields = keys(demand, goal, scene);
        if !entries.last().is_some_and(|(_, held)| held.iter().all(|other| shares(demand, other))) {
            let mut entry = Map::from_iter([("object".to_owned(), json!(name))]);
            if goal.weight != 1.0 && entries.is_empty() {
                entry.insert("weight".to_owned(), json!(goal.weight));
            }
            entries.push((entry, Vec::new()));
        }
        if let Some((entry, held)) = entries.last_mut() {
            entry.extend(fields);
            held.push(demand);
        }
    }
    entries.into_iter().map(|(entry, _)| Json::Object(entry)).chain(groups).collect()
}

/// Returns `true` if two demands fit in one entry.
fn shares(one: &Demand, other: &Demand) -> bool {
    let framed = |kind: &dyn Kind| kind.position().is_some() || kind.facing().is_some();
    let [a, b] = [one.kind(), other.kind()];
    std::mem::discriminant(one) != std::mem::discriminant(other)
        && !(a.tolerance().is_some() && b.tolerance().is_some())
        && !(a.facing().is_some() && b.facing().is_some())
        && !(framed(a) && framed(b) && a.relative() != b.relative())
}

/// Returns the keys of a demand.
fn keys(demand: &Demand, goal: &Goal, scene: &Scene) -> Map<String, Json> {
    let written = ASKS.iter().find_map(|ask| (ask.write)(demand, goal, scene));
    let mut keys = written.and_then(|json| json.as_object().cloned()).unwrap_or_default();
    if let Some(other) = demand.kind().relative() {
        keys.insert("relative_to".to_owned(), json!(scene.objects[other].name));
    }
    keys
}
