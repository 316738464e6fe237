//! Runs on doors and drawers whose true joint differs from the task: stuck, on another hinge, with a
//! shorter travel, or with a spring.

use pushplan::asset::load_world;
use pushplan::{
    JointKind, Push, State, ToolMotion, Vector,
    scene::Engine,
    task::{Task, Truth},
};
use pushplan_act::act::{End, SimulatedWorld, World};

use crate::closed_loop::library;
use crate::run_rules::run_in;

/// Door that opens by rotation to the right, and a drawer behind it.
const FURNITURE: &str = "
scene:
  table: {friction: 0.5}
  objects:
    - {name: door, shape: {cuboid: {size: [0.02, 0.24, 0.15]}}, mass: 1.2, friction: 0.2, position: [0.6, 0.125]}
    - {name: drawer, shape: {cuboid: {size: [0.2, 0.1, 0.1]}}, mass: 1, friction: 0.2, position: [0.6, -0.3]}
  joints:
    - {between: [door, world], kind: revolute, at: [0.6, 0], limits_deg: [-110, 0]}
    - {between: [drawer, frame], kind: prismatic, axis: [1, 0], limits: [0, 0.2]}
  obstacles: [{name: frame, size: [0.3, 0.02, 0.1], position: [0.6, -0.4]}]
robot: {reach: {min: 0.1, max: 0.9}}
tools: [finger, paddle]
pushes: {max_count: 2, directions: 8}
goal: {object: door, joint_deg: -40, heading_tolerance_deg: 8}
unknown: [masses, frictions]
";

const NOISE: &str = "noise: {position: 0.0005, heading_deg: 0.2}";

fn task() -> Task {
    Task::parse(FURNITURE, "furniture.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn load(text: &str) -> Result<Truth, String> {
    let folder = tempfile::TempDir::new().expect("a folder");
    let path = folder.path().join("world.yaml");
    std::fs::write(&path, text).expect("a file");
    load_world(&path, &task()).map_err(|faults| faults.to_string())
}

/// Returns the true state after the finger pushed the door near its free end by 12 cm and was
/// lifted.
fn pushed(world: &str, engine: Engine) -> State {
    let truth = Truth { engine, ..load(world).unwrap_or_else(|faults| panic!("{faults}")) };
    let finger = library().get("finger").expect("a shipped tool").clone();
    let push = Push { start: Vector::new(0.57, 0.2), direction: 0.0, length: 0.12, speed: 0.1 };
    let mut world = SimulatedWorld::new(truth);
    let motion = ToolMotion::pushes(finger, 0.002, 0.0, &[push], true);
    world.act(&motion).expect("nothing falls");
    world.state().clone()
}

#[test]
fn joints_to_the_world_are_read_and_checked() {
    let door = |more: &str| format!("joints: [{{between: [door, world], {more}}}]");
    let truth = load(&door("kind: revolute, at: [0.6, 0.25], limits_deg: [-10, 0], spring: 2"));
    let scene = truth.expect("a world").scene;
    // The joint of the drawer is the task's.
    assert_eq!(scene.mounts.iter().map(|mount| mount.object).collect::<Vec<_>>(), [1, 0]);
    let JointKind::Revolute { at, .. } = scene.mounts[1].kind else { panic!("a hinge") };
    assert_eq!((at, scene.mounts[1].spring), (Vector::new(0.6, 0.25), 2.0));
    let stuck = load("joints: [{between: [frame, drawer], kind: fixed}]").expect("a world").scene;
    assert_eq!(stuck.mounts[1].kind, JointKind::Fixed);
    for (joints, words) in [
        (door("kind: revolute"), "needs `at`"),
        (door("kind: fixed, spring: 3"), "cannot have a spring"),
        (door("kind: revolute, at: [0.6, 0], limits_deg: [5, 20]"), "the start violates"),
        (door("kind: fixed").replace("door", "dor"), "no object `dor`"),
        (door("kind: fixed").replace("world", "wold"), "no object `wold`"),
        (door("kind: fixed").replace("door", "frame"), "no object `frame`"),
        (door("kind: fixed}, {between: [world, door], kind: fixed"), "to the world twice"),
        (door("kind: fixed}, {between: [door, drawer], kind: fixed"), "closes a loop"),
    ] {
        let fault = load(&joints).expect_err(&joints);
        assert!(fault.contains(words), "{joints}: {fault}");
    }
}

#[test]
fn both_engines_move_a_door_as_its_true_joint_allows() {
    for engine in [Engine::Planar, Engine::Spatial] {
        let turned = |world: &str| {
            let start = task().scene.objects[0].pose;
            let end = pushed(world, engine).poses[0];
            ((end.heading - start.heading).to_degrees(), (end.position - start.position).norm())
        };
        let door = |more: &str| format!("joints: [{{between: [door, world], {more}}}]\n{NOISE}");
        let (stated, _) = turned(NOISE);
        assert!(stated < -25.0, "{stated}");
        let (stuck, moved) = turned(&door("kind: fixed"));
        assert!(stuck.abs() < 2.0 && moved < 5e-3, "{stuck} deg, {moved} m");
        let (short, _) = turned(&door("kind: revolute, at: [0.6, 0], limits_deg: [-10, 0]"));
        assert!((-13.0..-8.0).contains(&short), "{short}");
        let (other, _) = turned(&door("kind: revolute, at: [0.6, 0.25], limits_deg: [-110, 110]"));
        assert!(other > 1.0, "the other hinge lets it turn the other way: {other}");
        let springy = "kind: revolute, at: [0.6, 0], limits_deg: [-110, 0], spring: 20";
        let (springy, _) = turned(&door(springy));
        assert!(springy > -8.0, "the spring closes it again: {springy}");
    }
}

#[test]
fn a_run_opens_a_door_and_says_so_only_if_it_is_open() {
    let task = task();
    let (ended, trace, reached) = run_in(&task, NOISE);
    ended.expect("a run");
    assert_eq!((trace.end, reached), (Some(End::Reached), true));
    for more in [
        "kind: fixed",
        "kind: revolute, at: [0.6, 0], limits_deg: [-15, 0]",
        "kind: revolute, at: [0.6, 0], limits_deg: [-110, 0], spring: 30",
    ] {
        let world = format!("joints: [{{between: [door, world], {more}}}]\n{NOISE}");
        let (_, trace, reached) = run_in(&task, &world);
        assert!(!reached && trace.end != Some(End::Reached), "{more}: {:?}", trace.end);
    }
}

#[test]
fn a_run_opens_a_drawer_and_says_so_only_if_it_is_open() {
    let goal = "goal: {object: drawer, joint: 0.1, tolerance: 0.02}";
    let door = "goal: {object: door, joint_deg: -40, heading_tolerance_deg: 8}";
    let task = Task::parse(&FURNITURE.replace(door, goal), "furniture.yaml").expect("a task");
    let (ended, trace, reached) = run_in(&task, NOISE);
    ended.expect("a run");
    assert_eq!((trace.end, reached), (Some(End::Reached), true));
    let short = "kind: prismatic, axis: [1, 0], limits: [0, 0.04]";
    for more in ["kind: fixed", short] {
        let world = format!("joints: [{{between: [drawer, frame], {more}}}]\n{NOISE}");
        let (_, trace, reached) = run_in(&task, &world);
        assert!(!reached && trace.end != Some(End::Reached), "{more}: {:?}", trace.end);
    }
}
