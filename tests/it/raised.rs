//! Parts of objects above the table: passage below them, contacts with them, and their support.

use std::fs;
use std::process::Command;
use std::sync::Arc;

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::geometry::{Pose, Vector};
use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::{
    scene::{Object, Obstacle, Part, Physics, Scene, Support, Tool},
    task::{Plan, Push, PushForm, Stroke, Task, ToolMotion},
};
use pushplan_export::{REPLAY_SCRIPT, mjcf};
use pushplan_import::{Wanted, objects, parse};
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::fixtures::{end, models};
use crate::mujoco_python::python;

/// Returns a push along x by a bar of this height.
fn pushed(height: f64, width: f64, from: [f64; 2], length: f64) -> ToolMotion {
    let bar = Part::cuboid("bar", [0.02, width, height], Pose::default());
    let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece"));
    let push = Push { start: Vector::from(from), direction: 0.0, length, speed: 0.1 };
    ToolMotion::pushes(tool, 0.002, 0.0, &[push], true)
}

/// Returns a box with a handle to its left, 6 cm above the table.
fn kettle() -> Scene {
    let body = Object::cuboid("kettle", [0.10, 0.08, 0.10]).mass(0.55).at(0.5, 0.0, 0.0);
    let handle = Object::cuboid("kettle/handle", [0.04, 0.12, 0.02]).mass(0.05).raised(0.06);
    Scene::new([body]).with_part(0, handle, Pose::new(0.0, 0.10, 0.0))
}

/// Returns a body with such a handle on either side, both reaching back beyond the body.
fn pot() -> Scene {
    let body = Object::cuboid("pot", [0.06, 0.08, 0.10]).mass(0.7).at(0.5, 0.0, 0.0);
    let handle = || Object::cuboid("pot/handle", [0.12, 0.06, 0.02]).mass(0.05).raised(0.06);
    Scene::new([body]).with_part(0, handle(), Pose::new(-0.03, 0.07, 0.0)).with_part(
        0,
        handle(),
        Pose::new(-0.03, -0.07, 0.0),
    )
}

#[test]
fn a_low_tool_passes_below_a_handle_and_a_tall_one_takes_it_along() {
    let scene = kettle();
    let mut ends = Vec::new();
    for (name, model) in models() {
        let low = end(&*model, &scene, &pushed(0.05, 0.04, [0.40, 0.11], 0.2));
        // 3-D bodies settle by micrometres.
        let (moved, turned) =
            (low.poses[0].position - scene.objects[0].pose.position, low.poses[0]);
        assert!(moved.norm() < 1e-4 && turned.heading.abs() < 1e-3, "{name} {low:?}");
        let tall = end(&*model, &scene, &pushed(0.08, 0.04, [0.40, 0.11], 0.11)).poses[0];
        assert!(tall.heading < -0.2, "{name} {tall:?}");
        ends.push((name, tall));
    }
    let (_, planar) = ends[1];
    for (name, pose) in ends {
        let (off, turned) = (pose.position - planar.position, pose.heading - planar.heading);
        // In 2-D the load shifts as if the body were pushed; in 3-D the handle is pushed, which is
        // higher.
        let (far, askew) = if name == "spatial" { (8e-3, 0.05) } else { (1e-3, 0.01) };
        assert!(off.norm() < far && turned.abs() < askew, "{name}: {pose:?} {planar:?}");
    }
}

/// Closed form: pushed evenly at both handles, a pot moves as far as the tool after contact.
#[test]
fn a_wide_tool_that_meets_the_handles_alone_carries_a_pot_straight() {
    let scene = pot();
    for (name, model) in models() {
        // The handles end at x = 0.41, the tool begins at 0.40.
        let tall = end(&*model, &scene, &pushed(0.08, 0.20, [0.39, 0.0], 0.11)).poses[0];
        let off = tall.position - Vector::new(0.6, 0.0);
        assert!(off.norm() < 1.5e-3 && tall.heading.abs() < 0.01, "{name} {tall:?}");
        // A low tool continues to the body, 6 cm behind the handles.
        let low = end(&*model, &scene, &pushed(0.05, 0.20, [0.39, 0.0], 0.11)).poses[0];
        let off = low.position - Vector::new(0.54, 0.0);
        assert!(off.norm() < 1.5e-3 && low.heading.abs() < 0.01, "{name} {low:?}");
    }
}

