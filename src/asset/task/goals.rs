//! Goals of a task file: a place, a region, a gap, a coverage, off the table, a heading, how far a joint has
//! come.

use serde_json::{Map, Value as Json, json};

use crate::asset::node::{Content, Node};
use crate::asset::saved::emit::{degrees, posed};
use crate::asset::spec::{ANGLE, Key, POSITION, Range, SHIFT_LIMIT, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::{angle, angle_of, name_of, number_or, position, shape, vector};
use crate::geometry::{Footprint, Pose, clearance};
use crate::{
    scene::{JointKind, Scene},
    task::{Area, AtPlace, Demand, Facing, Goal, InArea, Kind},
};

use super::coverage::{COVERAGE, covering, emitted_coverage};
use super::falls::{OFF_TABLE, check_fall, emitted_fall, fall};
use super::gap::{GAP, check_gap, emitted_gap, gap};
use super::keep::{AREA, AREA_POSITION, AREA_YAW, area, check_area, emitted_area as area_of};
use super::lifting::{self, FLIPPED, OUTSIDE, RAISED, check_lifting, lifted};
use super::mounts::moving;
use super::parts::parts;
use super::plates::is_plate;
use super::rules::{SLACK, body, known_object, passes};
use super::spec::default;

/// One goal.
pub(super) const GOAL: Value = Value::Map(&[
    Key::required("object", Value::Name, "Name of the object to bring to the goal."),
    Key::optional(
        "position",
        POSITION,
        "Wanted position of its centre, [x, y] in metres; by default anywhere.",
    ),
    Key::optional(
        "tolerance",
        Value::Number(Range {
            what: "a tolerance in metres",
            low: 0.001,
            high: 1.0,
            advice: "2 cm is 0.02; simulators themselves differ by millimetres",
        }),
        "Largest distance from the position that still counts as success, metres; no default.",
    ),
    Key::optional(
        "region",
        Value::Map(&[AREA, AREA_POSITION, AREA_YAW]),
        "Where its centre may lie instead, a circle, rectangle or polygon; by default nowhere in \
         particular.",
    ),
    GAP,
    COVERAGE,
    OFF_TABLE,
    OUTSIDE,
    RAISED,
    FLIPPED,
    Key::optional("heading_deg", ANGLE, "Wanted heading, degrees; by default any."),
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
         false where one side is marked.",
    ),
    Key::optional(
        "relative_to",
        Value::Name,
        "Another object in whose frame position, region and heading are, wherever that has come to; by \
         default the world.",
    ),
    Key::optional(
        "joint_deg",
        ANGLE,
        "How far its revolute joint has turned it, degrees counter-clockwise from the start, against what \
         it is joined to; within the joint's limits, if by the longer way, and without limits by the shorter \
         one. By default any.",
    ),
    Key::optional(
        "joint",
        SHIFT_LIMIT,
        "How far its prismatic joint has let it slide along the axis, metres from the start, against what \
         it is joined to; by default any.",
    ),
    Key::optional(
        "weight",
        Value::Number(Range {
            what: "a weight",
            low: 0.001,
            high: 1000.0,
            advice: "1 is usual, 2 counts twice",
        }),
        "How much it counts where not all of several goals can be met: a plan meets those that weigh most \
         together, and is called partial; default 1.",
    ),
]);

/// The goals of a task's key: it holds one, or a list.
pub(super) fn each(node: &Node) -> &[Node] {
    match &node.content {
        Content::List(_) => node.items(),
        _ => std::slice::from_ref(node),
    }
}

