//! Rules in the closed loop: `keep` and `keep_out` hold for whatever the world really is, and names
//! of objects are believed.

use pushplan::asset::load_world;
use pushplan::progress::NoProgress;
use pushplan::solve::{Effort, Planner};
use pushplan::{outcome::Warning, task::Task};
use pushplan_act::act::{ActError, End, Note, RunSettings, Runner, SimulatedWorld, Trace};

use crate::closed_loop::library;

/// Can with a goal beside a vase that must stay.
const KEPT: &str = "
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.08}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}
    - {name: vase, shape: {cylinder: {radius: 0.03, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.5, 0.09]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [finger, paddle]
pushes: {max_count: 2, directions: 8}
goal: {object: can, position: [0.6, 0], tolerance: 0.02}
unknown: [masses, frictions]
keep: {objects: [vase]}
";

/// World in which the vase is attached to the can.
const JOINED: &str = "
joints: [{between: [can, vase], kind: fixed}]
noise: {position: 0.0005, heading_deg: 0.2}
";

/// Objects of which the first must move.
fn exchanged(other: &str) -> Task {
    let text = KEPT.replace("keep: {objects: [vase]}\n", "").replace("[0.6, 0]", "[0.6, 0.03]");
    let vase = "shape: {cylinder: {radius: 0.03, height: 0.1}}, mass: 0.4";
    let text = text.replace(vase, other).replace("[0.5, 0.09]", "[0.5, 0.2]");
    task(&text)
}

const EXCHANGED: &str = "
objects: [{name: can, position: [0.5, 0.2]}, {name: vase, position: [0.5, 0]}]
noise: {position: 0.0005, heading_deg: 0.2}
";

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

/// Runs a task in a world; returns the trace and whether the goals are really reached.
pub fn run_in(task: &Task, world: &str) -> (Result<(), ActError>, Trace, bool) {
    let folder = tempfile::TempDir::new().expect("a folder");
    let path = folder.path().join("world.yaml");
    std::fs::write(&path, world).expect("a file");
    let truth = load_world(&path, task).unwrap_or_else(|faults| panic!("{faults}"));
    let noise = truth.noise;
    let settings = RunSettings { max_pushes: 6, samples: 8, noise, ..RunSettings::default() };
    let mut trace = Trace::new(task.clone(), settings, "draft".into(), Some(truth.clone()));
    let (planner, library) =
        (Planner::for_effort(Effort::Draft).expect("its model").build(), library());
    let mut world = SimulatedWorld::new(truth).pushed_with(task.robot.max_force);
    let runner = Runner::new(&planner, &library);
    let ended = runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress);
    let reached = task.reached(world.state());
    (ended, trace, reached)
}

#[test]
fn a_run_stops_as_soon_as_a_kept_object_is_seen_to_move() {
    let (ended, trace, _) = run_in(&task(KEPT), JOINED);
    ended.expect("it stops and is no error");
    assert_eq!(trace.end, Some(End::RuleBroken));
    let Some(Warning::NotKept { object, moved, within }) = &trace.broken else {
        panic!("{:?}", trace.broken)
    };
    assert!(object == "vase" && moved > within, "{moved}");
    assert_eq!(trace.steps.len(), 1, "nothing is pushed after that");
    // The same world without the rule is no reason to stop.
    let free = task(&KEPT.replace("keep: {objects: [vase]}\n", ""));
    let (ended, trace, _) = run_in(&free, JOINED);
    ended.expect("a run");
    assert!(trace.end != Some(End::RuleBroken) && trace.broken.is_none());
}

#[test]
fn a_kept_object_that_stays_does_not_stop_a_run() {
    let (ended, trace, reached) = run_in(&task(KEPT), "noise: {position: 0.001}");
    ended.expect("a run");
    assert_eq!((trace.end, reached, trace.broken), (Some(End::Reached), true, None));
}

#[test]
fn a_goal_that_is_reached_off_the_table_does_not_excuse_a_broken_rule() {
    let text = KEPT
        .replace("{friction: 0.5}", "{friction: 0.4, size: [0.5, 0.5], position: [0.5, 0]}")
        .replace("[0.5, 0]}\n    - {name: vase", "[0.55, 0.05]}\n    - {name: vase")
        .replace("[0.5, 0.09]", "[0.55, -0.04]")
        .replace("position: [0.6, 0], tolerance: 0.02", "off_table: left");
    let (ended, trace, _) = run_in(&task(&text), JOINED);
    ended.expect("it stops and is no error");
    assert_eq!(trace.end, Some(End::RuleBroken));
}

#[test]
fn a_run_stops_if_an_object_is_seen_in_a_region_to_keep_out_of() {
    let region = "keep_out: [{name: spill, area: {circle: {radius: 0.05}}, position: [0.60, 0.12], for: [objects]}]";
    let text = KEPT.replace("keep: {objects: [vase]}", region);
    // The pair rotates, because the vase is attached to one side, and the can enters the region.
    let (ended, trace, _) = run_in(&task(&text), JOINED);
    ended.expect("it stops and is no error");
    assert_eq!(trace.end, Some(End::RuleBroken));
    assert!(matches!(&trace.broken, Some(Warning::KeptOut { object, .. }) if object == "can"));
    // There from the start.
    let there = "objects: [{name: vase, position: [0.60, 0.12]}]";
    let (_, trace, _) = run_in(&task(&text), there);
    assert_eq!((trace.end, trace.steps.len()), (Some(End::RuleBroken), 0));
}

#[test]
fn names_of_unlike_objects_are_believed_at_first_and_like_ones_stop_the_run() {
    let unlike = exchanged("shape: {cuboid: {size: [0.06, 0.06, 0.1]}}, mass: 0.4");
    let (ended, trace, reached) = run_in(&unlike, EXCHANGED);
    ended.expect("a run");
    assert_eq!(trace.notes, [Note::Elsewhere { object: 0 }, Note::Elsewhere { object: 1 }]);
    assert!(trace.end != Some(End::Reached) || reached, "reached by its own account only");
    let alike = exchanged("shape: {cylinder: {radius: 0.04, height: 0.08}}, mass: 2");
    let (ended, trace, _) = run_in(&alike, EXCHANGED);
    let error = ended.expect_err("it is not known which is which").to_string();
    assert!(error.contains("`can` and `vase` look alike"), "{error}");
    assert_eq!(trace.end, None);
}

#[test]
fn the_command_says_which_rule_was_broken() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        path.to_str().expect("UTF-8").to_owned()
    };
    let (task, world) = (write("kept.yaml", KEPT), write("world.yaml", JOINED));
    let out = folder.path().to_str().expect("UTF-8");
    let asked = ["run", &task, "--world", &world, "--max-pushes", "6", "--samples", "8"];
    let run = |more: &[&str]| crate::program::run(&[&asked[..], &["--out", out], more].concat());
    let text = run(&[]);
    assert_eq!(text.status.code(), Some(9));
    let shown = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(shown.contains("stopped after 1 push, because vase is moved by"), "{shown}");
    let output = run(&["--json"]);
    assert_eq!(output.status.code(), Some(9));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(json["end"], "rule_broken");
    assert_eq!(json["broken"]["not_kept"]["object"], "vase");
    // A run that has stopped stays so.
    assert_eq!(run(&["--resume"]).status.code(), Some(9));
}
