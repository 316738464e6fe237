//! Rules that span several keys of a task file.

use crate::asset::arm;
use crate::asset::diagnostic::did_you_mean;
use crate::asset::node::Node;
use crate::asset::shapes;
use crate::asset::shapes::shape;
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, number_or, unique_names, vector};
use crate::geometry::clearance;
use crate::{
    scene::{Support, carries},
    task::{PushForm, PushRules},
};

use super::bodies::{SLACK, body, passes};
use super::spec::REACH_KEY;
use super::tools::{check_free, check_tools};
use super::{
    build, frictions, goal_rules, goals, joints, keep as regions, levers, obstacles as fixed, part,
    parts, plates, refused,
};

/// Maximum mass ratio of two objects. At 1000 a simulated body sinks 41 mm into its neighbour
/// unless contacts are stiffened; beyond 1000 stiffening no longer helps.
const MASS_RATIO: f64 = 1000.0;

/// Maximum mass ratio if three or more objects can form a chain, because light bodies between heavy
/// ones break the simulator at every setting.
const CHAIN_MASS_RATIO: f64 = 100.0;

/// Reports every inconsistency between values.
pub(super) fn check(root: &Node, ledger: &mut Ledger) {
    let empty = Node { id: root.id, content: crate::asset::node::Content::Nothing };
    let section = |key| root.get(key).unwrap_or(&empty);
    let (scene, pushes) = (section("scene"), section("pushes"));
    let objects = scene.get("objects").map(Node::items).unwrap_or_default();
    let obstacles = scene.get("obstacles").map(Node::items).unwrap_or_default();
    let lifted = levers::allowed(root);
    match lifted {
        true => refused::check(root, ledger),
        false => refused::check_heights(objects, ledger),
    }
    check_scene(scene, SLACK, ledger);
    unknown(section("unknown"), scene, ledger);
    if !arm::check(section("robot"), ledger) {
        without_arm(section("robot"), ledger);
        robot(section("robot"), pushes, ledger);
    }
    check_tools(section("tools"), ledger);
    if lifted {
        check_free(section("tools"), ledger);
        levers::check(section("levers"), ledger);
        push_rules(pushes, &[], ledger);
    } else {
        push_rules(pushes, objects, ledger);
    }
    if let (true, Some(pushes)) = (lifted, root.get("pushes")) {
        levers::check_follow_up(pushes, section("goal"), ledger);
    }
    goals::check_names(section("goal"), ledger);
    let goals = &goals::each(section("goal"))[..];
    goals.iter().for_each(|one| goal_rules::check(one, scene, ledger));
    one_each(goals, ledger);
    keep(section("keep"), goals, objects, ledger);
    on_table(scene, goals, ledger);
    regions::check(root, &objects.iter().chain(obstacles).collect::<Vec<_>>(), objects, ledger);
    goals.iter().for_each(|one| may_fall(one, objects, ledger));
    // Overlaps are meaningful only if the bodies themselves are valid.
    if lifted && ledger.sound().is_ok() {
        plates::bodies(objects, obstacles, ledger);
    }
}

/// Reports properties that are named unknown twice, and joints that are stated although unknown.
fn unknown(unknown: &Node, scene: &Node, ledger: &mut Ledger) {
    let words = unknown.items();
    for (k, word) in words.iter().enumerate().filter(|(_, word)| word.text().is_some()) {
        if words[..k].iter().any(|before| before.text() == word.text()) {
            let message = format!("`{}` is named twice", word.text().unwrap_or_default());
            ledger.fault(word, message, "name it once");
        }
    }
    let joints = words.iter().any(|word| word.text() == Some("joints"));
    if let Some(stated) = scene.get("joints").filter(|stated| !stated.items().is_empty())
        && joints
    {
        let advice = "remove them, or `joints` from `unknown`";
        ledger.fault(stated, "joints are both stated and unknown", advice);
    }
}

