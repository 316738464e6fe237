//! Construction of a [`Task`] from a checked tree.

use std::path::Path;
use std::sync::Arc;

use crate::asset::node::{Content, Node};
use crate::asset::take::{name_of, number_or, vector};
use crate::asset::text::apart_by_name;
use crate::geometry::Vector;
use crate::{
    scene::{Hand, Joint, Obstacle, Robot, Scene, TableTop, Unknowns},
    task::{Directions, Goal, Offsets, PushForm, PushRules, RobotArm, Task},
};

use super::keep::KEPT_WITHIN;
use super::tools::{costs, tools};
use super::{frictions, goals, joints, keep, levers, obstacles, parts, world_joints};

/// Builds the task; returns `None` if a required value is missing or faulty.
pub(super) fn task(root: &Node, file: &str, arm: Option<Arc<dyn RobotArm>>) -> Option<Task> {
    let stem = || Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut scene = scene(root.get("scene")?)?;
    let goals = Goal::joined(goals::goals(root.get("goal")?, &scene)?);
    goals.first()?;
    let levers = levers::levers(root)?;
    let mut robot = match &arm {
        Some(arm) => standing(root.get("robot")?, &**arm)?,
        None => robot(root.get("robot")?)?,
    };
    // Lever-ups reach close to the base, and most levering tasks state no `base`.
    if levers.is_some() && root.get("robot")?.get("base").is_none() {
        robot.base = 0.0;
        if arm.is_none() && root.get("robot")?.get("reach")?.get("min").is_none() {
            robot.reach_min = 0.0;
        }
    }
    goals.iter().for_each(|goal| scene.let_fall(goal));
    scene.obstacles.extend(body(&robot, arm.as_deref()));
    scene.keep_out = keep::regions(root)?;
    if let Some(keep) = root.get("keep") {
        let within = number_or(keep, "within", KEPT_WITHIN)?;
        for name in keep.get("objects").map(Node::items).unwrap_or_default() {
            let index = scene.object(name.text()?)?;
            scene.objects[index].keep = Some(within);
        }
    }
    Some(Task {
        name: name_of(root).map_or_else(|| apart_by_name(&stem()), str::to_owned),
        description: root.get("description").and_then(Node::text).unwrap_or_default().into(),
        scene,
        unknown: unknown(root)?,
        robot,
        arm,
        tools: tools(root.get("tools")?),
        tool_costs: costs(root.get("tools")?),
        pushes: match root.get("pushes") {
            Some(node) => pushes(node)?,
            None if levers.is_some() => PushRules::none(),
            None => PushRules::default(),
        },
        levers,
        goals,
        robustness: number_or(root, "robustness", Task::ROBUSTNESS)?,
    })
}

/// Returns the unknown properties of the scene.
fn unknown(root: &Node) -> Option<Unknowns> {
    let words = root.get("unknown").map(Node::items).unwrap_or_default();
    words.iter().try_fold(Unknowns::NONE, |so_far, word| so_far.with(word.text()?))
}

/// Builds the scene; returns `None` if a required value is missing or faulty.
pub(super) fn scene(node: &Node) -> Option<Scene> {
    let items = |key| node.get(key).map(Node::items).unwrap_or_default().iter();
    let nodes = node.get("objects").map(Node::items).unwrap_or_default();
    let objects = parts::objects(nodes)?;
    let obstacles: Vec<Obstacle> =
        items("obstacles").map(obstacles::obstacle).collect::<Option<_>>()?;
    let fixed = node.get("obstacles").map(Node::items).unwrap_or_default();
    let moving = |joint| world_joints::moving(joint, nodes, fixed);
    let mut scene = Scene {
        table_friction: match node.get("table") {
            Some(table) => number_or(table, "friction", Scene::FRICTION)?,
            None => Scene::FRICTION,
        },
        table_top: match node.get("table").filter(|table| table.get("size").is_some()) {
            Some(table) => Some(table_top(table)?),
            None => None,
        },
        push_height: match node.get("push_height") {
            Some(share) => Some(share.number()?),
            None => None,
        },
        joints: items("joints")
            .filter(|joint| moving(joint).is_none())
            .map(|node| joints::joint(node, &objects))
            .collect::<Option<_>>()?,
        mounts: items("joints")
            .filter_map(|joint| Some((joint, moving(joint)?)))
            .map(|(joint, object)| world_joints::mount(joint, object, &objects))
            .collect::<Option<_>>()?,
        frictions: items("frictions")
            .map(|node| frictions::friction(node, &objects, &obstacles))
            .collect::<Option<_>>()?,
        obstacles,
        objects,
        ..Scene::default()
    };
    let seams: Vec<Joint> = scene.seams().collect();
    scene.joints.splice(0..0, seams);
    Some(scene.rubbing_all_over())
}

/// Returns the extents of a table with a size.
pub(super) fn table_top(table: &Node) -> Option<TableTop> {
    let size = vector(table.get("size")?)?;
    let middle = match table.get("position") {
        Some(position) => vector(position)?,
        None => Vector::zeros(),
    };
    Some(TableTop { size: [size.x, size.y], middle })
}

