//! Rules that span several keys of a task of levering: what no single value can break.

use crate::asset::fault::did_you_mean;
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, unique_names};
use crate::asset::task::obstacle_of;
use crate::asset::{prism, task};
use crate::geometry::{Pose, Solid, Vector, common_area};
use crate::scene::{Blade, Obstacle, Plate, carries};

use super::build;

/// Bodies may sink into each other by this much before it is a fault, metres: the rounding of
/// sizes written in tenths of millimetres and turned by degrees.
const SLACK: f64 = 1e-4;

/// Notes every fault that lies between values.
pub(super) fn check(root: &Node, ledger: &mut Ledger) {
    let empty = Node { id: root.id, content: crate::asset::node::Content::Nothing };
    let section = |key| root.get(key).unwrap_or(&empty);
    let scene = section("scene");
    let items = |key| scene.get(key).map(Node::items).unwrap_or_default();
    let (objects, obstacles) = (items("objects"), items("obstacles"));
    unique_names(objects.iter().chain(obstacles), "bodies", ledger);
    for object in objects {
        prism::check(object.get("shape"), ledger);
        for part in object.get("parts").map(Node::items).unwrap_or_default() {
            prism::check(part.get("shape"), ledger);
        }
        heights(object, ledger);
    }
    task::check_unknown(section("unknown"), scene, ledger);
    task::check_robot(section("robot"), &empty, ledger);
    task::check_tools(section("tools"), ledger);
    task::check_free(section("tools"), ledger);
    ranges(section("levers"), ledger);
    if let Some(pushes) = root.get("pushes") {
        follow_up(pushes, section("goal"), ledger);
    }
    goal(section("goal"), objects, obstacles, ledger);
    // What lies where means little while something is wrong with the bodies themselves.
    if ledger.sound().is_ok() {
        bodies(objects, obstacles, ledger);
    }
}

fn heights(object: &Node, ledger: &mut Ledger) {
    match (object.get("clearance"), object.get("z")) {
        (None, None) => {
            let advice = "6 mm of feet are `clearance: 0.006`; `z` alone is a plate on obstacles";
            ledger.fault(object, "this object has neither `clearance` nor `z`", advice);
        }
        (Some(clearance), Some(node)) => {
            if let (Some(clearance), Some(z)) = (clearance.number(), node.number())
                && z < clearance
            {
                let message =
                    format!("the underside is at {z} m, but {clearance} m are free below");
                ledger.fault(node, message, "raise `z`, or lower the clearance");
            }
        }
        _ => {}
    }
}

fn ranges(levers: &Node, ledger: &mut Ledger) {
    for key in ["depth", "angle_deg"] {
        let Some(node) = levers.get(key) else { continue };
        if let [low, high] = node.items()
            && let (Some(low), Some(high)) = (low.number(), high.number())
            && low > high
        {
            let message = format!("the smallest, {low}, is above the largest, {high}");
            ledger.fault(node, message, "swap them");
        }
    }
    let pivots = levers.get("pivot").map(Node::items).unwrap_or_default();
    for (k, node) in pivots.iter().enumerate() {
        if pivots[..k].iter().any(|before| before.content == node.content) {
            ledger.fault(node, "this pivot is given twice", "remove one of the two");
        }
    }
}

/// Pushes that follow a lever-up bring its plate somewhere, one by one from above.
fn follow_up(pushes: &Node, goal: &Node, ledger: &mut Ledger) {
    task::check_pushes(pushes, &[], ledger);
    if let Some(node) = pushes.get("form").filter(|form| form.text() == Some("chained")) {
        let message = "pushes that follow a lever-up are placed, none goes on from `home`";
        ledger.fault(node, message, "remove `form`");
    }
    if goal.get("object").is_some() && goal.get("position").is_none() {
        let message = "pushes may follow, but the goal names no place to push to";
        ledger.fault(pushes, message, "add `position` and `tolerance` to the goal, or remove this");
    }
}

