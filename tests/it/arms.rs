//! Robot arms: their files, their limits, and plans with joint trajectories.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value as Json;
use tempfile::TempDir;

use pushplan::asset::PlanFile;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{Shape, Task, Tool, Vector};
use pushplan::{
    outcome::{Reason, Warning},
    scene::{ArmFault, Situation},
};

use crate::ROOT;
use crate::mujoco_python::python;
use crate::program::{run, stderr};

mod files;
mod foot;
mod kinds;

/// Six joints: rotation of the base, shoulder, elbow, and a wrist with three joints.
const URDF: &str = r#"<robot name="six">
  <link name="foot"><collision><geometry><cylinder radius="0.06" length="0.1"/></geometry>
    <origin xyz="0 0 0.05"/></collision></link>
  <link name="trunk"><collision><geometry><sphere radius="0.06"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.2"/><geometry><box size="0.08 0.08 0.4"/></geometry>
    </collision></link>
  <link name="lower"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.06 0.06 0.2"/></geometry>
    </collision></link>
  <link name="roll"/>
  <link name="pitch"><collision><geometry><sphere radius="0.04"/></geometry></collision></link>
  <link name="hand"/>
  <link name="tool0"/>
  <link name="finger"/>
  <joint name="turn" type="revolute"><parent link="foot"/><child link="trunk"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="2"/></joint>
  <joint name="shoulder" type="revolute"><parent link="trunk"/><child link="upper"/>
    <axis xyz="0 1 0"/><limit lower="-2.2" upper="2.2" velocity="2"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/>
    <origin xyz="0 0 0.4"/><axis xyz="0 1 0"/><limit lower="-2.7" upper="2.7" velocity="2"/></joint>
  <joint name="wrist1" type="revolute"><parent link="lower"/><child link="roll"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 0 1"/><limit lower="-3.1" upper="3.1" velocity="3"/></joint>
  <joint name="wrist2" type="revolute"><parent link="roll"/><child link="pitch"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 1 0"/><limit lower="-2.5" upper="2.5" velocity="3"/></joint>
  <joint name="wrist3" type="continuous"><parent link="pitch"/><child link="hand"/>
    <axis xyz="0 0 1"/><limit effort="1" velocity="3"/></joint>
  <joint name="mount" type="fixed"><parent link="hand"/><child link="tool0"/>
    <origin xyz="0 0 0.08"/></joint>
  <joint name="grip" type="prismatic"><parent link="tool0"/><child link="finger"/>
    <limit lower="0" upper="0.04" velocity="1"/></joint>
</robot>"#;

const TASK: &str = r#"scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.45, 0.1]}
robot: ROBOT
tools: [stick, paddle]
goal: {object: can, position: [0.55, 0.1], tolerance: 0.02}
"#;

pub const ROBOT: &str = "{urdf: six.urdf, flange: tool0, tool_mount: {length: 0.1}}";

/// Creates a folder with the arm and a task of a robot.
pub fn folder(robot: &str) -> TempDir {
    pushplan_arm::install();
    let folder = TempDir::new().expect("a folder");
    write(folder.path(), "six.urdf", URDF);
    write(folder.path(), "push.yaml", &TASK.replace("ROBOT", robot));
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("a file");
}

fn at(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().expect("UTF-8").to_owned()
}

/// Solves the task of a folder.
pub fn solve(folder: &Path) -> Output {
    let (task, out) = (at(folder, "push.yaml"), at(folder, "out"));
    run(&["solve", &task, "--out", &out, "--effort", "draft", "--quiet"])
}

