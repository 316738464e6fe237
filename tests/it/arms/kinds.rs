//! Kinds of arms: three to seven joints, lifts, grippers, limits written in unusual ways, and bases
//! away from the origin.

use std::fs;

use pushplan::Task;
use pushplan::asset::PlanFile;
use pushplan_arm::Arm;
use pushplan_report::task_stage;
use serde_json::json;

use super::{ROBOT, TASK, URDF, at, folder, solve, write};
use crate::program::{run, stderr};

/// Returns the element of a joint and of its link.
fn joint(name: &str, kind: &str, [xyz, axis]: [&str; 2], limits: &str) -> String {
    format!(
        "<link name=\"{name}\"/><joint name=\"{name}\" type=\"{kind}\"><parent link=\"BEFORE\"/>\
         <child link=\"{name}\"/><origin xyz=\"{xyz}\"/><axis xyz=\"{axis}\"/>\
         <limit {limits}/></joint>"
    )
}

/// Returns a serial arm, with each joint on the link before it.
fn arm(joints: &[(&str, &str, [&str; 2], &str)]) -> String {
    let mut text = "<robot name=\"kind\"><link name=\"base\"/>".to_owned();
    let mut before = "base";
    for (name, kind, at, limits) in joints {
        text += &joint(name, kind, *at, limits).replace("BEFORE", before);
        before = name;
    }
    text + "</robot>"
}