#[test]
fn low_objects_pass_below_a_handle_and_tall_objects_do_not() {
    for (height, passes) in [(0.05, true), (0.09, false)] {
        let can = Object::cylinder("can", 0.02, height).mass(0.3).at(0.43, 0.12, 0.0);
        let mut scene = Scene::new([kettle().objects[0].clone(), can]);
        scene = scene.with_part(0, kettle().objects[1].clone(), Pose::new(0.0, 0.10, 0.0));
        for (name, model) in models() {
            let end = end(&*model, &scene, &pushed(0.04, 0.10, [0.39, 0.12], 0.09)).poses;
            let stays = (end[0].position - Vector::new(0.5, 0.0)).norm() < 1e-4;
            assert_eq!(stays, passes, "{name} {end:?}");
            assert!((end[1].position.x - 0.51).abs() < 5e-3 || !passes, "{name} {end:?}");
        }
        // An obstacle below the handle does not hold it either.
        let block = Obstacle::cuboid("block", [0.02, 0.02, height]).at(0.54, 0.12, 0.0);
        let scene = kettle().with_obstacle(block);
        for (name, model) in models() {
            let motion = pushed(0.05, 0.06, [0.42, 0.0], 0.12);
            let [end, free] =
                [&scene, &kettle()].map(|scene| end(&*model, scene, &motion).poses[0]);
            let same = (end.position - free.position).norm() < 1e-4;
            assert_eq!(same, passes, "{name} {end:?} {free:?}");
        }
    }
}

#[test]
fn grounded_parts_support_the_centre_of_mass() {
    let scene = kettle();
    let physics = Physics::stated(&scene);
    let feet = &physics.feet;
    assert!((feet[0].share * 0.55 - 0.6).abs() < 1e-12 && feet[1].share == 0.0);
    let centre = scene.centre(0, &scene.start()) - scene.objects[0].pose.position;
    assert!((centre - Vector::new(0.0, 0.10 / 12.0)).norm() < 1e-12);
    let loaded: Vector = feet[0].each().map(|(at, load)| load * at).sum();
    assert!((loaded - centre).norm() < 1e-9, "{loaded} {centre}");
    // For every plausible support model.
    for support in &Physics::PLAUSIBLE_SUPPORTS {
        let feet = scene.feet(0, support);
        let loaded: Vector = feet.each().map(|(at, load)| load * at).sum();
        assert!((loaded - centre).norm() < 1e-9, "{support:?}: {loaded} {centre}");
    }
    // Four legs carry a top in equal shares.
    let leg = |name: &str| Object::cuboid(name, [0.02, 0.02, 0.10]).mass(0.1);
    let top = Object::cuboid("stool/top", [0.3, 0.2, 0.02]).mass(1.0).raised(0.10);
    let mut stool = Scene::new([leg("stool").at(0.6, 0.1, 0.4)]);
    for [x, y] in [[0.2, 0.0], [0.0, 0.1], [0.2, 0.1]] {
        stool = stool.with_part(0, leg("stool/leg"), Pose::new(x, y, 0.0));
    }
    let stool = stool.with_part(0, top, Pose::new(0.1, 0.05, 0.0));
    let shares: Vec<f64> = Physics::stated(&stool).feet.iter().map(|feet| feet.share).collect();
    for (share, known) in shares.iter().zip([3.5, 3.5, 3.5, 3.5, 0.0]) {
        assert!((share - known).abs() < 1e-9, "{shares:?}");
    }
    assert_eq!(stool.feet(4, &Support::Even).share, 0.0);
}

