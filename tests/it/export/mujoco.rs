//! Replay of exported plans in MuJoCo: closed-form friction, and the shipped tasks.
//!
//! Needs a Python with the package `mujoco`.

use std::fs;
use std::path::Path;
use std::process::Command;

use pushplan::asset::{PlanFile, ToolLibrary, load_task};
use pushplan::solve::{Effort, Planner};
use pushplan::{
    scene::GRAVITY,
    task::{PushForm, Step, Task},
};
use pushplan_export::{LEVER_SCRIPT, REPLAY_SCRIPT, mjcf};
use serde_json::Value as Json;
use tempfile::TempDir;

use super::{BAR, plan};
use crate::ROOT;
use crate::levers::plan_file;
use crate::mujoco_python::python;

/// Start of the box of [`pushed`], metres.
const START: f64 = 0.50;

/// Friction coefficients of the box: with the table, and with the bar.
const TABLE: f64 = 0.45;
const BAR_FRICTION: f64 = 0.4;

/// A lever-up that flips a plate, and one followed by pushes, as found by the planner.
#[test]
fn shipped_plans_in_space_work_in_mujoco() {
    let Some(python) = python() else { return };
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let planner = Planner::for_effort(Effort::Draft).expect("the shipped weights").build();
    let root = Path::new(ROOT).join("tasks/levers");
    let folder = TempDir::new().expect("a folder");
    let script = folder.path().join("lever.py");
    fs::write(&script, LEVER_SCRIPT).expect("written");
    for name in ["flip-plate", "turn-and-push"] {
        let task = load_task(root.join(format!("{name}.yaml")), &library).expect("sound");
        let solution = planner.solve(&task, &library).expect("sound");
        let best = solution.best().expect("a plan");
        let scene = folder.path().join(format!("{name}.xml"));
        let text = mjcf(&plan_file(&task, best)).expect("no loops");
        fs::write(&scene, text).expect("written");
        let output = Command::new(&python).arg(&script).arg(&scene).output().expect("Python runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let found: Json = serde_json::from_slice(&output.stdout).expect("a line of JSON");
        assert_eq!(found["reached"], true, "{name}: {}", found["rest"]);
    }
}

#[test]
fn a_box_pushed_flush_slides_on_by_v2_over_2_mu_g() {
    for speed in [0.1, 0.5] {
        let Some([x, y, heading]) = pushed(0.0, 0.20, speed) else { return };
        let slide = speed * speed / (2.0 * TABLE * GRAVITY);
        assert!((x - (START + 0.20 + slide)).abs() < 2e-4, "{speed} m/s: {x}");
        assert!(y.abs() < 1e-4 && heading.abs() < 1e-3, "{y} {heading}");
    }
}

#[test]
fn a_box_pushed_aside_sticks_within_the_friction_cone_and_slips_outside() {
    for degrees in [10.0_f64, 30.0, 45.0] {
        let Some([x, y, heading]) = pushed(degrees, 0.20, 0.1) else { return };
        // A carried box moves along the bar's direction if the direction is within the friction
        // cone, otherwise along the edge of the cone.
        let way = degrees.to_radians().tan().min(BAR_FRICTION);
        let ahead = 0.20 * degrees.to_radians().cos();
        assert!((y - way * ahead).abs() < 2e-3, "{degrees} degrees: {y}, not {}", way * ahead);
        assert!((x - (START + ahead)).abs() < 2e-3 && heading.abs() < 2e-3, "{x} {heading}");
    }
}

#[test]
fn prisms_pushed_flush_slide_on_by_v2_over_2_mu_g() {
    let Some(python) = python() else { return };
    let triangle = "corners: [[0, 0], [0.10, 0.06], [0, 0.12]]";
    // The centre of mass is opposite the middle of the face, but not at the middle of the block.
    let loaded =
        "corners: [[0, 0], [0.1, 0], [0.1, 0.08], [0, 0.08]], centre_of_mass: [0.06, 0.04]";
    for (prism, face) in [(triangle, 0.1 / 3.0), (loaded, 0.06)] {
        let task = task("").replace(
            "{cuboid: {size: [0.08, 0.08, 0.06]}}",
            &format!("{{prism: {{{prism}, height: 0.06}}}}"),
        );
        let start = [START - face - 0.025, 0.0];
        let file = plan(&task, BAR, PushForm::Placed, &[(start, 0.0, 0.20, 0.2)]);
        let results = replay(&python, &[("flush", mjcf(&file).unwrap())]);
        assert_eq!(results[0]["goal_object"], "prism");
        let pose = &results[0]["poses"]["object/box"];
        let [x, y, heading] = [0, 1, 2].map(|k| pose[k].as_f64().expect("a number"));
        let slide = 0.2 * 0.2 / (2.0 * TABLE * GRAVITY);
        assert!((x - (START + 0.195 + slide)).abs() < 5e-4, "{prism}: {x}");
        assert!(y.abs() < 5e-4 && heading.abs() < 3e-3, "{prism}: {y} {heading}");
    }
}

#[test]
fn six_shipped_plans_work_in_mujoco() {
    let Some(python) = python() else { return };
    let library = ToolLibrary::embedded().unwrap();
    let planner = Planner::for_effort(Effort::Standard).unwrap().build();
    let root = Path::new(ROOT).join("tasks");
    let mut texts = Vec::new();
    // A can behind a wall; a box that takes two pulls; a joint with limits; two tools; prisms.
    let names = ["pull-back-behind-wall", "pull-back-twice", "drawer", "two-tools"];
    for name in names.into_iter().chain(["triangle-turned", "hexagon-any-side"]) {
        let task = Task::load(root.join(format!("{name}.yaml"))).unwrap();
        let solution = planner.solve(&task, &library).unwrap();
        let best = &solution.plans[0];
        let file = PlanFile {
            verdict: best.verdict.clone(),
            ..PlanFile::new(task, best.tools.clone(), best.plan.clone())
        };
        texts.push((name, mjcf(&file).unwrap()));
    }
    for result in replay(&python, &texts) {
        assert_eq!(result["reached"], true, "{result:#}");
        let difference = result["difference"].as_f64().expect("our own replay is known");
        assert!(difference < 5e-3, "{result:#}");
    }
}

#[test]
fn a_tool_set_down_on_an_object_and_a_jam_fail() {
    let Some(python) = python() else { return };
    let on = plan(&task(""), BAR, PushForm::Placed, &[([0.45, 0.0], 0.0, 0.1, 0.1)]);
    let wall = "{name: wall, size: [0.05, 0.30, 0.10], position: [0.60, 0.0]}";
    let jam = plan(&task(wall), BAR, PushForm::Placed, &[([0.435, 0.0], 0.0, 0.2, 0.1)]);
    let texts = [("on", mjcf(&on).unwrap()), ("jam", mjcf(&jam).unwrap())];
    let results = replay(&python, &texts);
    assert_eq!(results[0]["failure"], "jams");
    assert_eq!(results[1]["failure"], "set down on an object");
}

/// The bar would overlap the box in the heading of its second push, before it is lifted.
#[test]
fn a_tool_rotates_after_it_is_lifted() {
    let Some(python) = python() else { return };
    let task = task("").replace("[0.80, 0.0]", "[0.60, 0.06]");
    let pushes = [([START - 0.06, 0.0], 0.0, 0.1, 0.05), ([0.60, -0.06], 90.0, 0.06, 0.05)];
    let mut file = plan(&task, BAR, PushForm::Placed, &pushes);
    let Some(Step::Push(last)) = file.plan.steps.last_mut() else { panic!("a push") };
    last.grip_yaw = std::f64::consts::FRAC_PI_2;
    let text = mjcf(&file).unwrap();
    let turn = "<numeric name=\"turn 2\"";
    assert!(text.contains(turn), "{text}");
    let at_once = text.replace(turn, "<numeric name=\"ignored\"");
    let results = replay(&python, &[("after", text), ("before", at_once)]);
    assert_eq!(results[0]["reached"], true, "{:#}", results[0]);
    assert_eq!(results[1]["failure"], "collides on the way");
}

/// Closed form: an object stays as long as its centre of mass is above the table.
#[test]
fn objects_fall_over_the_edge_of_a_finite_table() {
    let Some(python) = python() else { return };
    let cuboid = "{cuboid: {size: [0.08, 0.08, 0.06]}}";
    let cylinder = "{cylinder: {radius: 0.04, height: 0.06}}";
    let mut texts = Vec::new();
    for (name, shape) in [("box", cuboid), ("can", cylinder)] {
        // The table ends 20 cm ahead of the object's start.
        let task = task("")
            .replace(cuboid, shape)
            .replace("{friction: 0.5}", "{friction: 0.5, size: [0.6, 0.8], position: [0.4, 0.0]}")
            .replace("[0.80, 0.0], tolerance: 0.02", "[0.66, 0.0], tolerance: 0.06");
        for (kind, length) in [("stays", 0.19), ("falls", 0.21)] {
            let start = [START - 0.06, 0.0];
            let file = plan(&task, BAR, PushForm::Placed, &[(start, 0.0, length, 0.06)]);
            let text = mjcf(&file).unwrap();
            let table = "name=\"table\" type=\"box\" size=\"0.3 0.4 0.25\" pos=\"0.4 0 -0.25\"";
            assert!(text.contains(table), "{text}");
            texts.push((format!("{name}-{kind}"), text));
        }
    }
    let texts: Vec<(&str, String)> =
        texts.iter().map(|(name, text)| (name.as_str(), text.clone())).collect();
    for result in replay(&python, &texts) {
        let falls = result["plan"].as_str().is_some_and(|name| name.ends_with("falls"));
        let lost = ["topples", "falls off the table"].map(Json::from).contains(&result["failure"]);
        assert_eq!((result["reached"] == true, lost), (!falls, falls), "{result:#}");
    }
}

#[test]
fn an_unstable_time_step_is_refined_until_the_replay_is_stable() {
    let Some(python) = python() else { return };
    let task = task("").replace("[0.80, 0.0]", "[0.70, 0.0]");
    let push = ([START - 0.06, 0.0], 0.0, 0.20, 0.1);
    let text = mjcf(&plan(&task, BAR, PushForm::Placed, &[push])).unwrap();
    let coarse = text.replace("timestep=\"0.00025\"", "timestep=\"0.002\"");
    assert_ne!(coarse, text);
    let [fine, refined] = &replay(&python, &[("a", text), ("b", coarse)])[..] else { panic!() };
    let steps = |result: &Json| result["runs"].as_array().map_or(0, Vec::len);
    assert_eq!((steps(fine), &fine["timestep"]), (1, &Json::from(2.5e-4)), "{fine:#}");
    assert!(steps(refined) > 1, "{refined:#}");
    assert_eq!(refined["runs"][0]["failure"], "moves too fast", "{refined:#}");
    for result in [fine, refined] {
        assert_eq!(result["reached"], true, "{result:#}");
    }
}

fn task(obstacles: &str) -> String {
    format!(
        "
scene:
  table: {{friction: 0.5}}
  objects:
    - {{name: box, shape: {{cuboid: {{size: [0.08, 0.08, 0.06]}}}}, mass: 0.4, friction: 0.4, position: [{START}, 0.0]}}
  obstacles: [{obstacles}]
robot: {{home: [0.3, 0.0], reach: {{max: 0.9}}}}
tools: [bar]
goal: {{object: box, position: [0.80, 0.0], tolerance: 0.02}}
"
    )
}

/// Returns the end of a box that a flush bar pushes by `length` metres, at `degrees` to the face's
/// normal; `None` without MuJoCo.
fn pushed(degrees: f64, length: f64, speed: f64) -> Option<[f64; 3]> {
    let python = python()?;
    let start = [START - 0.06, 0.0];
    let file = plan(&task(""), BAR, PushForm::Placed, &[(start, degrees, length, speed)]);
    let results = replay(&python, &[("pushed", mjcf(&file).unwrap())]);
    let pose = &results[0]["poses"]["object/box"];
    Some([0, 1, 2].map(|k| pose[k].as_f64().expect("a number")))
}

/// Returns the results of the script for scenes, in the order of their names.
fn replay(python: &str, scenes: &[(&str, String)]) -> Vec<Json> {
    let folder = TempDir::new().unwrap();
    let script = folder.path().join("replay.py");
    fs::write(&script, REPLAY_SCRIPT).unwrap();
    for (name, text) in scenes {
        fs::write(folder.path().join(format!("{name}.xml")), text).unwrap();
    }
    let output = Command::new(python).arg(&script).arg(folder.path()).output().unwrap();
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let results: Vec<Json> =
        lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(results.len(), scenes.len(), "{error}");
    let all = results.iter().all(|result| result["reached"] == true);
    assert_eq!(output.status.code(), Some(i32::from(!all)), "{error}");
    results
}
