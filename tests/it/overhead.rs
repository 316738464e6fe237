//! Obstacles above the table: passage below them, collisions, and access of a tool.

use std::fs;
use std::process::Command;
use std::sync::Arc;

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::geometry::Vector;
use pushplan::sim::Simulator;
use pushplan::solve::{Effort, PlanStatus, Planner, Solution};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    outcome::{Record, Warning},
    scene::{Situation, Tool},
    task::{Job, Plan, Push, PushForm, Task, ToolMotion},
};
use pushplan_export::{REPLAY_SCRIPT, mjcf};
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::mujoco_python::python;

/// Tin in front of a shelf whose underside is 9 cm above the table, and whose top is above the
/// lower end of the hand.
const SHELF: &str = "
scene:
  objects:
    - {name: tin, shape: {cylinder: {radius: 0.04, height: 0.07}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}
  obstacles:
    - {name: shelf, size: [0.3, 0.6, 0.1], position: [0.72, 0, 0.09]}
robot: {reach: {min: 0.25, max: 0.95}}
tools: [stick]
pushes: {directions: 8, max_count: 2}
goal: {object: tin, position: [0.66, 0.02], tolerance: 0.02}
";

fn task(text: &str) -> Task {
    Task::parse(text, "shelf.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn solved(task: &Task) -> Solution {
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    planner.solve(task, &library()).expect("a sound task")
}

fn file(task: &Task, solution: &Solution) -> PlanFile {
    let best = solution.best().expect("a plan");
    let file = PlanFile::new(task.clone(), best.tools.clone(), best.plan.clone());
    PlanFile { verdict: best.verdict.clone(), ..file }
}

/// Returns the result of MuJoCo for a plan, if available.
fn in_mujoco(file: &PlanFile) -> Option<Json> {
    let python = python()?;
    let folder = TempDir::new().expect("a folder");
    let [script, scene] = ["replay.py", "plan.xml"].map(|name| folder.path().join(name));
    fs::write(&script, REPLAY_SCRIPT).expect("written");
    fs::write(&scene, mjcf(file).expect("no loops")).expect("written");
    let output = Command::new(python).arg(&script).arg(&scene).output().expect("Python runs");
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    Some(serde_json::from_str(&lines).unwrap_or_else(|_| {
        panic!("{}", String::from_utf8_lossy(&output.stderr));
    }))
}

#[test]
fn low_objects_are_pushed_below_a_shelf_with_the_hand_outside() {
    let task = task(SHELF);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    let half = Vector::new(0.15 + 0.05, 0.3 + 0.05);
    for push in best.plan.pushes() {
        for at in [push.start, push.end()] {
            let off = at - Vector::new(0.72, 0.0);
            assert!(off.x.abs() > half.x || off.y.abs() > half.y, "the hand is below the shelf");
        }
    }
    if let Some(found) = in_mujoco(&file(&task, &solution)) {
        assert_eq!(found["reached"], true, "{found:#}");
        assert!(found["difference"].as_f64().expect("both") < 3e-3, "{found:#}");
    }
    // With a hand that reaches below the shelf's underside, only a long tool works.
    let short = SHELF.replace("[stick]", "[paddle]").replace("[0.66, 0.02]", "[0.75, 0.02]");
    assert_ne!(solved(&self::task(&short)).status, PlanStatus::Solved);
    let bodiless = short.replace("max: 0.95}", "max: 0.95}, hand: none");
    assert_eq!(solved(&self::task(&bodiless)).status, PlanStatus::Solved);
}

/// Returns a push of the tin by 25 cm to below the shelf, with a stick from behind.
fn pushed(text: &str) -> (Task, Arc<Tool>, Push) {
    let tool = library().get("stick").expect("a shipped tool").clone();
    let start = Vector::new(0.5 - 0.04 - 0.005 - 0.61, 0.0);
    (task(text), tool, Push { start, direction: 0.0, length: 0.25, speed: 0.1 })
}

#[test]
fn tall_objects_are_stopped_by_the_shelf_in_every_engine_and_low_ones_are_not() {
    let tall = SHELF.replace("height: 0.07", "height: 0.12").replace("[0.66, 0.02]", "[0.4, 0.02]");
    for (text, passes) in [(SHELF, true), (tall.as_str(), false)] {
        let (task, tool, push) = pushed(text);
        let motion = ToolMotion::pushes(tool, 0.002, 0.0, &[push], true);
        let job = Job::stated(&task.scene, motion);
        for simulator in [Simulator::planar(), Simulator::spatial(), Simulator::upright()] {
            let found = simulator.run(&task.scene, &job, Record::Outcome);
            let x = found.outcome().poses[0].position.x;
            let jams = found
                .warnings
                .iter()
                .any(|w| matches!(w, Warning::Jammed { .. } | Warning::Toppled { .. }));
            assert_eq!((x > 0.7, jams), (passes, !passes), "{x} {:?}", found.warnings);
        }
    }
    // A place with room only for low objects is a valid goal only for them.
    let there = SHELF.replace("height: 0.07", "height: 0.12");
    let faults = Task::parse(&there, "there.yaml").expect_err("no room").to_string();
    assert!(faults.contains("at the goal `tin` would overlap `shelf`"), "{faults}");
    let sunk = SHELF.replace("0.72, 0, 0.09", "0.72, 0, -0.02");
    let faults = Task::parse(&sunk, "sunk.yaml").expect_err("below the table").to_string();
    assert!(faults.contains("below the table"), "{faults}");
}

#[test]
fn nothing_is_set_down_through_a_shelf() {
    let beyond = SHELF
        .replace("min: 0.25", "min: 0")
        .replace("max: 0.95}", "max: 0.95}, hand: none, base: none");
    let (task, tool, push) = pushed(&beyond);
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let forbidden = |start: Vector| {
        let push = Push { start, length: 0.1, ..push };
        let plan = Plan::pushing(&tool.name, 0.0, PushForm::Placed, 0.002, [push]);
        verifier
            .nominal(&task, &Situation::stated(&task.scene), std::slice::from_ref(&tool), &plan)
            .forbidden
    };
    assert!(forbidden(push.start).is_empty(), "{:?}", forbidden(push.start));
    // The stick's end would come down on the shelf, which is above its start position.
    let through = forbidden(push.start + Vector::new(0.2, 0.0));
    let expected = |through: &[Warning]| {
        matches!(
            through,
            [Warning::ThroughObstacle { push: 0, .. }, Warning::NotLifted { push: 0, .. }]
        )
    };
    assert!(expected(&through), "{through:?}");
}

#[test]
fn a_shelf_and_a_region_are_written_read_and_drawn() {
    let text = format!(
        "{SHELF}keep_out: [{{name: cable, area: {{circle: {{radius: 0.05}}}}, position: [0.5, 0.3]}}]\n"
    );
    let task = task(&text);
    let again =
        Task::parse(&task.to_yaml().expect("a file"), "again.yaml").expect("the written task");
    assert_eq!(again, task);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let document = pushplan_report::solution_document(&task, &solution);
    let text = document.to_text();
    assert!(!text.contains("obstacle above"), "{text}");
    let scene = mjcf(&file(&task, &solution)).expect("no loops");
    assert!(
        scene.contains("name=\"region/cable\"") && scene.contains("pos=\"0.72 0 0.14\""),
        "{scene}"
    );
}

#[test]
fn a_second_push_is_made_where_the_lifted_tool_gets_to() {
    let wall = |height: f64, width: f64| {
        let wall = format!("[0.02, {width}, {height}], position: [0.62, 0]");
        SHELF
            .replace("[0.3, 0.6, 0.1], position: [0.72, 0, 0.09]", &wall)
            .replace("[stick]", "[finger]")
            .replace("[0.66, 0.02]", "[0.45, 0.02]")
    };
    // One on either side of the wall.
    let pushes = [0.42, 0.72].map(|x| Push {
        start: Vector::new(x, 0.2),
        direction: -0.5 * std::f64::consts::PI,
        length: 0.1,
        speed: 0.1,
    });
    let tool = library().get("finger").expect("a shipped tool").clone();
    let plan = Plan::pushing(&tool.name, 0.0, PushForm::Placed, 0.002, pushes);
    let forbidden = |text: &str| {
        let task = task(text);
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        let situation = Situation::stated(&task.scene);
        verifier.nominal(&task, &situation, std::slice::from_ref(&tool), &plan).forbidden
    };
    assert!(forbidden(&wall(0.25, 3.0)).is_empty(), "the wall is lower than tools are lifted");
    assert!(forbidden(&wall(0.5, 0.3)).is_empty(), "there is a way around the wall");
    let blocked = forbidden(&wall(0.5, 3.0));
    assert!(
        matches!(&blocked[..], [Warning::NoWay { push: 1, obstacle, .. }] if obstacle == "shelf"),
        "{blocked:?}"
    );
    let higher = wall(0.5, 3.0).replace("max: 0.95}", "max: 0.95}, travel: 0.6");
    assert!(forbidden(&higher).is_empty(), "the task states their heights");
}
