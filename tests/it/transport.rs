//! Plans of many pushes: objects are transported along legs, one after another, and a run continues
//! across pushes.

use pushplan::asset::ToolLibrary;
use pushplan::progress::NoProgress;
use pushplan::{Effort, PlanStatus, Planner, Pose, Shape};
use pushplan::{
    scene::{Part, Tool},
    task::Task,
};
use pushplan_act::act::{End, RunSettings, Runner, SimulatedWorld, Trace, Why, hidden};

const SLALOM: &str = "
description: A can is pushed around the ends of three walls in a closed yard.
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.3, friction: 0.4, position: [0.45, 0.35]}
  obstacles:
    - {name: front, size: [0.02, 1.08, 0.08], position: [0.29, 0.00]}
    - {name: back, size: [0.02, 1.08, 0.08], position: [1.06, 0.00]}
    - {name: left, size: [0.79, 0.02, 0.08], position: [0.675, 0.53]}
    - {name: right, size: [0.79, 0.02, 0.08], position: [0.675, -0.53]}
    - {name: wall-1, size: [0.50, 0.02, 0.08], position: [0.55, 0.20]}
    - {name: wall-2, size: [0.50, 0.02, 0.08], position: [0.80, 0.00]}
    - {name: wall-3, size: [0.50, 0.02, 0.08], position: [0.55, -0.20]}
robot: {reach: {min: 0, max: 1.5}, base: none}
tools: [plate]
pushes: {length: 0.2, max_count: 12, grip_yaws_deg: [0, 90]}
goal: {object: can, position: [0.45, -0.35], tolerance: 0.02}
";

const CORRIDOR: &str = "
description: A box is pushed through a corridor with turns, which nothing leaves.
scene:
  table: {friction: 0.4}
  objects:
    - {name: box, shape: {cuboid: {size: [0.07, 0.07, 0.05]}}, mass: 0.2, friction: 0.3, position: [0.45, 0.40]}
  obstacles:
    - {name: front, size: [0.02, 1.06, 0.08], position: [0.28, 0.00]}
    - {name: back, size: [0.02, 1.06, 0.08], position: [0.92, 0.00]}
    - {name: left, size: [0.66, 0.02, 0.08], position: [0.60, 0.53]}
    - {name: right, size: [0.66, 0.02, 0.08], position: [0.60, -0.53]}
    - {name: turn-1, size: [0.47, 0.02, 0.08], position: [0.52, 0.29]}
    - {name: turn-2, size: [0.47, 0.02, 0.08], position: [0.68, 0.10]}
    - {name: turn-3, size: [0.47, 0.02, 0.08], position: [0.52, -0.09]}
    - {name: turn-4, size: [0.47, 0.02, 0.08], position: [0.68, -0.28]}
robot: {reach: {min: 0, max: 1.5}, base: none}
tools: [plate]
pushes: {length: 0.35, max_count: 12, grip_yaws_deg: [0, 90]}
goal: {object: box, position: [0.78, -0.40], tolerance: 0.02}
";