/// Solves the task of a folder and returns its plan, which must also pass its check.
fn solved(folder: &tempfile::TempDir) -> PlanFile {
    let folder = folder.path();
    let output = solve(folder);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let path = at(folder, "out/push.plan.json");
    let output = run(&["verify", &path, "--replays", "0"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    PlanFile::load(&path).expect("a plan")
}

/// Creates a folder with an arm and the task of its robot; the can stands at `from` and must get to
/// `to`.
fn pushing(urdf: &str, robot: &str, from: &str, to: &str) -> tempfile::TempDir {
    let made = folder(robot);
    write(made.path(), "six.urdf", urdf);
    let task = TASK.replace("ROBOT", robot).replace("[0.45, 0.1]", from);
    write(made.path(), "push.yaml", &task.replace("[0.55, 0.1]", to));
    made
}

const TURN: &str = "lower=\"-2.8\" upper=\"2.8\" velocity=\"3\"";

/// Five joints of a small arm whose last axis is vertical when the tool points down. Angles are
/// rounded, as in files of such arms.
fn five() -> String {
    arm(&[
        ("pan", "revolute", ["0 0 0.10", "0 0 1"], "lower=\"-1.9\" upper=\"1.9\" velocity=\"3\""),
        ("lift", "revolute", ["0 0 0.05", "0 1 0.00003"], TURN),
        ("elbow", "revolute", ["0 0 0.28", "0.00002 1 0"], TURN),
        ("flex", "revolute", ["0 0 0.26", "0 1 0"], TURN),
        ("roll", "revolute", ["0 0 0.05", "0.00004 0 1"], TURN),
    ])
}

#[test]
fn arms_of_three_to_seven_joints_carry_plans_out() {
    let scara = arm(&[
        ("one", "revolute", ["0 0 0.4", "0 0 1"], TURN),
        ("two", "revolute", ["0.35 0 0", "0 0 1"], TURN),
        ("down", "prismatic", ["0.3 0 0", "0 0 -1"], "lower=\"0\" upper=\"0.35\" velocity=\"0.5\""),
        ("roll", "revolute", ["0 0 0", "0 0 1"], TURN),
        ("tool0", "fixed", ["0 0 0", "0 0 1"], ""),
    ])
    .replace(
        "<child link=\"tool0\"/><origin xyz",
        "<child link=\"tool0\"/><origin rpy=\"3.141592653589793 0 0\" xyz",
    );
    // The tool of this arm stays at one height, so it goes around the can.
    let level = scara
        .replace("name=\"down\" type=\"prismatic\"", "name=\"down\" type=\"fixed\"")
        .replace("0 0 0.4", "0 0 0.10202");
    let lifted = five().replace("<parent link=\"base\"/>", "<parent link=\"post\"/>").replace(
        "<link name=\"base\"/>",
        "<link name=\"base\"/><link name=\"post\"/><joint name=\"post\" type=\"prismatic\">\
             <parent link=\"base\"/><child link=\"post\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"0\" upper=\"0.3\" velocity=\"0.1\"/></joint>",
    );
    let mount = "tool_mount: {length: 0.1}";
    for (urdf, flange, count) in [
        (five(), "flange: roll", 5),
        (scara, "flange: tool0", 4),
        (level, "flange: tool0", 3),
        (lifted, "flange: roll", 6),
    ] {
        let robot = format!("{{urdf: six.urdf, {flange}, {mount}}}");
        let made = pushing(&urdf, &robot, "[0.38, 0.02]", "[0.44, 0.02]");
        let plan = solved(&made);
        let joints = plan.joints.expect("a motion of joints");
        assert_eq!(joints.joints.len(), count);
        assert!(joints.points.iter().all(|point| point.accelerations.len() == count));
    }
}

#[test]
fn an_arm_that_cannot_hold_a_tool_says_what_would_help() {
    let check = |urdf: &str, robot: &str| {
        let made = pushing(urdf, robot, "[0.38, 0.02]", "[0.44, 0.02]");
        let output = run(&["check", &at(made.path(), "push.yaml")]);
        (output.status.code(), stderr(&output))
    };
    let plain = "{urdf: six.urdf, flange: roll, tool_mount: {length: 0.1}}";
    // The last link's frame is turned, so that another axis points out of it.
    let turned = five().replace("</robot>", "")
        + "<link name=\"hand\"/><joint name=\"hand\" type=\"fixed\"><parent link=\"roll\"/>\
           <child link=\"hand\"/><origin rpy=\"1.5707963 0 0\"/></joint></robot>";
    let (code, text) = check(&turned, &plain.replace("roll", "hand"));
    assert_eq!(code, Some(3), "{text}");
    let (_, advice) = text.split_once("write `tool_mount: {axis: ").expect("a remedy");
    let axis = advice.split('}').next().expect("an axis");
    let robot =
        format!("{{urdf: six.urdf, flange: hand, tool_mount: {{length: 0.1, axis: {axis}}}}}");
    assert_eq!(check(&turned, &robot), (Some(0), String::new()));
    // Without the last joint, position and rotation depend on each other.
    let (code, text) = check(&five(), &plain.replace("roll", "flex"));
    assert!(code == Some(3) && text.contains("with 4 joints this arm cannot choose"), "{text}");
}

#[test]
fn limits_that_stand_for_none_are_none_and_soft_limits_count() {
    let limits = |joint: &str, text: &str| {
        let own = format!("name=\"{joint}\"");
        let begin = URDF.find(&own).expect("the joint");
        let limit = begin + URDF[begin..].find("<limit").expect("its limit");
        let end = limit + URDF[limit..].find("/>").expect("its end") + 2;
        let urdf = [&URDF[..limit], text, &URDF[end..]].concat();
        let made = folder(ROBOT);
        write(made.path(), "six.urdf", &urdf);
        let task =
            Task::load(made.path().join("push.yaml")).map_err(|faults| faults.to_string())?;
        let arm = task.arm.as_deref().and_then(|arm| arm.downcast::<Arm>()).expect("an arm");
        let found = arm.joints.iter().find(|one| one.name == joint).expect("the joint");
        Ok::<_, String>((found.limits, found.max_speed))
    };
    for none in ["999999", "1e16", "inf", "Infinity", "1e400"] {
        let both = format!("<limit lower=\"-{none}\" upper=\"{none}\" velocity=\"{none}\"/>");
        assert_eq!(limits("turn", &both), Ok((None, None)), "{none}");
        // Limits of a continuous joint mean nothing.
        assert_eq!(limits("wrist3", &both), Ok((None, None)), "{none}");
        let one = format!("<limit lower=\"-{none}\" upper=\"2.5\" velocity=\"2\"/>");
        let (found, _) = limits("turn", &one).expect("an arm");
        let [low, high] = found.expect("limits");
        assert!(high == 2.5 && low < -3.2 && low > -20.0, "{low}");
    }
    let soft =
        "<safety_controller soft_lower_limit=\"-1.5\" soft_upper_limit=\"9\" k_velocity=\"1\"/>";
    let hard = "<limit lower=\"-2\" upper=\"2\" velocity=\"1\"/>";
    assert_eq!(limits("turn", &(hard.to_owned() + soft)), Ok((Some([-1.5, 2.0]), Some(1.0))));
    let nan = limits("turn", "<limit lower=\"nan\" upper=\"2\"/>").expect_err("a fault");
    assert!(nan.contains("`lower` is not a number"), "{nan}");
}

#[test]
fn files_of_macros_are_named_as_such_whatever_their_name() {
    let macros = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"arm\">\
                  <xacro:include filename=\"arm.xacro\"/><link name=\"world\"/></robot>";
    let undeclared = macros.replace(" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"", "");
    let expression = URDF.replacen("xyz=\"0 0 0.4\"", "xyz=\"0 0 ${length}\"", 1);
    for text in [macros, &undeclared, &expression] {
        for name in ["arm.urdf.xacro", "arm.xacro", "arm.urdf", "arm.xml"] {
            let made = folder(&ROBOT.replace("six.urdf", name));
            write(made.path(), name, text);
            let output = run(&["check", &at(made.path(), "push.yaml")]);
            assert_eq!(output.status.code(), Some(3));
            assert!(stderr(&output).contains("expand its macros first"), "{}", stderr(&output));
        }
    }
    // An expanded file may still declare the namespace.
    let made = folder(ROBOT);
    let declared = URDF.replace("<robot ", "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" ");
    write(made.path(), "six.urdf", &declared);
    assert!(Task::load(made.path().join("push.yaml")).is_ok());
}

#[test]
fn an_arm_stands_at_its_base_pose() {
    let robot =
        ROBOT.replace("tool_mount", "base_pose: {position: [0.2, -0.6], yaw_deg: 90}, tool_mount");
    let made = pushing(URDF, &robot, "[0.25, -0.1]", "[0.25, -0.02]");
    let plan = solved(&made);
    let arm = plan.task.arm.as_deref().and_then(|arm| arm.downcast::<Arm>()).expect("an arm");
    assert!((arm.base.position.x - 0.2).abs() < 1e-12 && (arm.places.centre.y + 0.6).abs() < 1e-9);
    // Pictures show the annulus of the arm.
    let annulus = plan.task.annulus();
    assert_eq!((annulus.centre, annulus.radii), (arm.places.centre, arm.places.ring));
    assert_eq!(task_stage(&plan.task)["base"], json!([20_000, -60_000]));
    // Beside this base, out of its reach although near the origin.
    let away = plan.task.arm.as_deref().expect("an arm");
    assert!(!away.allows(pushplan::Vector::new(0.2, 0.6), 0.0));
    let own = plan.task.scene.obstacles.iter().find(|one| one.is_robot()).expect("a foot");
    assert!((own.pose.position - pushplan::Vector::new(0.2, -0.6)).norm() < 1e-9);
}

#[test]
fn a_gripper_before_the_flange_is_part_of_the_arm() {
    let finger = |name: &str, follows: &str| {
        format!(
            "<link name=\"{name}\"><collision><geometry><box size=\"0.01 0.01 0.04\"/></geometry>\
             </collision></link><joint name=\"{name}\" type=\"prismatic\"><parent link=\"hand\"/>\
             <child link=\"{name}\"/><axis xyz=\"0 1 0\"/>\
             <limit lower=\"0.02\" upper=\"0.05\" velocity=\"1\"/>{follows}</joint>"
        )
    };
    let fingers = finger("left", "")
        + &finger("right", "<mimic joint=\"left\" multiplier=\"-1\" offset=\"0.001\"/>");
    let made = folder(ROBOT);
    write(made.path(), "six.urdf", &URDF.replace("</robot>", &(fingers + "</robot>")));
    let task = Task::load(made.path().join("push.yaml")).expect("sound");
    let arm = task.arm.as_deref().and_then(|arm| arm.downcast::<Arm>()).expect("an arm");
    let hand = arm.bodies.last().expect("a body");
    let mut middles: Vec<f64> = hand
        .solids
        .iter()
        .map(|solid| solid.points.iter().map(|point| point.y).sum::<f64>() / 8.0)
        .collect();
    middles.sort_by(f64::total_cmp);
    assert!(middles.len() == 2 && (middles[0] + 0.019).abs() < 1e-9, "{middles:?}");
    assert!((middles[1] - 0.02).abs() < 1e-9, "{middles:?}");
}

#[test]
fn trajectories_keep_the_limits_that_the_task_states() {
    let limits = "joint_limits: {acceleration: 4, jerk: [60, 60, 60, 60, 60, 60]}, tool_mount";
    let made = folder(&ROBOT.replace("tool_mount", limits));
    let plan = solved(&made);
    let path = plan.joints.expect("a motion of joints");
    let mut largest = [0.0_f64; 2];
    let mut last: Option<Vec<[f64; 4]>> = None;
    for point in 0..path.points.len() - 1 {
        for share in [0.0, 0.2, 0.5, 0.8, 1.0] {
            for state in path.derivatives(point, share) {
                largest = [largest[0].max(state[2].abs()), largest[1].max(state[3].abs())];
            }
        }
        // Accelerations are continuous.
        for (before, after) in last.iter().flatten().zip(path.derivatives(point, 0.0)) {
            assert!((before[2] - after[2]).abs() < 1e-9);
        }
        last = Some(path.derivatives(point, 1.0));
    }
    assert!(largest[0] <= 4.0 * 1.001 && largest[1] <= 60.0 * 1.001, "{largest:?}");
    assert!(largest[0] > 1.0 && largest[1] > 20.0, "{largest:?}");
}

#[test]
fn a_search_finds_the_way_around_an_obstacle() {
    // A high wall between both ends of the arm's motion, and a beam over the folded path.
    let walls =
        "  obstacles:\n    - {name: wall, size: [0.6, 0.03, 0.5], position: [0.5, -0.08]}\nrobot";
    let made = folder(ROBOT);
    let home = "home: [-0.6, 0.5, 1.4, 0, 1.2, 0], tool_mount";
    let text = TASK.replace("ROBOT", &ROBOT.replace("tool_mount", home)).replace("robot", walls);
    write(made.path(), "push.yaml", &text);
    let plan = solved(&made);
    let path = plan.joints.expect("a motion of joints");
    assert!(path.pushes[0][0] > 16, "{:?}", path.pushes);
    // The path does not depend on the time at which it is made.
    let first = fs::read(made.path().join("out/push.plan.json")).expect("a plan");
    solved(&made);
    assert_eq!(first, fs::read(made.path().join("out/push.plan.json")).expect("a plan"));
}