fn goal(goal: &Node, objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let demands = ["outside", "raised", "flipped", "position"];
    if goal.get("object").is_some() && demands.iter().all(|key| goal.get(key).is_none()) {
        let advice = "add `outside`, `raised`, `flipped`, or `position` with `tolerance`";
        ledger.fault(goal, "the goal asks for nothing", advice);
    }
    match (goal.get("position"), goal.get("tolerance")) {
        (Some(node), None) => {
            ledger.fault(node, "a position without a tolerance", "add `tolerance`, in metres");
        }
        (None, Some(node)) => {
            ledger.fault(node, "a tolerance without a position", "add `position`, or remove it");
        }
        _ => {}
    }
    known(goal.get("object"), "object", (objects, obstacles), ledger);
    known(goal.get("outside"), "obstacle", (obstacles, objects), ledger);
}

/// Notes a name that none of `known` has.
fn known(
    node: Option<&Node>,
    what: &str,
    (known, others): (&[Node], &[Node]),
    ledger: &mut Ledger,
) {
    let Some((node, name)) = node.and_then(|node| Some((node, node.text()?))) else { return };
    if known.iter().any(|body| name_of(body) == Some(name)) {
        return;
    }
    let message = match others.iter().any(|body| name_of(body) == Some(name)) {
        true => format!("`{name}` is not an {what}"),
        false => format!("no {what} is called `{name}`"),
    };
    ledger.fault(node, message, did_you_mean(name, known.iter().filter_map(name_of)));
}

/// What shares space, and what nothing holds.
fn bodies(objects: &[Node], obstacles: &[Node], ledger: &mut Ledger) {
    let plates: Vec<Option<Plate>> = objects.iter().map(build::plate).collect();
    let blocks: Vec<Option<Obstacle>> = obstacles.iter().map(obstacle_of).collect();
    for (k, (node, plate)) in objects.iter().zip(&plates).enumerate() {
        let Some(plate) = plate else { continue };
        let place = node.get("position").unwrap_or(node);
        let own = plate.solids();
        let earlier = plates[..k].iter().flatten().map(|other| (&other.name, other.solids()));
        let fixed = blocks.iter().flatten().map(|block| (&block.name, vec![block.solid()]));
        for (name, others) in earlier.chain(fixed) {
            let deep = |a: &Solid| others.iter().any(|b| a.depth(b) > SLACK);
            if own.iter().any(deep) {
                let message = format!("`{}` overlaps `{name}`", plate.name);
                let advice = "move one of them, or mind `z`; bodies may touch but not share space";
                ledger.fault(place, message, advice);
            }
        }
        if !plate.has_feet() && !is_held(plate, &blocks) {
            let message = format!("nothing holds `{}` at {} m", plate.name, micrometres(plate.z));
            let advice = "obstacles below it must end at `z` on both sides of its centre of mass; \
                          or let it stand on feet: leave `z` out";
            ledger.fault(node.get("z").unwrap_or(place), message, advice);
        }
    }
}

/// Whether blocks that end at its underside carry a plate.
fn is_held(plate: &Plate, blocks: &[Option<Obstacle>]) -> bool {
    let mut points: Vec<Vector> = Vec::new();
    let below = |block: &&Obstacle| (block.z + block.size[2] - plate.z).abs() <= SLACK;
    for block in blocks.iter().flatten().filter(below) {
        let [x, y] = [0.5 * block.size[0], 0.5 * block.size[1]];
        let local = |corner: [f64; 2]| {
            let at: Pose = plate.pose.inverse() * block.pose;
            at.point(Vector::new(corner[0], corner[1]))
        };
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(local);
        points.extend(common_area(plate.corners(), &corners));
    }
    points.len() >= 3 && carries(&points).is_some()
}