/// Exclusive sets of keys: two goals of one object with keys from the same set contradict each
/// other.
const ALONE: [&[&str]; 2] = [
    &["position", "coverage", "off_table", "joint"],
    &["heading_deg", "joint_deg", "coverage", "off_table"],
];

/// Reports several goals of one object that contradict each other.
fn one_each(goals: &[Node], ledger: &mut Ledger) {
    let name = |goal: &Node| goal.get("object").and_then(Node::text).map(str::to_owned);
    for (k, goal) in goals.iter().enumerate() {
        let Some(object) = name(goal) else { continue };
        let has = |goal: &Node, keys: &[&str]| keys.iter().any(|key| goal.get(key).is_some());
        let own = goals[..k].iter().filter(|before| name(before).as_ref() == Some(&object));
        for before in own {
            if ALONE.iter().any(|keys| has(goal, keys) && has(before, keys)) {
                let message = format!("`{object}` has two goals that contradict each other");
                ledger.fault(goal, message, "keep one of them");
                break;
            }
        }
    }
}

/// Reports kept objects that do not exist or must be moved.
fn keep(keep: &Node, goals: &[Node], objects: &[Node], ledger: &mut Ledger) {
    let wanted: Vec<&str> =
        goals.iter().filter_map(|goal| goal.get("object").and_then(Node::text)).collect();
    let names: Vec<&str> = objects.iter().filter_map(name_of).collect();
    for node in keep.get("objects").map(Node::items).unwrap_or_default() {
        let Some(name) = node.text() else { continue };
        if !names.contains(&name) {
            let message = format!("no object is called `{name}`");
            ledger.fault(node, message, format!("name one of `{}`", names.join("`, `")));
        } else if wanted.contains(&name) {
            ledger.fault(
                node,
                format!("`{name}` is named by a goal and by `keep`"),
                "remove it from one of them",
            );
        }
    }
}

/// Reports objects that may fall although a goal places them on the table.
fn may_fall(goal: &Node, objects: &[Node], ledger: &mut Ledger) {
    if goal.get("off_table").is_some() {
        return;
    }
    let wanted = goal.get("object").and_then(Node::text);
    for object in objects.iter().filter(|object| wanted.is_some() && name_of(object) == wanted) {
        if let Some(node) = object.get("may_fall").filter(|node| node.switch() == Some(true)) {
            let message =
                format!("`{}` has a goal on the table but may fall", wanted.unwrap_or_default());
            ledger.fault(node, message, "leave it out; a fallen object reaches no goal");
        }
    }
}

/// Reports objects and goals off a table of limited size.
fn on_table(scene: &Node, goals: &[Node], ledger: &mut Ledger) {
    let Some(table) = scene.get("table") else { return };
    let Some(top) = table.get("size").and_then(|_| build::table_top(table)) else {
        if let (Some(position), None) = (table.get("position"), table.get("size")) {
            let advice = "add `size: [x, y]`, or remove the position";
            ledger.fault(position, "a table without a size has no middle", advice);
        }
        return;
    };
    let objects = scene.get("objects").map(Node::items).unwrap_or_default();
    let named = objects.iter().map(|object| (object, name_of(object).unwrap_or("?").to_owned()));
    let goals = goals.iter().filter(|goal| goal.get("relative_to").is_none());
    let goals = goals.map(|goal| (goal, "the goal".to_owned()));
    for (node, what) in named.chain(goals) {
        let own = node.get("coverage").unwrap_or(node);
        let Some(position) = own.get("position") else { continue };
        if vector(position).is_some_and(|position| !top.holds(position)) {
            let (size, middle) = (top.size, top.middle);
            let message = format!(
                "{what} lies beyond the table, whose size is {} x {} m and whose middle is ({}, \
                 {})",
                size[0], size[1], middle.x, middle.y
            );
            ledger.fault(position, message, "move it, make the table larger, or move the table");
        }
    }
}

