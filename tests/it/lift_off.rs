//! Retreat of a tool before it is lifted, so that no object is lifted with it.

use std::fs;
use std::process::Command;
use std::sync::Arc;

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::geometry::{Pose, Vector};
use pushplan::sim::Simulator;
use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::{
    outcome::Record,
    scene::{Body, Object, Obstacle, Part, Scene, Tool},
    task::{Job, Push, RETREAT, Stroke, Task, ToolMotion},
};
use pushplan_export::{REPLAY_SCRIPT, mjcf};
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::mujoco_python::python;

/// Returns two pushes of 20 cm with a tool of these parts.
fn motion(parts: impl IntoIterator<Item = Part>, placed: bool) -> ToolMotion {
    let tool = Arc::new(Tool::new("tool", parts).expect("one piece"));
    let push =
        |x: f64| Push { start: Vector::new(x, 0.0), direction: 0.0, length: 0.2, speed: 0.1 };
    ToolMotion::pushes(tool, 0.002, 0.0, &[push(0.3), push(0.5)], placed)
}

fn bar() -> Part {
    Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default())
}

#[test]
fn a_tool_goes_back_a_little_and_all_the_way_from_below_a_shelf() {
    let ways = |scene: &Scene, motion: &ToolMotion| -> Vec<Option<f64>> {
        let back = |k| motion.retreat(scene, k).as_ref().map(Stroke::travel);
        (0..2).map(back).map(|way| way.map(|way| (1e6 * way).round() / 1e6)).collect()
    };
    let table = Scene::new([]);
    assert_eq!(ways(&table, &motion([bar()], true)), [Some(RETREAT); 2]);
    assert_eq!(ways(&table, &motion([bar()], false)), [None, Some(RETREAT)]);
    let shelf = Obstacle::cuboid("shelf", [0.1, 0.4, 0.02]).at(0.7, 0.0, 0.0).raised(0.1);
    let below = table.with_obstacle(shelf);
    assert_eq!(ways(&below, &motion([bar()], true)), [Some(RETREAT), Some(0.2)]);
    // The grip is also below the shelf, although all parts are beyond it.
    let far = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::new(0.1, 0.0, 0.0));
    assert_eq!(ways(&below, &motion([far], true))[1], Some(0.2));
}

#[test]
fn an_object_held_by_a_fork_comes_back_with_it_in_every_engine() {
    // There are 2 mm of play between the arms.
    let arm = |name: &str, x: f64| Part::cuboid(name, [0.02, 0.1, 0.05], Pose::new(x, 0.0, 0.0));
    let side = Part::cuboid("side", [0.122, 0.02, 0.05], Pose::new(0.0, 0.06, 0.0));
    let parts = [arm("back", -0.051), arm("front", 0.051), side];
    let mut motion = motion(parts, true);
    motion.strokes.truncate(1);
    let scene = Scene::new([Object::cylinder("can", 0.04, 0.08).at(0.3, 0.0, 0.0)]);
    for simulator in [Simulator::planar(), Simulator::spatial(), Simulator::upright()] {
        let end = |simulator: Simulator| {
            let run = simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
            run.outcome().poses[0].position.x
        };
        let (lifted, back) = (end(simulator), end(simulator.retreating()));
        let least = RETREAT - 0.002 - 1e-4;
        assert!((least..RETREAT + 5e-4).contains(&(lifted - back)), "{lifted} {back}");
    }
}

#[test]
fn contacts_name_parts_as_the_file_of_the_tool_lists_them() {
    // The last of four flush parts in a row meets the can; the engines treat all four as one solid.
    let part = |k: usize| {
        let x = 0.1 * k as f64;
        Part::cuboid(format!("part-{k}"), [0.1, 0.04, 0.05], Pose::new(x, 0.0, 0.0))
    };
    let motion = motion((0..4).map(part), true);
    assert_eq!(motion.tool.outline().len(), 1);
    let scene = Scene::new([Object::cylinder("can", 0.04, 0.08).at(0.7, 0.0, 0.0)]);
    for simulator in [Simulator::planar(), Simulator::spatial(), Simulator::upright()] {
        let run = simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);
        let with: Vec<Body> = run.contacts.iter().map(|contact| contact.with).collect();
        assert_eq!(with, [Body::Part(3)], "{:?}", simulator.engine());
    }
}

/// Can that sticks to the tool: friction 1.64.
const STICKY: &str = "
scene:
  table: {friction: 0.3}
  objects: [{name: can, shape: {cylinder: {radius: 0.03, height: 0.045}}, mass: 0.455, friction: 0.5, position: [0.611, 0.061]}]
  frictions: [{between: [can, tool], coefficient: 1.64}]
robot: {reach: {min: 0.25, max: 0.95}}
tools: [l-hook]
pushes: {directions: 8, max_count: 2}
goal: {object: can, position: [0.717, 0.161], tolerance: 0.01}
";

#[test]
fn an_object_stuck_to_a_tool_is_left_standing_in_mujoco() {
    let Some(python) = python() else { return };
    let task = Task::parse(STICKY, "sticky.yaml").expect("sound");
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let solution = planner.solve(&task, &library).expect("sound");
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    let text = mjcf(&PlanFile::new(task.clone(), best.tools.clone(), best.plan.clone()));
    let text = text.expect("no loops");
    let retreat = "name=\"retreat 1\" data=\"0.005";
    assert!(text.contains(retreat), "{text}");
    let folder = TempDir::new().expect("a folder");
    let script = folder.path().join("replay.py");
    fs::write(&script, REPLAY_SCRIPT).expect("written");
    let failure = |text: &str| -> Json {
        let scene = folder.path().join("sticky.xml");
        fs::write(&scene, text).expect("written");
        let output = Command::new(&python).arg(&script).arg(&scene).output().expect("Python runs");
        let found: Json = serde_json::from_slice(&output.stdout).expect("a line of JSON");
        found["failure"].clone()
    };
    assert_eq!(failure(&text), Json::Null);
    // Lifted without a retreat, the tool topples the can.
    let straight = text.replace(retreat, "name=\"retreat 1\" data=\"0.0000005");
    assert_eq!(failure(&straight), "topples");
}