/// Notes tools that have no blade, and blades that do not fit below the edge.
pub(super) fn blades(
    root: &Node,
    library: &ToolLibrary,
    ledger: &mut Ledger,
    unknown: impl Fn(&str, &ToolLibrary) -> (String, String),
) {
    let wanted = root.get("goal").and_then(|goal| goal.get("object")?.text());
    let objects = root.get("scene").and_then(|scene| scene.get("objects"));
    let object = objects.map(Node::items).unwrap_or_default().iter();
    let clearance = object
        .filter(|object| wanted.is_some() && name_of(object) == wanted)
        .find_map(|object| object.get("clearance").or_else(|| object.get("z"))?.number());
    let fault = |blade: &Blade, clearance: f64| {
        let (name, mm) = (wanted.unwrap_or_default(), |metres: f64| 1e3 * metres);
        let blade = mm(blade.thickness);
        (blade > mm(clearance) + 1e-6).then(|| {
            let free = mm(clearance);
            format!("its blade is {blade} mm thick, but only {free} mm are free below `{name}`")
        })
    };
    let Some(tools) = root.get("tools") else { return };
    let levering = |name: &str| library.get(name).and_then(|tool| tool.blade());
    let pushing = |name: &str| library.get(name).is_some_and(|tool| tool.pushes());
    let named = || tools.items().iter().filter_map(Node::text);
    if root.get("pushes").is_some() && tools.text().is_none() {
        if named().any(pushing) && named().all(|name| levering(name).is_none()) {
            ledger.fault(tools, "none of these tools has a blade", "name one that levers, too");
        } else if named().all(|name| levering(name).is_some()) {
            let message = "pushes may follow, but none of these tools pushes";
            ledger.fault(tools, message, "name one that pushes, too, or remove `pushes`");
        }
    }
    for node in tools.items() {
        let Some(name) = node.text() else { continue };
        match (levering(name), clearance) {
            (None, _) if root.get("pushes").is_some() && pushing(name) => {}
            (None, _) => {
                let (message, advice) = unknown(name, library);
                ledger.fault(node, message, advice);
            }
            (Some(blade), Some(clearance)) => {
                if let Some(message) = fault(&blade, clearance) {
                    let message = format!("`{name}` does not fit: {message}");
                    ledger.fault(node, message, "name a thinner tool, or mind the clearance");
                }
            }
            (Some(_), None) => {}
        }
    }
    if let (Some(_), Some(clearance)) = (tools.text(), clearance)
        && let Some((name, thinnest)) = library
            .blades()
            .iter()
            .filter_map(|tool| Some((&tool.name, tool.blade()?)))
            .min_by(|(_, a), (_, b)| a.thickness.total_cmp(&b.thickness))
        && let Some(message) = fault(&thinnest, clearance)
    {
        let message = format!("no tool fits, the thinnest is `{name}`: {message}");
        ledger.fault(tools, message, "add a thinner tool, or mind the clearance");
    }
}

/// A height without what adding lengths in binary leaves behind.
fn micrometres(metres: f64) -> f64 {
    (metres * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_is_held_by_what_ends_below_it_on_both_sides() {
        let block = |x: f64, top: f64| Obstacle {
            name: "standoff".into(),
            size: [0.01, 0.06, top],
            pose: Pose::new(x, 0.0, 0.0),
            z: 0.0,
            friction: 0.5,
        };
        let corner = |x: f64, y: f64| Vector::new(x, y);
        let corners = vec![
            corner(-0.04, -0.03),
            corner(0.04, -0.03),
            corner(0.04, 0.03),
            corner(-0.04, 0.03),
        ];
        let plate = Plate {
            name: "board".into(),
            slabs: vec![crate::scene::Slab { corners, bottom: 0.0, height: 0.002 }],
            mass: 0.03,
            friction: 0.4,
            clearance: 0.006,
            pose: Pose::default(),
            z: 0.01,
        };
        let held = |blocks: &[Obstacle]| {
            is_held(&plate, &blocks.iter().cloned().map(Some).collect::<Vec<_>>())
        };
        assert!(held(&[block(-0.03, 0.01), block(0.03, 0.01)]));
        assert!(!held(&[block(0.02, 0.01), block(0.03, 0.01)]), "both on one side");
        assert!(!held(&[block(-0.03, 0.01), block(0.03, 0.009)]), "one is too low");
        assert_eq!(plate.solids()[0].lowest(), plate.z);
    }
}