/// Reports every fault of a scene in which bodies may penetrate each other by up to `slack` metres.
pub(super) fn check_scene(scene: &Node, slack: f64, ledger: &mut Ledger) {
    let items = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let (objects, obstacles) = (items("objects"), items("obstacles"));
    let solids = parts::apart(objects);
    unique_names(solids.iter().map(|(solid, _)| solid).chain(obstacles), "bodies", ledger);
    objects.iter().for_each(|object| plates::heights(object, ledger));
    if !objects.iter().any(plates::is_plate) {
        overlaps(&solids, obstacles, slack, ledger);
    }
    fixed::check(obstacles, ledger);
    masses(objects, ledger);
    objects.iter().for_each(|object| shapes::check(object.get("shape"), ledger));
    objects.iter().for_each(|object| parts::check(object, ledger));
    objects.iter().for_each(|object| stands(object, ledger));
    joints::check(items("joints"), objects, obstacles, ledger);
    frictions::check(items("frictions"), objects, obstacles, ledger);
}

/// Reports overlaps among `objects` and with obstacles. `objects` holds solids with the index of
/// the compound object they belong to; solids of one compound object may overlap.
fn overlaps(objects: &[(Node, usize)], obstacles: &[Node], slack: f64, ledger: &mut Ledger) {
    let solid = |node| body(node).map(|(footprint, pose)| (footprint.shrunk(slack / 2.0), pose));
    let bodies = objects.iter().map(|(node, thing)| (node, Some(*thing)));
    let bodies = bodies.chain(obstacles.iter().map(|node| (node, None)));
    let solids: Vec<_> = bodies.map(|(node, thing)| (node, thing, solid(node))).collect();
    for (k, (node, thing, solid)) in solids.iter().enumerate() {
        for (other, other_thing, other_solid) in &solids[..k.min(objects.len())] {
            let (Some((a, at)), Some((b, bt))) = (solid, other_solid) else { continue };
            if thing == other_thing || passes(other, node, slack) {
                continue;
            }
            if clearance((a, at), (b, bt), slack) <= 0.0 {
                let name = |node| name_of(node).unwrap_or("?").to_owned();
                ledger.fault(
                    node.get("position").unwrap_or(node),
                    format!("`{}` overlaps `{}`", name(node), name(other)),
                    "move one of them; bodies may touch but not overlap",
                );
            }
        }
    }
}

/// Reports support points that cannot carry the object.
fn stands(object: &Node, ledger: &mut Ledger) {
    if let (Some(node), Some(Support::Points(points))) =
        (object.get("support"), super::support::support(object))
        && carries(&points).is_none()
    {
        ledger.fault(
            node,
            "the object would topple: its centre is not inside the polygon of these points",
            match object.get("shape").and_then(|shape| shape.get("prism")) {
                Some(_) => "the points are in the frame of the prism's corners",
                None => {
                    "the points are in the object's own frame, whose origin [0, 0] is its centre"
                }
            },
        );
    }
}

fn masses(objects: &[Node], ledger: &mut Ledger) {
    let mut known: Vec<(f64, &Node)> = objects
        .iter()
        .filter_map(|object| object.get("mass"))
        .filter_map(|node| Some((node.number()?, node)))
        .collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some(lightest), Some(heaviest)) = (known.first(), known.last()) else { return };
    let limit = if known.len() > 2 { CHAIN_MASS_RATIO } else { MASS_RATIO };
    let ratio = heaviest.0 / lightest.0;
    if ratio > limit {
        ledger.fault(
            heaviest.1,
            format!(
                "the heaviest object has {ratio:.0} times the mass of the lightest ({} kg); at \
                 most {limit} times can be simulated among {} objects",
                lightest.0,
                known.len()
            ),
            "bring the masses closer together, or make the heaviest an obstacle",
        );
    }
}