/// Returns the maximum force of an arm, or on an object, newtons; the inner `None` if no maximum is
/// stated.
fn max_force(node: &Node) -> Option<Option<f64>> {
    match node.get("max_force") {
        Some(force) => force.number().map(Some),
        None => Some(None),
    }
}

/// Builds the robot: its reach, home, hand, base and force limit.
fn robot(node: &Node) -> Option<Robot> {
    let reach = node.get("reach")?;
    let (hand, base) = (hand(node)?, base(node)?);
    let reach_min = reach_min(node, reach)?;
    Some(Robot {
        home: match node.get("home") {
            Some(_) => home(node)?,
            None => Vector::new(reach_min, 0.0),
        },
        reach_min,
        reach_max: reach.get("max")?.number()?,
        max_force: max_force(node)?,
        hand,
        base,
        travel: number_or(node, "travel", Robot::TRAVEL)?,
    })
}

/// Returns the fixed body of a robot: the foot of its arm, otherwise its column.
fn body(robot: &Robot, arm: Option<&dyn RobotArm>) -> Vec<Obstacle> {
    let foot = arm.map(RobotArm::foot).unwrap_or_default();
    if foot.is_empty() { robot.column().into_iter().collect() } else { foot }
}

/// Returns the hand of a robot; the inner `None` if it has none.
fn hand(robot: &Node) -> Option<Option<Hand>> {
    let usual = Hand::default();
    match robot.get("hand").map(|hand| (hand, hand.text())) {
        None => Some(Some(usual)),
        Some((_, Some(_))) => Some(None),
        Some((hand, None)) => Some(Some(Hand {
            radius: number_or(hand, "radius", usual.radius)?,
            from: match hand.get("from") {
                Some(from) => Some(from.number()?),
                None => None,
            },
        })),
    }
}

/// Returns half the side of the column of a robot, metres.
fn base(robot: &Node) -> Option<f64> {
    let min = robot.get("reach").and_then(|reach| reach.get("min"));
    match robot.get("base").map(|base| (base, base.text())) {
        None => Some(Robot::usual_base(min.and_then(Node::number))),
        Some((_, Some(_))) => Some(0.0),
        Some((base, None)) => base.number(),
    }
}

/// Returns the smallest reach of a robot: the stated one, or what its column and hand need, metres.
pub(super) fn reach_min(robot: &Node, reach: &Node) -> Option<f64> {
    let usual = || Some(Robot::usual_reach_min(base(robot)?, hand(robot)?));
    reach.get("min").map_or_else(usual, Node::number)
}

/// Returns the robot that represents an arm: its reach is the annulus in which the arm can hold
/// tools.
fn standing(node: &Node, arm: &dyn RobotArm) -> Option<Robot> {
    let [near, far] = arm.annulus().distances();
    Some(Robot {
        home: arm.home(),
        max_force: max_force(node)?,
        travel: number_or(node, "travel", Robot::TRAVEL)?,
        ..Robot::reaching(near, far)
    })
}

/// Returns the `home` of a robot, metres.
pub(super) fn home(robot: &Node) -> Option<Vector> {
    vector(robot.get("home")?)
}

fn pushes(node: &Node) -> Option<PushRules> {
    let usual = PushRules::default();
    let max_count = number_or(node, "max_count", PushRules::MAX_COUNT as f64)?;
    Some(PushRules {
        form: match node.get("form").map(Node::text) {
            None | Some(Some("placed")) => PushForm::Placed,
            Some(Some(_)) => PushForm::Chained,
            Some(None) => return None,
        },
        directions: match node.get("directions") {
            None => usual.directions,
            Some(node) => directions(node)?,
        },
        offsets: match node.get("offsets") {
            None => usual.offsets,
            Some(list) => Offsets::List(numbers(list)?),
        },
        grip_yaws: match node.get("grip_yaws_deg") {
            None => usual.grip_yaws,
            Some(list) => numbers(list)?.into_iter().map(f64::to_radians).collect(),
        },
        length: number_or(node, "length", usual.length)?,
        speed: number_or(node, "speed", usual.speed)?,
        // The check has already ensured that the value is whole and in range.
        max_count: max_count as usize,
        tool_changes: match node.get("tool_changes") {
            None => usual.tool_changes,
            Some(count) => Some(count.number()? as usize),
        },
        lift: number_or(node, "lift", usual.lift)?,
    })
}

fn directions(node: &Node) -> Option<Directions> {
    match &node.content {
        Content::Text(_) => Some(Directions::Principal),
        Content::Whole(count) => Some(Directions::Count(usize::try_from(*count).ok()?)),
        Content::List(_) => {
            Some(Directions::List(numbers(node)?.into_iter().map(f64::to_radians).collect()))
        }
        _ => None,
    }
}

fn numbers(list: &Node) -> Option<Vec<f64>> {
    list.items().iter().map(Node::number).collect()
}
