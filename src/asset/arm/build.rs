//! Construction of a robot's arm from its keys.

use std::path::Path;
use std::sync::Arc;

use serde_json::{Number, Value as Json};

use super::spec::AXES;
use crate::asset::node::{Content, Node};
use crate::asset::strict::Ledger;
use crate::asset::take::{angle, number_or, vector};
use crate::geometry::{Pose, Pose3};
use crate::scene::Robot;
use crate::task::{ArmRefusal, ArmSource, PushRules, RobotArm, StatedArm, read_arm};

/// Default distance from the flange to the tool's underside, metres: the length of a gripper.
const LENGTH: f64 = 0.15;

/// Keys whose values the arm itself provides.
const OWN: [&str; 3] = ["reach", "hand", "base"];

/// Keys that are valid only with an arm.
const OF_URDF: [&str; 4] = ["flange", "tool_mount", "base_pose", "joint_limits"];

/// Reports inconsistent keys of a robot; returns `true` if the robot is an arm.
pub(in crate::asset) fn check(robot: &Node, ledger: &mut Ledger) -> bool {
    let [urdf, arm] = ["urdf", "arm"].map(|key| robot.get(key));
    let Some(which) = urdf.or(arm) else {
        if let Some(base) = former_base_pose(robot) {
            let message = "`base` states where an arm stands, but the task has no arm";
            let advice = "add `urdf`, the file of the arm; without an arm, `base` is a number";
            ledger.fault(base, message, advice);
        }
        for (key, node) in OF_URDF.map(|key| (key, robot.get(key))) {
            if let Some(node) = node {
                let message = format!("`{key}` is a key of an arm, but the task has no arm");
                ledger.fault(node, message, "add `urdf`, the file of the arm");
            }
        }
        return false;
    };
    if let (Some(_), Some(arm)) = (urdf, arm) {
        ledger.fault(arm, "`urdf` and `arm` both define the arm", "keep one of them");
    }
    let inside = |key: &&&str| urdf.is_none() && robot.get(key).is_some();
    let former = urdf.is_some() && former_base_pose(robot).is_some();
    if let Some(base) = robot.get("base_pose").filter(|_| former) {
        ledger.fault(base, "`base` and `base_pose` are the same", "remove `base`");
    }
    let stated = |key: &&&str| robot.get(key).is_some() && !(former && **key == "base");
    for key in OWN.iter().filter(stated) {
        let message = format!("`{key}` is already defined by the arm");
        let advice = match *key {
            "base" => "remove `base`; `base_pose` states where the arm stands".to_owned(),
            _ => format!("remove `{key}`"),
        };
        ledger.fault(robot.get(key).unwrap_or(which), message, advice);
    }
    for key in OF_URDF.iter().chain(&["home"]).filter(inside) {
        let message = format!("`{key}` is already defined by `arm`");
        ledger.fault(robot.get(key).unwrap_or(which), message, format!("remove `{key}`"));
    }
    if let Some(urdf) = urdf.filter(|_| robot.get("flange").is_none()) {
        let advice = "add `flange`, the link on which tools are mounted, with its z axis pointing \
                      out of it (or state `tool_mount: {axis: x}`)";
        ledger.fault(urdf, "an arm needs a `flange`", advice);
    }
    true
}

/// Returns the value of `base` that states a pose, which is now `base_pose`.
fn former_base_pose(robot: &Node) -> Option<&Node> {
    robot.get("base").filter(|node| matches!(node.content, Content::Map(_)))
}

/// Returns the arm of a robot whose task is in `file`; `None` if there is no arm, or if it is
/// faulty, with faults reported.
pub(in crate::asset) fn arm(
    robot: &Node,
    pushes: Option<&Node>,
    file: &str,
    ledger: &mut Ledger,
) -> Option<Arc<dyn RobotArm>> {
    let which = robot.get("urdf").or(robot.get("arm"))?;
    let source = match robot.get("urdf") {
        Some(urdf) => urdf_of(robot, urdf.text()?, file),
        None => ArmSource::Saved(json(which)),
    };
    let home = robot.get("home").map(|home| {
        home.items().iter().map(|one| one.number().unwrap_or(f64::NAN)).collect::<Vec<f64>>()
    });
    let lift = match pushes {
        Some(pushes) => number_or(pushes, "lift", PushRules::LIFT)?,
        None => PushRules::LIFT,
    };
    let travel = number_or(robot, "travel", Robot::TRAVEL)?;
    match read_arm(&StatedArm { source, home, lift, travel }) {
        Ok(arm) => Some(arm),
        Err(ArmRefusal { message, advice, at_home }) => {
            let place = robot.get("home").filter(|_| at_home).unwrap_or(which);
            ledger.fault(place, message, advice);
            None
        }
    }
}

fn urdf_of<'a>(robot: &'a Node, urdf: &str, file: &str) -> ArmSource<'a> {
    let number = |node: Option<&Node>, key: &str, default: f64| {
        node.and_then(|node| number_or(node, key, default)).unwrap_or(default)
    };
    let turn =
        |node: Option<&Node>| node.and_then(|node| angle(node, "yaw_deg", 0.0)).unwrap_or(0.0);
    let base = robot.get("base_pose").or_else(|| former_base_pose(robot));
    let mount = robot.get("tool_mount");
    let position = base.and_then(|base| vector(base.get("position")?)).unwrap_or_default();
    let stand = Pose { position, heading: turn(base) };
    let axis = mount.and_then(|mount| mount.get("axis")?.text()).unwrap_or("z");
    let rates = |key: &str| match robot.get("joint_limits").and_then(|limits| limits.get(key)) {
        None => Vec::new(),
        Some(limit) => match limit.number() {
            Some(number) => vec![number],
            None => limit.items().iter().filter_map(Node::number).collect(),
        },
    };
    ArmSource::Urdf {
        path: Path::new(file).with_file_name("").join(urdf),
        flange: robot.get("flange").and_then(Node::text).unwrap_or(""),
        base: Pose3::upright(stand, number(base, "height", 0.0)),
        length: number(mount, "length", LENGTH),
        yaw: turn(mount),
        axis: AXES.iter().position(|word| *word == axis).unwrap_or(2),
        accelerations: rates("acceleration"),
        jerks: rates("jerk"),
    }
}

fn json(node: &Node) -> Json {
    match &node.content {
        Content::Nothing => Json::Null,
        Content::Switch(value) => Json::Bool(*value),
        Content::Whole(value) => i64::try_from(*value).map_or(Json::Null, Json::from),
        Content::Number(value) => Number::from_f64(*value).map_or(Json::Null, Json::Number),
        Content::Text(text) => Json::String(text.clone()),
        Content::List(items) => Json::Array(items.iter().map(json).collect()),
        Content::Map(pairs) => {
            let pair = |(key, value): &(Node, Node)| {
                (key.text().unwrap_or_default().to_owned(), json(value))
            };
            Json::Object(pairs.iter().map(pair).collect())
        }
    }
}
