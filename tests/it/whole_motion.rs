//! Motions from home to home: pens, fences, overhangs, keep-out strips, and the body of the robot.

use pushplan::asset::ToolLibrary;
use pushplan::outcome::step_states;
use pushplan::scene::Robot;
use pushplan::solve::{Effort, PlanStatus, Planner, Solution};
use pushplan::task::Task;

/// Returns the answer for a task in the folder `at`.
fn answer(text: &str) -> (Task, Solution) {
    let task = Task::parse(text, "motion.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    let solution = planner.solve(&task, &library).expect("a sound task");
    (task, solution)
}

/// Returns the status for a can that is pushed by 10 cm, with these obstacles and the rest of the
/// file.
fn can(bodies: &str, rest: &str) -> PlanStatus {
    let text = format!(
        "scene:
  objects:
    - {{name: can, shape: {{cylinder: {{radius: 0.03, height: 0.08}}}}, mass: 0.4, friction: 0.4, position: [0.6, 0]}}
{bodies}
tools: [finger, paddle]
pushes: {{directions: 8, max_count: 2}}
goal: {{object: can, position: [0.6, 0.1], tolerance: 0.02}}
{rest}
"
    );
    answer(&text).1.status
}

/// Walls of a pen around the can, `high` metres, the one in front `front` metres.
fn pen(high: f64, front: f64) -> String {
    format!(
        "  obstacles:
    - {{name: front, size: [0.02, 0.5, {front}], position: [0.4, 0.03]}}
    - {{name: back, size: [0.02, 0.5, {high}], position: [0.84, 0.03]}}
    - {{name: left, size: [0.42, 0.02, {high}], position: [0.62, 0.29]}}
    - {{name: right, size: [0.42, 0.02, {high}], position: [0.62, -0.23]}}
robot: {{reach: {{min: 0.2, max: 0.95}}}}"
    )
}

#[test]
fn what_stands_in_a_closed_pen_is_out_of_reach() {
    assert_eq!(can(&pen(0.45, 0.45), ""), PlanStatus::NoPlan);
    assert_eq!(can(&pen(3.0, 3.0), ""), PlanStatus::NoPlan);
    // The lifted tool passes over a wall that is lower than it.
    assert_eq!(can(&pen(0.45, 0.2), ""), PlanStatus::Solved);
}

#[test]
fn loose_posts_across_the_reach_are_not_travelled_through() {
    let posts = |height: f64| {
        let post = |k: usize| {
            format!(
                "    - {{name: p{k}, shape: {{cuboid: {{size: [0.05, 0.098, {height}]}}}}, mass: 3, friction: 0.4, position: [0.45, {:.2}]}}",
                -0.95 + 0.1 * k as f64
            )
        };
        let posts: Vec<String> = (0..20).map(post).collect();
        format!("{}\nrobot: {{reach: {{min: 0.2, max: 0.95}}}}", posts.join("\n"))
    };
    assert_ne!(can(&posts(0.6), ""), PlanStatus::Solved);
}

#[test]
fn keep_out_strips_bind_the_lifted_tool() {
    let robot = "robot: {reach: {min: 0.2, max: 0.95}}";
    let strip = |x: f64| {
        format!(
            "keep_out:\n  - {{name: strip, area: {{rectangle: {{size: [0.05, 2.0]}}}}, position: [{x}, 0], for: [tool, hand]}}"
        )
    };
    assert_eq!(can(robot, &strip(0.42)), PlanStatus::NoPlan);
    assert_eq!(can(robot, &strip(0.85)), PlanStatus::Solved);
}

#[test]
fn a_tool_below_a_shelf_is_drawn_out_before_it_is_lifted() {
    let (task, solution) = answer(
        "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.05}}, mass: 0.4, friction: 0.4, position: [0.47, 0]}
  obstacles:
    - {name: shelf, size: [0.34, 0.6, 0.02], position: [0.73, 0, 0.056]}
robot: {reach: {min: 0.1, max: 0.95}}
tools: [paddle]
pushes: {length: 0.3, directions: 8, max_count: 2}
goal: {object: can, position: [0.7, 0], tolerance: 0.02}
",
    );
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    let evidence = best.verdict.as_ref().map_or(&[][..], |verdict| &verdict.evidence);
    let states = step_states(&task.scene.start(), best.plan.steps.len(), evidence);
    let legs = task.legs(&task.scene, &best.tools, &best.plan, &states).expect("ways");
    let tool = &best.tools[0];
    for leg in legs.iter().filter(|leg| leg.from.is_some()) {
        let held = pushplan::geometry::Pose { position: leg.path[0], heading: leg.yaws[0] };
        let frame = tool.pose(held);
        let ahead = tool.parts().iter().map(|part| {
            let at = frame * part.pose;
            at.position.x + part.footprint().bounding_radius()
        });
        let tip = ahead.fold(f64::NEG_INFINITY, f64::max);
        assert!(tip < 0.60, "the tip is at {tip}");
    }
}

#[test]
fn a_kept_turnstile_does_not_turn() {
    let (_, solution) = answer(
        "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.07}}, mass: 0.4, friction: 0.4, position: [0.45, 0.1]}
    - {name: fan, shape: {cuboid: {size: [0.03, 0.26, 0.07]}}, mass: 0.3, friction: 0.1, position: [0.58, 0]}
  joints:
    - {between: [fan, world], kind: revolute, at: [0.58, 0]}
robot: {reach: {min: 0.05, max: 0.95}}
tools: [paddle]
pushes: {max_count: 1, length: 0.3, directions: 8}
goal: {object: can, position: [0.68, 0.09], tolerance: 0.02}
keep: {objects: [fan]}
",
    );
    assert_ne!(solution.status, PlanStatus::Solved);
}

#[test]
fn a_robot_has_a_body_unless_the_task_states_none() {
    let robot = |text: &str| {
        let file = format!(
            "scene: {{objects: [{{name: can, shape: {{cylinder: {{radius: 0.03, height: 0.08}}}}, mass: 0.4, friction: 0.4, position: [0.6, 0]}}]}}
robot: {text}
tools: [finger]
goal: {{object: can, position: [0.6, 0.1], tolerance: 0.02}}
"
        );
        Task::parse(&file, "robot.yaml").map(|task| task.robot)
    };
    let usual = robot("{reach: {max: 0.9}}").expect("sound");
    assert!((usual.base - 0.08).abs() < 1e-12 && (usual.reach_min - 0.14).abs() < 1e-12);
    assert!((usual.home.x - 0.14).abs() < 1e-12);
    let near = robot("{reach: {min: 0, max: 0.9}}").expect("sound");
    assert!((near.base - 0.04).abs() < 1e-12 && near.reach_min == 0.0);
    let none = robot("{reach: {max: 0.9}, base: none}").expect("sound");
    assert_eq!((none.base, none.reach_min), (0.0, 0.0));
    let bare = robot("{reach: {max: 0.9}, hand: none}").expect("sound");
    assert!((bare.reach_min - 0.09).abs() < 1e-12);
    assert_eq!(usual.column().map(|column| column.name), Some(Robot::BASE.into()));
}

#[test]
fn nothing_is_pushed_through_the_base_or_into_the_foot_of_an_arm() {
    let (_, solution) = answer(
        "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.035, height: 0.08}}, mass: 0.4, friction: 0.4, position: [0.153, 0.158]}
robot: {reach: {min: 0, max: 0.9}}
tools: [hook]
pushes: {length: 0.5, directions: 16, max_count: 1}
goal: {object: can, position: [-0.153, -0.158], tolerance: 0.02}
",
    );
    assert_ne!(solution.status, PlanStatus::Solved);
}