#[test]
fn a_plan_of_an_arm_carries_its_joints_and_verifies_without_the_urdf() {
    let folder = folder(ROBOT);
    let folder = folder.path();
    let output = solve(folder);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    fs::remove_file(folder.join("six.urdf")).expect("the file");
    let path = at(folder, "out/push.plan.json");
    let output = run(&["verify", &path, "--replays", "0"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));

    let file = PlanFile::load(&path).expect("a plan");
    let joints = file.joints.as_ref().expect("a motion of joints");
    assert_eq!(joints.joints, ["turn", "shoulder", "elbow", "wrist1", "wrist2", "wrist3"]);
    assert_eq!(joints.pushes.len(), file.plan.steps.len());
    let arm = file.task.arm.as_deref().and_then(|arm| arm.downcast::<pushplan_arm::Arm>());
    let arm = arm.expect("an arm");
    // The trajectory begins and ends at home, where the next plan begins.
    assert_eq!(joints.points[0].positions, arm.home);
    assert_eq!(joints.points[joints.points.len() - 1].positions, arm.home);

    // A small joint error and an excessive joint speed are detected.
    let judged = |change: &dyn Fn(&mut pushplan::scene::JointTrajectory)| {
        let mut changed = joints.clone();
        change(&mut changed);
        let settings = VerifySettings { replays: 0, seed: 0 };
        let situation = Situation::stated(&file.task.scene);
        let verifier = Verifier::new(settings).moving(Some(&changed));
        verifier.nominal(&file.task, &situation, &file.tools, &file.plan)
    };
    assert!(judged(&|_| ()).passed);
    let [begin, end] = joints.pushes[0];
    let fault = |change: &dyn Fn(&mut pushplan::scene::JointTrajectory)| match judged(change).reason
    {
        Some(Reason::Forbidden(Warning::Arm { fault, .. })) => fault,
        other => panic!("{other:?}"),
    };
    let off = fault(&|path| path.points[begin.midpoint(end)].positions[0] += 0.01);
    assert!(matches!(off, ArmFault::Off { distance } if distance > 1e-3), "{off:?}");
    let fast = fault(&|path| path.points.iter_mut().for_each(|point| point.time *= 0.02));
    assert!(matches!(fast, ArmFault::TooFast { .. }), "{fast:?}");
    let other = fault(&|path| path.joints[0] = "other".into());
    assert_eq!(other, ArmFault::OfAnother);
}

#[test]
fn the_tool_of_an_arm_comes_back_from_its_scene() {
    let folder = folder(ROBOT);
    let folder = folder.path();
    write(folder, "push.yaml", &TASK.replace("ROBOT", ROBOT).replace("[stick, paddle]", "[stick]"));
    assert_eq!(solve(folder).status.code(), Some(0));
    let (plan, out) = (at(folder, "out/push.plan.json"), at(folder, "mjcf"));
    assert_eq!(run(&["export", &plan, "--out", &out]).status.code(), Some(0));
    let scene = at(folder, "mjcf/push.xml");
    let file = PlanFile::load(&plan).expect("a plan");
    // By default, by name, and after MuJoCo rewrote the scene with pushplan's data at the end.
    let text = fs::read_to_string(&scene).expect("a scene");
    let (begin, end) = (text.find("<custom>"), text.find("</custom>"));
    let ours = &text[begin.expect("begin")..end.expect("end") + "</custom>".len()];
    let saved = text.replace(ours, "").replace("</mujoco>", &format!("{ours}</mujoco>"));
    write(folder, "mjcf/saved.xml", &saved);
    let saved = at(folder, "mjcf/saved.xml");
    for arguments in [&[scene.as_str()][..], &[&scene, "--body", "tool"], &[&saved]] {
        let tool = at(folder, "tool.yaml");
        let all = [&["import", "--as", "tool", "--quiet", "--out", &tool], arguments].concat();
        let output = run(&all);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
        let tool = Tool::load(&tool).expect("a tool");
        // Flush parts become one solid.
        let [part] = tool.parts() else { panic!("{tool:?}") };
        let Shape::Cuboid { size } = part.shape else { panic!("{part:?}") };
        let off = size.iter().zip([0.56, 0.08, 0.05]).map(|(size, own)| (size - own).abs());
        let off = off.sum::<f64>() + (part.pose.position - Vector::new(0.33, 0.0)).norm();
        assert!(off < 1e-9 && tool.friction == file.tools[0].friction, "{tool:?}");
    }
}