/// The goal, or `None` if anything needed is missing or was faulty.
pub(super) fn goal(node: &Node, scene: &Scene) -> Option<Goal> {
    let object = scene.object(node.get("object")?.text()?)?;
    let within = angle(node, "heading_tolerance_deg", default::HEADING_TOLERANCE)?;
    let mut goal = Goal::of(object);
    goal.weight = number_or(node, "weight", goal.weight)?;
    if let Some(region) = node.get("region") {
        let (shape, pose) = area(region)?;
        goal = goal.with(Demand::Area(Box::new(InArea::new(Area { shape, pose }))));
    }
    if let Some(node) = node.get("gap") {
        goal = goal.with(Demand::Gap(gap(node, object, scene)?));
    }
    if let Some(node) = node.get("coverage") {
        goal = goal.with(Demand::Coverage(covering(node, object, scene)?));
    }
    if let Some(node) = node.get("off_table") {
        goal = goal.with(Demand::Fall(fall(node, object, scene)?));
    }
    let tolerance = node.get("tolerance").and_then(Node::number);
    if node.get("position").is_some() {
        let (position, tolerance) = (position(node)?, tolerance?);
        goal = goal.with(Demand::Place(AtPlace { position, tolerance, relative: None }));
    }
    if node.get("heading_deg").is_some() {
        goal = goal.facing(angle(node, "heading_deg", 0.0)?, within);
    }
    if let Some(other) = node.get("relative_to") {
        goal = goal.relative_to(scene.object(other.text()?)?);
    }
    if let Some(turn) = node.get("joint_deg") {
        let (there, relative) = come(scene, object, angle_of(turn)?)?;
        goal =
            goal.with(Demand::Heading(Facing { relative, ..Facing::new(there.heading, within) }));
    }
    if let Some(shift) = node.get("joint") {
        let (there, relative) = come(scene, object, shift.number()?)?;
        let (position, tolerance) = (there.position, tolerance?);
        goal = goal.with(Demand::Place(AtPlace { position, tolerance, relative }));
    }
    // Positions first, as plan files have them.
    goal.demands.sort_by_key(|demand| demand.kind().tolerance().is_none());
    let symmetric = match node.get("symmetric") {
        Some(symmetric) => symmetric.switch()?,
        None => true,
    };
    let goal = if symmetric { goal.looking_alike(scene) } else { goal };
    lifted(node, scene, goal.within_limits(scene))
}

/// Goals as in a file: as many for one object as its demands need.
pub(in crate::asset) fn emitted_goals(goals: &[Goal], scene: &Scene) -> Json {
    let mut all: Vec<Json> = goals.iter().flat_map(|goal| emitted(goal, scene)).collect();
    match all.len() {
        1 => all.remove(0),
        _ => Json::Array(all),
    }
}

