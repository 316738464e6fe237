//! Goals of a task file: a place, a region, a gap, a coverage, off the table, a heading, how far a joint has
//! come.

use serde_json::{Map, Value as Json, json};

use crate::asset::node::{Content, Node};
use crate::asset::put::{degrees, posed};
use crate::asset::spec::{ANGLE, Key, POSITION, Range, SHIFT_LIMIT, Value};
use crate::asset::take::{angle, angle_of, number_or, position};
use crate::geometry::Pose;
use crate::{
    scene::{JointKind, Scene},
    task::{Area, AtPlace, Demand, Facing, Goal, InArea, Kind},
};

use super::coverage::{COVERAGE, covering, emitted_coverage};
use super::falls::{OFF_TABLE, emitted_fall, fall};
use super::gap::{GAP, emitted_gap, gap};
use super::keep::{AREA, AREA_POSITION, AREA_YAW, area, emitted_area as area_of};
use super::lifting::{FLIPPED, OUTSIDE, RAISED, lifted};

/// Tolerance of a heading where none is stated, degrees.
const HEADING_TOLERANCE: f64 = 10.0;

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
    let within = angle(node, "heading_tolerance_deg", HEADING_TOLERANCE)?;
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