/// Checks a robot without an arm: its reach must be stated, and its home must be a position.
pub(super) fn without_arm(robot: &Node, ledger: &mut Ledger) {
    let given = robot.pairs();
    let meant = |(key, _): &(Node, Node)| {
        let advice = did_you_mean(key.text().unwrap_or_default(), ["reach"]);
        advice.starts_with("did you mean")
    };
    let is_map = matches!(robot.content, crate::asset::node::Content::Map(_));
    if is_map && robot.get("reach").is_none() && !given.iter().any(meant) {
        ledger.fault(robot, "missing key `reach`", REACH_KEY.meaning);
    }
    if let Some(home) = robot.get("home")
        && !matches!(home.items().len(), 0 | 2)
    {
        let message = format!("expected a list of 2 numbers, found one of {}", home.items().len());
        ledger.fault(home, message, "joint positions need an arm, which `urdf` defines");
    }
}

/// Checks that the reach is not empty and contains the home position.
fn robot(robot: &Node, pushes: &Node, ledger: &mut Ledger) {
    let Some(reach) = robot.get("reach") else { return };
    let (Some(min), Some(max)) =
        (build::reach_min(robot, reach), reach.get("max").and_then(Node::number))
    else {
        return;
    };
    if min >= max {
        ledger.fault(
            reach,
            format!("the smallest reach, {min}, is not below the largest, {max}"),
            "swap them, or widen the reach",
        );
        return;
    }
    let (Some(node), Some(home)) = (robot.get("home"), build::home(robot)) else { return };
    let distance = home.norm();
    // Placed pushes never start from home, so home may lie within the minimum reach.
    let chained = form(pushes) == Some(PushForm::Chained);
    if distance > max || (chained && distance < min) {
        ledger.fault(
            node,
            format!("home is {distance:.3} m from the base, outside the reach of {min} to {max} m"),
            "move home, or widen the reach; `base: none` states that there is no column",
        );
    }
}

fn form(pushes: &Node) -> Option<PushForm> {
    match pushes.get("form").map(Node::text) {
        None | Some(Some("placed")) => Some(PushForm::Placed),
        Some(Some(_)) => Some(PushForm::Chained),
        Some(None) => None,
    }
}

/// Checks the rules of pushes, and that the tool can touch at least one of `objects`.
fn push_rules(pushes: &Node, objects: &[Node], ledger: &mut Ledger) {
    for (key, turn) in
        [("directions", Some(360.0)), ("grip_yaws_deg", Some(360.0)), ("offsets", None)]
    {
        let items = pushes.get(key).map(Node::items).unwrap_or_default();
        // 180 and -180 degrees are the same direction.
        let wrapped = |x: f64| turn.map_or(x, |turn| x.rem_euclid(turn));
        for (k, node) in items.iter().enumerate() {
            let value = node.number().map(wrapped);
            let same = |other: &Node| value.is_some() && other.number().map(wrapped) == value;
            if let Some(first) = items[..k].iter().position(same) {
                let message = format!("this is the same as item {} of `{key}`", first + 1);
                ledger.fault(node, message, "remove one of the two");
            }
        }
    }
    if let (Some(PushForm::Chained), Some(offsets)) = (form(pushes), pushes.get("offsets")) {
        ledger.fault(
            offsets,
            "chained pushes start from `home`, so they have no offsets",
            "remove `offsets`, or use `form: placed`",
        );
    }
    let heights: Option<Vec<f64>> = objects
        .iter()
        .flat_map(|object| std::iter::once(object).chain(part::parts(object)))
        .map(|solid| Some(part::rise(solid, 0.0)? + shape(solid.get("shape")?)?.height()))
        .collect();
    let highest = heights.and_then(|heights| heights.into_iter().reduce(f64::max));
    let lift = number_or(pushes, "lift", PushRules::LIFT);
    if let (Some(lift), Some(highest)) = (lift, highest)
        && lift >= highest
    {
        ledger.fault(
            pushes.get("lift").or_else(|| objects.first()).unwrap_or(pushes),
            format!("at a lift of {lift} m the tool passes above every object ({highest} m high)"),
            "lower `lift` below the height of the objects",
        );
    }
}