const CROWD: &str = "
description: A crate is pushed through a lane in which four cans stand.
scene:
  table: {friction: 0.5}
  objects:
    - {name: crate, shape: {cuboid: {size: [0.10, 0.10, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.40, 0.00]}
    - {name: can-1, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.2, friction: 0.4, position: [0.56, 0.02]}
    - {name: can-2, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.2, friction: 0.4, position: [0.68, -0.03]}
    - {name: can-3, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.2, friction: 0.4, position: [0.80, 0.03]}
    - {name: can-4, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.2, friction: 0.4, position: [0.96, -0.02]}
  obstacles:
    - {name: left, size: [0.62, 0.02, 0.08], position: [0.61, 0.11]}
    - {name: right, size: [0.62, 0.02, 0.08], position: [0.61, -0.11]}
    - {name: back, size: [0.02, 0.40, 0.08], position: [1.05, 0.00]}
robot: {reach: {min: 0, max: 1.5}, base: none}
tools: [plate]
pushes: {length: 0.3, max_count: 12, grip_yaws_deg: [0, 90]}
goal: {object: crate, position: [0.95, 0.00], tolerance: 0.02}
";

const SWAP: &str = "
description: Two boxes exchange their places in a closed yard.
scene:
  table: {friction: 0.4}
  objects:
    - {name: one, shape: {cuboid: {size: [0.06, 0.06, 0.05]}}, mass: 0.2, friction: 0.3, position: [0.45, 0.12]}
    - {name: two, shape: {cuboid: {size: [0.06, 0.06, 0.05]}}, mass: 0.2, friction: 0.3, position: [0.45, -0.12]}
  obstacles:
    - {name: front, size: [0.02, 0.80, 0.08], position: [0.30, 0.00]}
    - {name: back, size: [0.02, 0.80, 0.08], position: [0.90, 0.00]}
robot: {reach: {min: 0, max: 1.5}, base: none}
tools: [plate]
pushes: {length: 0.3, max_count: 12, grip_yaws_deg: [0, 90]}
goal:
  - {object: one, position: [0.45, -0.12], tolerance: 0.02}
  - {object: two, position: [0.45, 0.12], tolerance: 0.02}
";

const BEHIND: &str = "
description: A tool that stays down goes around a box and pushes it back.
scene:
  table: {friction: 0.4}
  objects:
    - {name: box, shape: {cuboid: {size: [0.07, 0.07, 0.05]}}, mass: 0.2, friction: 0.3, position: [0.60, 0.00]}
  obstacles:
    - {name: left, size: [0.40, 0.02, 0.08], position: [0.60, 0.25]}
robot: {reach: {min: 0, max: 1.5}, base: none, home: [0.40, 0.00]}
tools: [plate]
pushes: {form: chained, length: 0.4, max_count: 12}
goal: {object: box, position: [0.48, 0.00], tolerance: 0.02}
";

/// Returns the shipped tools and an upright plate that comes from above.
fn library() -> ToolLibrary {
    let shape = Shape::Cuboid { size: [0.03, 0.06, 0.06] };
    let plate = Tool::new("plate", [Part::new("plate", shape, Pose::default())]);
    ToolLibrary::embedded().unwrap().with(plate.unwrap().friction(0.5)).unwrap()
}

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

/// Returns a run in a world that matches the task, with observation noise.
fn run(task: &Task) -> Trace {
    let (library, planner) = (library(), Planner::for_effort(Effort::Draft).unwrap().build());
    let truth = hidden(task, &library, 1).unwrap();
    let settings = RunSettings { noise: truth.noise, max_pushes: 16, ..RunSettings::default() };
    let mut trace = Trace::new(task.clone(), settings, "draft".into(), Some(truth.clone()));
    let mut world = SimulatedWorld::new(truth);
    let runner = Runner::new(&planner, &library);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).unwrap();
    assert_eq!(trace.end == Some(End::Reached), task.goals[0].reached(world.state()));
    trace
}

#[test]
fn a_plan_of_nine_pushes_works_as_written() {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let solution = planner.solve(&task(CORRIDOR), &library()).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    assert!(solution.plans[0].plan.steps.len() > 6, "{}", solution.plans[0].plan.steps.len());
}

#[test]
fn boxes_that_exchange_places_are_parked() {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let solution = planner.solve(&task(SWAP), &library()).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    // One box must leave its place before the other comes, and go to the other's.
    assert!(solution.plans[0].plan.steps.len() > 3, "{}", solution.plans[0].plan.steps.len());
}

#[test]
fn a_tool_that_stays_down_goes_around() {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let solution = planner.solve(&task(BEHIND), &library()).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    let steps = &solution.plans[0].plan.steps;
    // Aside, past the box, behind it, and back.
    assert!(steps.len() >= 4, "{}", steps.len());
}

#[test]
fn a_run_goes_on_however_many_pushes_are_left() {
    for (text, least) in [(SLALOM, 8), (CORRIDOR, 8), (CROWD, 6)] {
        let task = task(text);
        let trace = run(&task);
        assert_eq!(trace.end, Some(End::Reached), "{}", task.description);
        assert!(trace.steps.len() >= least, "{}: {}", task.description, trace.steps.len());
        // The first pushes do not start a plan, which would be too long.
        assert_eq!(trace.steps[0].why, Why::Approach, "{}", task.description);
    }
}

#[test]
fn where_no_way_leads_nothing_is_approached() {
    let shut = CORRIDOR.replace(
        "size: [0.47, 0.02, 0.08], position: [0.52, -0.09]",
        "size: [0.66, 0.02, 0.08], position: [0.60, -0.09]",
    );
    assert_ne!(shut, CORRIDOR);
    let task = task(&shut);
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let situation = pushplan::scene::Situation::stated(&task.scene);
    let found = planner.approach(&situation, &task, &library(), 1, &NoProgress).unwrap();
    assert!(found.is_none());
}