#[test]
fn joints_are_exported_for_ros_and_as_a_table() {
    let folder = folder(ROBOT);
    let folder = folder.path();
    assert_eq!(solve(folder).status.code(), Some(0));
    let (plan, out) = (at(folder, "out/push.plan.json"), at(folder, "ros"));
    let output = run(&["export", &plan, "--format", "trajectory", "--out", &out]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read_to_string(folder.join("ros/push.joints.json")).expect("a message");
    let message: Json = serde_json::from_str(&text).expect("JSON");
    let points = message["points"].as_array().expect("points");
    let seconds = |point: &Json| {
        let time = &point["time_from_start"];
        time["sec"].as_i64().expect("s") as f64
            + 1e-9 * time["nanosec"].as_i64().expect("ns") as f64
    };
    assert!(points.windows(2).all(|pair| seconds(&pair[0]) < seconds(&pair[1])));
    assert_eq!(message["joint_names"].as_array().map(Vec::len), Some(6));
    let table = fs::read_to_string(folder.join("ros/push.joints.csv")).expect("a table");
    assert_eq!(table.lines().count(), points.len() + 1);
    assert!(table.lines().all(|line| line.split(',').count() == 19));

    // A robot defined only by its reach has no joints.
    write(folder, "push.yaml", &TASK.replace("ROBOT", "{reach: {min: 0.2, max: 0.8}}"));
    assert_eq!(solve(folder).status.code(), Some(0));
    let output = run(&["export", &plan, "--format", "trajectory", "--out", &out]);
    assert!(stderr(&output).contains("no joint motion"), "{}", stderr(&output));
}

#[test]
fn servos_of_a_panda_carry_plans_out_in_mujoco() {
    let Some(python) = python() else { return };
    let folder = TempDir::new().expect("a folder");
    let folder = folder.path();
    fs::copy(Path::new(ROOT).join("examples/robot/panda.urdf"), folder.join("panda.urdf"))
        .expect("a copy");
    let robot = "{urdf: panda.urdf, flange: panda_link8, tool_mount: {length: 0.12}}";
    let (out, scenes) = (at(folder, "out"), at(folder, "mjcf"));
    // Pushed forward, pulled back past a wall, and rotated.
    let can = TASK.replace("robot: ROBOT", &format!("robot: {robot}"));
    let wall = "  obstacles: [{name: wall, size: [0.03, 0.1, 0.06], position: [0.36, 0.1]}]\nrobot";
    let back = can.replace("\nrobot", &format!("\n{wall}"));
    let back = back.replace("[0.55, 0.1]", "[0.41, 0.1]").replace("0.45, 0.1]", "0.55, 0.1]");
    let turned = can
        .replace("cylinder: {radius: 0.04, height: 0.1}", "cuboid: {size: [0.12, 0.08, 0.06]}")
        .replace("tolerance: 0.02", "tolerance: 0.02, heading_deg: 20, heading_tolerance_deg: 8");
    let back = back.replace("[stick, paddle]", "[hook, l-hook, rake]");
    for (name, task) in [("on", can), ("back", back), ("turned", turned)] {
        let file = format!("{name}.yaml");
        write(folder, &file, &task);
        let output = run(&["solve", &at(folder, &file), "--out", &out, "--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", stderr(&output));
        let plan = at(folder, &format!("out/{name}.plan.json"));
        let output = run(&["export", &plan, "--out", &scenes]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", stderr(&output));
    }
    // The arm does not become an object when such a scene is imported.
    let output = run(&[
        "import",
        &at(folder, "mjcf/on.xml"),
        "--as",
        "objects",
        "--out",
        &at(folder, "again.yaml"),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("the arm that holds the tool is ignored"));
    let again = Task::load(folder.join("again.yaml")).expect("a task");
    assert_eq!(again.scene.objects.len(), 1);

    let script = folder.join("mjcf/replay.py");
    let output = Command::new(python).arg(script).arg(&scenes).output().expect("Python runs");
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(text.lines().count(), 3, "{}", String::from_utf8_lossy(&output.stderr));
    for line in text.lines() {
        let result: Json = serde_json::from_str(line).expect("JSON");
        assert_eq!(result["reached"], true, "{result:#}");
        let number = |key: &str| result[key].as_f64().expect("a number");
        // Servos follow to within a third of a degree, so the tool moves as in pushplan's engines.
        assert!(number("joints_off") < 6e-3, "{result:#}");
        assert!(number("difference") < 0.01, "{result:#}");
    }
}

#[test]
fn goals_without_a_feasible_pose_give_no_plan_and_a_reason() {
    // A shelf above the can leaves room for the tool but not for the arm.
    let folder = folder(ROBOT);
    let folder = folder.path();
    let shelf = "  obstacles:\n    - {name: shelf, size: [0.5, 0.7, 0.02], position: [0.5, 0.1, 0.17]}\nrobot";
    write(folder, "push.yaml", &TASK.replace("ROBOT", ROBOT).replace("robot", shelf));
    let output = solve(folder);
    assert_ne!(output.status.code(), Some(0));
}

/// Returns the faults of a task with their places.
fn faults(robot: &str) -> String {
    let folder = folder(robot);
    let faults = Task::load(folder.path().join("push.yaml")).expect_err("faults");
    let path = folder.path().to_str().expect("UTF-8").to_owned();
    faults.to_string().replace(&format!("{path}/"), "")
}

#[test]
fn errors_of_arms_have_location_and_remedy() {
    for (robot, message) in [
        (
            "{urdf: six.urdf, flange: tool0, reach: {max: 0.9}}",
            "`reach` is already defined by the arm",
        ),
        ("{urdf: six.urdf, flange: tool0, base: 0.1}", "`base` is already defined by the arm"),
        ("{urdf: six.urdf, flange: tool0, hand: none}", "`hand` is already defined by the arm"),
        ("{urdf: six.urdf}", "an arm needs a `flange`"),
        ("{urdf: six.urdf, flange: tool1}", "there is no link `tool1`"),
        ("{urdf: seven.urdf, flange: tool0}", "seven.urdf"),
        ("{urdf: push.yaml, flange: tool0}", "not valid XML"),
        (
            "{urdf: six.urdf, flange: tool0, home: [0, 0]}",
            "`home` has 2 numbers, but the arm has 6 joints",
        ),
        (
            "{urdf: six.urdf, flange: tool0, home: [0, 0, 5, 0, 0, 0]}",
            "at home joint `elbow` is at 5",
        ),
        (
            "{urdf: six.urdf, flange: tool0, base_pose: {height: 5}}",
            "cannot hold a tool above the table",
        ),
        (
            "{flange: tool0, reach: {max: 0.9}}",
            "`flange` is a key of an arm, but the task has no arm",
        ),
        ("{base_pose: {height: 0.1}, reach: {max: 0.9}}", "`base_pose` is a key of an arm"),
        (
            "{urdf: six.urdf, flange: tool0, joint_limits: {jerk: [9, 9]}}",
            "`joint_limits` has 2 numbers for `jerk`, but the arm has 6 joints",
        ),
        ("{home: [0, 0, 0], reach: {max: 0.9}}", "expected a list of 2 numbers, found one of 3"),
        ("{home: [0, 0]}", "missing key `reach`"),
        ("{arm: {name: six}}", "the arm is not valid: missing field"),
    ] {
        let found = faults(robot);
        assert!(found.contains(message), "{robot}: {found}");
        assert!(found.starts_with("push.yaml:"), "{found}");
    }
}

#[test]
fn a_damaged_arm_is_a_fault_with_its_place_in_the_urdf() {
    for (good, bad, message) in [
        ("upper=\"2.7\"", "upper=\"-2.8\"", "joint `elbow` has an empty range of positions"),
        ("lower=\"-2.7\"", "lower=\"${low}\"", "this is a xacro file, not a URDF"),
        (
            "name=\"wrist3\" type=\"continuous\"",
            "name=\"wrist3\" type=\"planar\"",
            "joint `wrist3` has the type `planar`",
        ),
        ("<child link=\"roll\"/>", "<child link=\"lower\"/>", "is the child of two joints"),
        ("<parent link=\"foot\"/>", "<parent link=\"tool0\"/>", "form a loop"),
        (
            "<sphere radius=\"0.04\"/>",
            "<mesh filename=\"package://no/such.stl\"/>",
            "there is no file package://no/such.stl",
        ),
        ("<sphere radius=\"0.04\"/>", "<sphere radius=\"-1\"/>", "its `radius` must be positive"),
        ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>", "has length zero"),
    ] {
        let folder = folder(ROBOT);
        assert!(URDF.contains(good), "{good}");
        write(folder.path(), "six.urdf", &URDF.replacen(good, bad, 1));
        let faults = Task::load(folder.path().join("push.yaml")).expect_err("faults").to_string();
        assert!(faults.contains(message) && faults.contains("six.urdf:"), "{bad}: {faults}");
    }
}
