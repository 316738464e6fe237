//! Export of plans: the written files, and their replay in MuJoCo.

mod mujoco;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::Arc;

use insta::assert_snapshot;
use pushplan::asset::PlanFile;
use pushplan::geometry::Vector;
use pushplan::{
    scene::Tool,
    task::{Plan, Push, PushForm, Task},
};
use pushplan_export::{REPLAY_SCRIPT, mjcf};
use tempfile::TempDir;

/// Returns a plan for a task and a tool given as text, with pushes of these starts (metres),
/// directions (degrees), lengths (metres) and speeds (m/s).
fn plan(task: &str, tool: &str, form: PushForm, pushes: &[([f64; 2], f64, f64, f64)]) -> PlanFile {
    let task = Task::parse(task, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let tool = Tool::parse(tool, "tool.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let push = |&([x, y], degrees, length, speed): &([f64; 2], f64, f64, f64)| Push {
        start: Vector::new(x, y),
        direction: degrees.to_radians(),
        length,
        speed,
    };
    let pushes = pushes.iter().map(push);
    let name = tool.name.clone();
    PlanFile::new(task, vec![Arc::new(tool)], Plan::pushing(name, 0.0, form, 0.002, pushes))
}

const BAR: &str = "
name: bar
friction: 0.4
parts: [{name: bar, size: [0.04, 0.40, 0.05], position: [0, 0]}]
";

#[test]
fn a_scene_holds_bodies_pairs_pushes_and_goal() {
    let task = "
name: can-and-wall
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.05, height: 0.10}}, mass: 0.4, friction: 0.4, position: [0.55, 0.10]}
    - {name: box, shape: {cuboid: {size: [0.08, 0.06, 0.05]}}, mass: 0.6, friction: 0.3, position: [0.60, -0.10], yaw_deg: 90}
  obstacles:
    - {name: wall, size: [0.02, 0.30, 0.08], position: [0.80, 0.10], yaw_deg: 90, friction: 0.3}
robot: {home: [0.3, 0.0], reach: {max: 0.9}}
tools: [bar]
pushes: {max_count: 2}
goal: {object: box, position: [0.65, -0.10], tolerance: 0.02, heading_deg: 90, heading_tolerance_deg: 10}
";
    let pushes = [([0.475, 0.1], 0.0, 0.1, 0.1), ([0.5, 0.1], 90.0, 0.05, 0.1)];
    let file = plan(task, BAR, PushForm::Placed, &pushes);
    assert_snapshot!(mjcf(&file).unwrap());
}

#[test]
fn jointed_objects_hang_on_each_other() {
    let task = "
scene:
  table: {friction: 0.5}
  objects:
    - {name: a, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.50, 0.0], yaw_deg: 90}
    - {name: b, shape: {cuboid: {size: [0.06, 0.06, 0.10]}}, mass: 0.6, friction: 0.3, position: [0.57, 0.0]}
    - {name: c, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.64, 0.0]}
    - {name: d, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.71, 0.0]}
  joints:
    - {between: [a, b], kind: fixed}
    - {between: [c, b], kind: revolute, at: [0.605, 0.0], limits_deg: [-20, 30]}
    - {between: [c, d], kind: prismatic, axis: [1, 0], limits: [-0.005, 0.04]}
robot: {home: [0.3, 0.0], reach: {max: 0.9}}
tools: [bar]
goal: {object: a, position: [0.60, 0.0], tolerance: 0.02}
";
    let file = plan(task, BAR, PushForm::Chained, &[([0.44, 0.0], 0.0, 0.1, 0.1)]);
    let text = mjcf(&file).unwrap();
    let start = text.find("<body name=\"object/a\"").expect("the first object");
    let end = text.find("    <body name=\"tool\"").expect("the tool");
    assert_snapshot!(text[start..end]);
    // Neighbours connected by a joint collide, objects of one body do not.
    let touches =
        |a: &str, b: &str| text.contains(&format!("geom1=\"object/{a}\" geom2=\"object/{b}\""));
    assert!(touches("b", "c") && touches("c", "d") && touches("a", "c") && !touches("a", "b"));
}

#[test]
fn every_shipped_task_has_a_scene() {
    let tool = Tool::parse(BAR, "bar.yaml").unwrap();
    for entry in fs::read_dir(Path::new(crate::ROOT).join("tasks")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "yaml") {
            let mut file = plan(SIMPLE, BAR, PushForm::Placed, &[([0.4, 0.0], 0.0, 0.1, 0.1)]);
            file.task = Task::load(&path).unwrap();
            file.tools = vec![Arc::new(tool.clone())];
            let text = mjcf(&file).unwrap();
            for object in &file.task.scene.objects {
                assert!(text.contains(&format!("<body name=\"object/{}\"", object.name)));
            }
        }
    }
}

const SIMPLE: &str = "
scene:
  table: {friction: 0.5}
  objects:
    - {name: box, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.50, 0.0]}
robot: {home: [0.3, 0.0], reach: {max: 0.9}}
tools: [bar]
goal: {object: box, position: [0.60, 0.0], tolerance: 0.02}
";

#[test]
fn the_command_writes_a_scene_for_each_plan_and_the_script() {
    let folder = TempDir::new().unwrap();
    let (plans, out) = (folder.path().join("plans"), folder.path().join("out"));
    fs::create_dir_all(plans.join("other")).unwrap();
    let file = plan(SIMPLE, BAR, PushForm::Placed, &[([0.435, 0.0], 0.0, 0.1, 0.1)]);
    let paths = ["a.plan.json", "b.json", "other/a.plan.json"].map(|name| plans.join(name));
    for path in &paths {
        file.write(path).unwrap();
    }
    let output = export(&paths[..2], &out);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    // The task's name is the name of its file.
    let written = PlanFile::load(&paths[0]).unwrap();
    assert_eq!(fs::read_to_string(out.join("a.xml")).unwrap(), mjcf(&written).unwrap());
    assert!(out.join("b.xml").exists());
    assert_eq!(fs::read_to_string(out.join("replay.py")).unwrap(), REPLAY_SCRIPT);

    let output = export(&[&paths[0], &paths[2]], &out);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let missing = plans.join("missing.plan.json");
    assert_eq!(export(&[&missing], &out).status.code(), Some(3));
}

fn export(plans: &[impl AsRef<Path>], out: &Path) -> Output {
    Command::new(crate::PROGRAM)
        .arg("export")
        .args(plans.iter().map(AsRef::as_ref))
        .args(["--format", "mjcf", "--out"])
        .arg(out)
        .output()
        .expect("the command runs")
}