/// Lifted below a handle, a tool would lift the object.
#[test]
fn a_tool_goes_all_the_way_back_from_where_a_handle_may_be() {
    let back = |scene: &Scene, height: f64| {
        let back = pushed(height, 0.04, [0.40, 0.11], 0.2).retreat(scene, 0);
        back.as_ref().map_or(0.0, Stroke::travel)
    };
    assert!((back(&kettle(), 0.05) - 0.2).abs() < 1e-12);
    assert!((back(&kettle(), 0.08) - 0.005).abs() < 1e-12);
}

const PAN: &str = "
scene:
  objects:
    - name: pan
      shape: {cylinder: {radius: 0.08, height: 0.06}}
      parts:
        - {name: handle, shape: {cuboid: {size: [0.16, 0.03, 0.02]}}, position: [0.15, 0], z: 0.04, mass: 0.1}
      mass: 0.9
      friction: 0.4
      position: [0.6, 0]
    - {name: plate, shape: {cylinder: {radius: 0.05, height: 0.02}}, mass: 0.3, friction: 0.4, position: [0.76, 0]}
robot: {reach: {min: 0.3, max: 0.95}}
tools: [finger]
goal: {object: pan, position: [0.55, 0.1], tolerance: 0.02}
";

#[test]
fn files_state_heights_of_parts_and_impossible_heights_are_errors() {
    let task = Task::parse(PAN, "pan.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    assert!(task.scene.objects[2].is_raised() && !task.in_space());
    let written = task.to_yaml().expect("a file");
    assert_eq!(Task::parse(&written, "again.yaml").expect("the written task"), task);
    let faults = |from: &str, to: &str| {
        assert!(PAN.contains(from), "{from}");
        Task::parse(&PAN.replace(from, to), "pan.yaml").expect_err(to).to_string()
    };
    for (from, to, words) in [
        ("z: 0.04", "z: 0.01", "`plate` overlaps `pan/handle`"),
        ("z: 0.04", "z: 0.0605", "hangs in the air"),
        ("[0.15, 0], z", "[0.17, 0], z", "hangs in the air"),
        ("mass: 0.1}", "mass: 0.6}", "would topple"),
        ("z: 0.04", "z: 0.04, support: corners", "has no support below it"),
        ("z: 0.04", "z: -0.01", "0 to 10"),
        ("z: 0.04", "z: .nan", "pan.yaml:7:"),
        ("z: 0.04", "z: .inf", "pan.yaml:7:"),
        ("z: 0.04", "z: 1e300", "pan.yaml:7:"),
        ("z: 0.04", "z: high", "pan.yaml:7:"),
        ("z: 0.04", "z: [0.04]", "pan.yaml:7:"),
        ("z: 0.04", "z: ", "pan.yaml:7:"),
    ] {
        let text = faults(from, to);
        assert!(text.contains(words), "{to}: {text}");
    }
    // A part that rests on another part.
    let lid = "mass: 0.1}\n        - {shape: {cylinder: {radius: 0.03, height: 0.02}}, position: [0, 0], z: ";
    let knob = |z: f64| PAN.replace("mass: 0.1}", &format!("{lid}{z}}}"));
    assert!(Task::parse(&knob(0.06), "pan.yaml").is_ok());
    assert!(Task::parse(&knob(0.07), "pan.yaml").is_err());
}

#[test]
fn bodies_of_other_programs_have_their_handles_where_they_are() {
    let body = |z: f64, size: f64| {
        let text = format!(
            "<mujoco><worldbody><geom type='plane' size='1 1 1'/>
             <body name='pan' pos='0.5 0 0.03'><freejoint/>
             <geom type='box' size='{size} 0.015 0.01' pos='0.11 0 {z}' mass='0.05'/>
             <geom type='cylinder' size='0.08 0.03' mass='0.5'/></body></worldbody></mujoco>"
        );
        let (model, ..) = parse(&text, "pan.xml").unwrap_or_else(|faults| panic!("{faults}"));
        objects(&model, "pan.xml", &Wanted::default()).unwrap_or_else(|faults| panic!("{faults}"))
    };
    let scene = body(0.01, 0.04).value.task.scene;
    let [pan, handle] = &scene.objects[..] else { panic!("{scene:?}") };
    assert!(pan.shape.is_cylinder() && (scene.mass(0) - 0.55).abs() < 1e-9, "{scene:?}");
    assert!((handle.z - 0.03).abs() < 1e-9 && (handle.top() - 0.05).abs() < 1e-9, "{handle:?}");
    // An unsupported part is extended down.
    let scene = body(0.06, 0.04).value.task.scene;
    assert!(!scene.objects[1].is_raised() && (scene.objects[1].top() - 0.1).abs() < 1e-9);
    // Exported files are read back.
    let task = Task::parse(PAN, "pan.yaml").expect("a task");
    let push = Push { start: Vector::new(0.3, 0.0), direction: 0.0, length: 0.1, speed: 0.1 };
    let tool = ToolLibrary::embedded().expect("tools").get("stick").expect("one").clone();
    let plan = Plan::pushing(&tool.name, 0.0, PushForm::Placed, 0.002, [push]);
    let text = mjcf(&PlanFile::new(task.clone(), vec![tool], plan)).expect("no loops");
    let (model, ..) = parse(&text, "pan.xml").unwrap_or_else(|faults| panic!("{faults}"));
    let again = objects(&model, "pan.xml", &Wanted::default()).expect("our own").value.task.scene;
    assert_eq!(again.objects.len(), 3);
    for object in &task.scene.objects {
        let other = again.objects.iter().find(|other| other.name == object.name);
        let other = other.unwrap_or_else(|| panic!("{again:?}"));
        assert!((other.z - object.z).abs() < 1e-9 && (other.mass - object.mass).abs() < 1e-9);
        assert!((other.pose.position - object.pose.position).norm() < 1e-9, "{other:?}");
    }
}

#[test]
fn a_part_at_height_zero_is_a_part_that_stands() {
    let flat = PAN.replace("z: 0.04, ", "").replace("[0.76, 0]", "[0.6, 0.2]");
    let stated = flat.replace("mass: 0.1}", "mass: 0.1, z: 0}");
    let [flat, stated] =
        [&flat, &stated].map(|text| Task::parse(text, "pan.yaml").expect("a task"));
    assert_eq!(flat.scene, stated.scene);
    let feet = Physics::stated(&flat.scene).feet;
    for (object, feet) in flat.scene.objects.iter().zip(&feet) {
        assert_eq!(**feet, object.feet());
    }
    let motion = pushed(0.05, 0.1, [0.4, 0.03], 0.2);
    for (name, model) in models() {
        let [one, other] = [&flat, &stated].map(|task| end(&*model, &task.scene, &motion));
        assert_eq!(one, other, "{name}");
    }
}

#[test]
fn a_drawer_is_pulled_out_by_a_raised_handle_and_mujoco_agrees() {
    let task = Task::example("drawer-above-a-saucer").expect("a shipped task");
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    let solution = planner.solve(&task, &library).expect("a sound task");
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    let file = PlanFile::new(task.clone(), best.tools.clone(), best.plan.clone());
    let file = PlanFile { verdict: best.verdict.clone(), ..file };
    let text = mjcf(&file).expect("no loops");
    let foot = |name: &str| text.contains(&format!("name=\"object/{name}/foot-1\""));
    assert!(foot("drawer") && !foot("drawer/bar") && !foot("drawer/post"), "{text}");
    let Some(python) = python() else { return };
    let folder = TempDir::new().expect("a folder");
    let [script, scene] = ["replay.py", "plan.xml"].map(|name| folder.path().join(name));
    fs::write(&script, REPLAY_SCRIPT).expect("written");
    fs::write(&scene, text).expect("written");
    let output = Command::new(python).arg(&script).arg(&scene).output().expect("Python runs");
    let found: Json = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["reached"], true, "{found:#}");
    assert!(found["difference"].as_f64().expect("both") < 3e-3, "{found:#}");
}