/// A goal as in a file, with another entry for each demand that has no room in the last one.
fn emitted(goal: &Goal, scene: &Scene) -> Vec<Json> {
    let name = &scene.objects[goal.object].name;
    let mut entries: Vec<(Map<String, Json>, Vec<&Demand>)> = Vec::new();
    for demand in &goal.demands {
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
    entries.into_iter().map(|(entry, _)| Json::Object(entry)).collect()
}

/// Returns `true` if two demands have room in one entry.
fn shares(one: &Demand, other: &Demand) -> bool {
    let framed = |kind: &dyn Kind| kind.position().is_some() || kind.facing().is_some();
    let [a, b] = [one.kind(), other.kind()];
    std::mem::discriminant(one) != std::mem::discriminant(other)
        && !(a.tolerance().is_some() && b.tolerance().is_some())
        && !(a.facing().is_some() && b.facing().is_some())
        && !(framed(a) && framed(b) && a.relative() != b.relative())
}

/// The keys of a demand, one arm for each kind.
fn keys(demand: &Demand, goal: &Goal, scene: &Scene) -> Map<String, Json> {
    let mut json = match demand {
        Demand::Place(place) => {
            json!({"position": [place.position.x, place.position.y], "tolerance": place.tolerance})
        }
        Demand::Area(own) => {
            json!({"region": posed(json!({"area": area_of(&own.area.shape)}), &own.area.pose)})
        }
        Demand::Heading(facing) => {
            let [heading, within] = [facing.heading, facing.tolerance].map(degrees);
            let mut json = json!({"heading_deg": heading, "heading_tolerance_deg": within});
            let usual = goal.clone().looking_alike(scene);
            if usual.heading().is_some_and(|usual| usual.symmetry != facing.symmetry) {
                json["symmetric"] = json!(false);
            }
            json
        }
        Demand::Gap(gap) => json!({"gap": emitted_gap(gap, scene)}),
        Demand::Coverage(coverage) => json!({"coverage": emitted_coverage(coverage)}),
        Demand::Fall(fall) => json!({"off_table": emitted_fall(fall)}),
        Demand::Outside(outside) => json!({"outside": outside.name}),
        Demand::Raised(raised) => json!({"raised": raised.height}),
        Demand::Flipped(flipped) => json!({"flipped": flipped.flipped}),
    };
    if let Some(other) = demand.kind().relative() {
        json["relative_to"] = json!(scene.objects[other].name);
    }
    json.as_object().cloned().unwrap_or_default()
}

/// Where an object is once its joint has come this far, radians or metres: in the world, or in the frame
/// of the object that it is joined to.
fn come(scene: &Scene, object: usize, by: f64) -> Option<(Pose, Option<usize>)> {
    let start = scene.objects[object].pose;
    if let Some(mount) = scene.mounts.iter().find(|mount| mount.object == object) {
        return Some((mount.pose(&start, by), None));
    }
    let moves = |kind: &JointKind| *kind != JointKind::Fixed;
    let mut joints = scene.joints.iter().filter(|joint| moves(&joint.kind));
    let joint = joints.find(|joint| joint.between.contains(&object))?;
    let [first, second] = joint.between;
    // Joints count how far the second object has come against the first.
    let (other, by) = if second == object { (first, by) } else { (second, -by) };
    let frame = scene.objects[other].pose.inverse() * start;
    let there = match joint.kind {
        JointKind::Prismatic { axis, .. } => {
            let axis = scene.objects[other].pose.local_vector(axis);
            Pose { position: frame.position + by * axis, ..frame }
        }
        _ => Pose { heading: frame.heading + by, ..frame },
    };
    Some((there, Some(other)))
}

/// Notes what is wrong with a goal.
pub(super) fn check(goal: &Node, scene: &Node, ledger: &mut Ledger) {
    let section = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let (objects, obstacles) = (section("objects"), section("obstacles"));
    demands(goal, ledger);
    if let Some(region) = goal.get("region") {
        check_area(region, ledger);
    }
    let Some(name) = goal.get("object") else { return };
    if let Some(gap) = goal.get("gap") {
        check_gap(gap, name, [objects, obstacles], ledger);
    }
    check_fall(goal, name, scene, ledger);
    check_lifting(goal, [objects, obstacles], ledger);
    let Some(object) = known_object(name, objects, obstacles, ledger) else { return };
    let relative = goal.get("relative_to");
    let other = relative.and_then(|other| known_object(other, objects, obstacles, ledger));
    if let Some(node) = relative.filter(|_| other.is_some_and(|other| other.id == object.id)) {
        let advice = "name another object, or leave it out for the world";
        ledger.fault(node, "an object is always where it is to itself", advice);
    }
    by_joint(goal, name, scene, ledger);
    let solid = object.get("shape").and_then(shape);
    // A levered object may come to lie on top of something.
    if let Some(solid) = solid.as_ref().filter(|_| !is_plate(object)) {
        // In the frame of the goal: what does not move, or what it is relative to.
        let fixed = obstacles.iter().filter(|fixed| !passes(object, fixed, SLACK));
        let there: Vec<(&Node, Footprint, Pose)> = match (relative, other) {
            (None, _) => fixed
                .filter_map(|fixed| body(fixed).map(|(solid, pose)| (fixed, solid, pose)))
                .collect(),
            (Some(_), Some(other)) if other.id != object.id => {
                let solid = other.get("shape").and_then(shape);
                solid.map(|solid| (other, solid.footprint(), Pose::default())).into_iter().collect()
            }
            _ => Vec::new(),
        };
        room_at_the_goal(goal, (name, &solid.footprint()), &there, ledger);
    }
    let round = solid.is_some_and(|solid| solid.is_cylinder()) && parts(object).is_empty();
    if let (Some(heading), true) = (goal.get("heading_deg"), round) {
        ledger.fault(
            heading,
            "a cylinder looks the same at every heading, so it cannot have a heading goal",
            "remove `heading_deg`, or make the object a cuboid",
        );
    }
}

/// A goal asks for something, and for nothing twice.
fn demands(goal: &Node, ledger: &mut Ledger) {
    let has = |key: &str| goal.get(key).is_some();
    for (key, of, what) in [
        ("heading_tolerance_deg", ["heading_deg", "joint_deg"], "a heading tolerance"),
        ("symmetric", ["heading_deg", "heading_deg"], "`symmetric`"),
        ("tolerance", ["position", "joint"], "a tolerance"),
    ] {
        if let Some(node) = goal.get(key).filter(|_| !of.iter().any(|of| has(of))) {
            let needed = if key == "tolerance" { "position" } else { "heading" };
            let message = format!("{what} without a {needed}");
            ledger.fault(node, message, format!("add `{}`, or remove it", of[0]));
        }
    }
    for key in ["position", "joint"] {
        if let (Some(node), false) = (goal.get(key), has("tolerance")) {
            let message = format!("`{key}` needs a `tolerance`");
            ledger.fault(node, message, "add `tolerance: 0.02`, in metres");
        }
    }
    let places = ["position", "region", "gap", "coverage", "joint", "off_table"]
        .into_iter()
        .filter(|key| has(key));
    let turns = ["heading_deg", "joint_deg"].into_iter().filter(|key| has(key));
    let (places, turns): (Vec<_>, Vec<_>) = (places.collect(), turns.collect());
    for twice in [&places, &turns].into_iter().filter(|keys| keys.len() > 1) {
        let message = format!("`{}` and `{}` ask for the same", twice[0], twice[1]);
        ledger.fault(goal.get(twice[1]).unwrap_or(goal), message, "keep one of them");
    }
    for key in ["off_table", "coverage"] {
        if let (Some(node), Some(turn)) = (goal.get(key), turns.first()) {
            let message = format!("`{key}` does not go together with `{turn}`");
            let advice = "keep one of them; a coverage has a heading of its own";
            ledger.fault(node, message, advice);
        }
    }
    if places.is_empty() && turns.is_empty() && !lifting::lifts(goal) {
        // A misspelt key is one fault, not two.
        let strange = goal.pairs().iter().any(|(key, _)| {
            !matches!(&GOAL, Value::Map(keys) if keys.iter().any(|known| key.text() == Some(known.name)))
        });
        if !strange {
            let advice = "add `position: [x, y]` and `tolerance`, `region`, `gap`, `coverage`, `off_table`, \
                          `heading_deg`, `joint_deg`, `joint`, `outside`, `raised` or `flipped`";
            ledger.fault(goal, "this goal asks for nothing", advice);
        }
    }
}

/// An object whose joint is to come somewhere has one of the right kind.
fn by_joint(goal: &Node, object: &Node, scene: &Node, ledger: &mut Ledger) {
    let joints = scene.get("joints").map(Node::items).unwrap_or_default();
    for (key, kind) in [("joint_deg", "revolute"), ("joint", "prismatic")] {
        let Some(node) = goal.get(key) else { continue };
        let own = joints.iter().filter(|joint| {
            let between = joint.get("between").map(Node::items).unwrap_or_default();
            between.iter().any(|name| name.text() == object.text())
                && joint.get("kind").and_then(Node::text) != Some("fixed")
        });
        let own: Vec<&Node> = own.collect();
        let name = object.text().unwrap_or("?");
        match own[..] {
            [joint] if joint.get("kind").and_then(Node::text) == Some(kind) => {
                within_limits(node, (object, joint), scene, ledger);
            }
            [_] => {
                let message = format!("the joint of `{name}` is not {kind}");
                let advice = "turns are asked for by `joint_deg`, shifts by `joint`";
                ledger.fault(node, message, advice);
            }
            [] => {
                let message = format!("`{name}` has no joint that moves");
                ledger.fault(node, message, "name an object that a joint of the scene lets move");
            }
            _ => {
                let message =
                    format!("`{name}` has several joints, so it is not clear which is meant");
                ledger.fault(node, message, "ask for a position or a heading instead");
            }
        }
        if let Some(other) = goal.get("relative_to") {
            let advice = "leave it out: a joint counts against what it joins";
            ledger.fault(other, format!("`{key}` is relative to something already"), advice);
        }
    }
}

/// A joint does not come farther than its limits.
fn within_limits(
    wanted: &Node,
    (object, joint): (&Node, &Node),
    scene: &Node,
    ledger: &mut Ledger,
) {
    let section = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let limits = joint.get("limits").or_else(|| joint.get("limits_deg"));
    let [Some(low), Some(high)] =
        [0, 1].map(|k| limits.and_then(|limits| limits.items().get(k)).and_then(Node::number))
    else {
        return;
    };
    let to_world = moving(joint, section("objects"), section("obstacles")).is_some();
    let between = joint.get("between").map(Node::items).unwrap_or_default();
    let first = between.first().and_then(Node::text) == object.text();
    // Limits are those of the second object against the first.
    let (low, high) = if first && !to_world { (-high, -low) } else { (low, high) };
    if wanted.number().is_some_and(|wanted| wanted < low || wanted > high) {
        let name = object.text().unwrap_or("?");
        let message = format!("the joint of `{name}` only comes from {low} to {high}");
        ledger.fault(wanted, message, "ask for less, or widen the joint's limits");
    }
}

/// A goal at which the object would be inside something that is there, however it is turned and wherever
/// within the tolerance it lies.
fn room_at_the_goal(
    goal: &Node,
    (name, object): (&Node, &Footprint),
    there: &[(&Node, Footprint, Pose)],
    ledger: &mut Ledger,
) {
    let place = match goal.get("coverage").and_then(|coverage| coverage.get("position")) {
        Some(node) => Some((node, 0.0)),
        None => goal.get("position").zip(goal.get("tolerance").and_then(Node::number)),
    };
    let Some((node, tolerance)) = place else { return };
    let Some(at) = vector(node).map(|position| Pose { position, heading: 0.0 }) else { return };
    let core = Footprint::Disc { radius: object.inner_radius() - tolerance - SLACK };
    if core.inner_radius() <= 0.0 {
        return;
    }
    for (other, solid, pose) in there {
        if clearance((&core, &at), (solid, pose), SLACK) <= 0.0 {
            let [object, other] = [name.text(), name_of(other)].map(|n| n.unwrap_or("?"));
            ledger.fault(
                node,
                format!("at the goal `{object}` would be inside `{other}`"),
                "move the goal or the obstacle, or allow a larger tolerance",
            );
        }
    }
}
