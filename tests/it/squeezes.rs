//! Objects squeezed between a tool and something fixed, and pushes that need too much force.

use std::f64::consts::FRAC_PI_2;

use pushplan::asset::ToolLibrary;
use pushplan::solve::PlanStatus;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    geometry::Vector,
    outcome::{Verdict, Warning},
    scene::{Engine, Situation},
    task::{Plan, Push, PushForm, PushStep, Step, Task},
};

use crate::judged::{file, solved, works_in_mujoco};

fn task(text: &str) -> Task {
    Task::parse(text, "squeeze.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

/// A can in front of a wall that slants across its way.
const BESIDE_A_WALL: &str = "
scene:
  table: {friction: 0.415}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.0423, height: 0.0835}}, mass: 1.167,
       friction: 0.289, position: [0.4608, -0.0909]}
  obstacles:
    - {name: wall, size: [0.148, 0.044, 0.1], position: [0.3081, -0.0777], yaw_deg: -167.7}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [rake]
goal: {object: can, position: [0.3213, 0.0336], tolerance: 0.02}
";

/// Replays a push that rubs the can along the wall.
fn rubbed_along(task: &Task, replays: usize) -> Verdict {
    let tools = ToolLibrary::embedded().expect("the shipped tools");
    let push = Push {
        start: Vector::new(0.608_78, 0.271_039),
        direction: 2.056_8,
        length: 0.252_796,
        speed: 0.1,
    };
    let (tool, grip_yaw, form) = ("rake".to_owned(), -FRAC_PI_2, PushForm::Placed);
    let plan =
        Plan { steps: vec![Step::Push(PushStep { tool, grip_yaw, form, lift: 0.002, push })] };
    let verifier = Verifier::new(VerifySettings { replays, seed: 1 });
    let rake = tools.get("rake").expect("a rake").clone();
    verifier.verify(task, &Situation::stated(&task.scene), &[rake], &plan)
}

fn squeezed(verdict: &Verdict, engine: Engine) -> Option<(Option<String>, f64, f64)> {
    let warnings = &verdict.nominal(engine).expect("a replay").warnings;
    warnings.iter().find_map(|warning| match warning {
        Warning::Squeezed { against, needed, friction } => {
            Some((against.clone(), *needed, *friction))
        }
        _ => None,
    })
}

#[test]
fn a_can_between_tool_and_wall_is_reported_and_a_free_can_is_not() {
    let mut task = task(BESIDE_A_WALL);
    let verdict = rubbed_along(&task, 0);
    let squeezes = [Engine::Planar, Engine::Spatial].map(|engine| squeezed(&verdict, engine));
    let (against, needed, friction) = squeezes.into_iter().flatten().next().expect("a squeeze");
    assert_eq!(against.as_deref(), Some("wall"));
    // The mean friction of can and table times the weight.
    assert!((friction - 0.352 * 1.167 * 9.81).abs() < 1e-6, "{friction}");
    assert!(needed > 4.0 * friction, "{needed}");
    task.scene.obstacles.clear();
    let free = rubbed_along(&task, 0);
    for engine in [Engine::Planar, Engine::Spatial] {
        assert_eq!(squeezed(&free, engine), None);
    }
}

/// The search prefers plans that keep the can off the wall.
#[test]
fn a_plan_without_a_squeeze_comes_first() {
    let task = task(BESIDE_A_WALL);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
    for engine in Engine::ALL {
        assert_eq!(squeezed(verdict, engine), None);
    }
    works_in_mujoco(&file(&task, &solution));
}

/// The can goes around the end of a wall at the outer corner of a fork.
#[test]
fn a_can_passes_the_end_of_a_wall_in_mujoco_too() {
    let task = task(
        "
scene:
  table: {friction: 0.652}
  objects:
    - {name: thing, shape: {cylinder: {radius: 0.0432, height: 0.0633}}, mass: 0.614,
       friction: 0.625, position: [0.5646, -0.2964], yaw_deg: -143}
  obstacles:
    - {name: wall, size: [0.0938, 0.02, 0.1], position: [0.4501, -0.2766], yaw_deg: 260.2}
robot: {home: [0.2, 0.0], reach: {min: 0.15, max: 0.9}}
tools: all
pushes: {max_count: 3, directions: 8}
goal: {object: thing, position: [0.3356, -0.2568], tolerance: 0.02}
",
    );
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    works_in_mujoco(&file(&task, &solution));
}

#[test]
fn solve_states_that_a_push_needs_more_than_an_ordinary_arm() {
    let solution = solved(&task(
        "
scene:
  table: {friction: 0.5}
  objects:
    - {name: safe, shape: {cuboid: {size: [0.2, 0.2, 0.3]}}, mass: 100, friction: 0.8,
       position: [0.5, 0.0]}
robot: {home: [0.3, 0.0], reach: {min: 0.15, max: 0.8}}
tools: [paddle]
goal: {object: safe, position: [0.60, 0.0], tolerance: 0.02}
",
    ));
    let Some(Warning::HardPush { needed }) = solution.warnings.first() else {
        panic!("{:?} {:?}", solution.status, solution.warnings)
    };
    assert!((300.0..2000.0).contains(needed), "{needed}");
}
