//! Causes of missing plans: each small task has one cause, and its remedy makes the task solvable.

use pushplan::asset::ToolLibrary;
use pushplan::outcome::{SHOWN_WARNINGS, warning_lines};
use pushplan::solve::{Cause, Effort, PlanStatus, Planner, Solution};
use pushplan::task::Task;
use pushplan_report::solution_document;

const CAN: &str = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.42, 0.05]}
robot: {reach: {min: 0.2, max: 0.9}}
tools: all
pushes: {directions: 8, max_count: 1}
goal: {object: can, position: [0.77, 0.05], tolerance: 0.015}
";

fn solved(text: &str) -> (Task, Solution) {
    let task = Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let planner = Planner::for_effort(Effort::Standard).expect("its models").build();
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let solution = planner.solve(&task, &library).expect("a sound task");
    (task, solution)
}

/// Returns the cause of a task without a working plan, and checks that the headline states it.
fn cause(text: &str) -> Cause {
    let (task, solution) = solved(text);
    let missing = [PlanStatus::NoPlan, PlanStatus::FailedVerification];
    assert!(missing.contains(&solution.status), "{:?} {text}", solution.status);
    let title = solution_document(&task, &solution).title;
    let cause = solution.cause.unwrap_or_else(|| panic!("no cause: {title}"));
    assert!(title.contains(&cause.to_string()), "{title}");
    cause
}

fn assert_solvable(text: &str) {
    let (task, solution) = solved(text);
    let title = solution_document(&task, &solution).title;
    assert_eq!(solution.status, PlanStatus::Solved, "{title}");
}

/// Returns `CAN` with obstacles, one a line.
fn with_obstacles(obstacles: &[&str]) -> String {
    let lines: String = obstacles.iter().map(|one| format!("    - {one}\n")).collect();
    CAN.replace("robot:", &format!("  obstacles:\n{lines}robot:"))
}

#[test]
fn a_way_that_is_longer_than_all_pushes_is_told_at_once() {
    let Cause::TooFewPushes { distance, needed, .. } = cause(CAN) else { panic!("too short") };
    assert!((distance - 0.35).abs() < 1e-9);
    let longer = format!("max_count: 1, length: {needed:.2}");
    assert_solvable(&CAN.replace("max_count: 1", &longer));
    assert_solvable(&CAN.replace("max_count: 1", "max_count: 2"));
    let (_, solution) = solved(CAN);
    assert_eq!(solution.statistics.search.considered, 0);
}

#[test]
fn a_goal_or_an_object_farther_than_arm_and_tool_is_told_at_once() {
    let goal = CAN.replace("[0.77, 0.05]", "[2.0, 0.05]").replace(", max_count: 1", "");
    let object = CAN.replace("[0.42, 0.05]", "[2.0, 0.05]").replace(", max_count: 1", "");
    for text in [goal, object] {
        let (task, solution) = solved(&text);
        let Some(Cause::Beyond { needed, length, .. }) = solution.cause else {
            panic!("{}", solution_document(&task, &solution).title)
        };
        assert!(solution.statistics.rollouts <= 1, "{}", solution.statistics.rollouts);
        let length = length.expect("0.9 m do not suffice");
        let wider = text.replace("max: 0.9", &format!("max: {needed:.2}"));
        assert_solvable(
            &wider.replace("directions: 8", &format!("directions: 8, length: {length:.2}")),
        );
    }
}

#[test]
fn more_pushes_are_needed_around_a_wall() {
    let wall = with_obstacles(&["{name: wall, size: [0.02, 0.2, 0.15], position: [0.54, 0.05]}"]);
    let wall = wall.replace("[0.77, 0.05]", "[0.66, 0.05]").replace("0.015", "0.02");
    let Cause::Pushes { allowed: 1, needed } = cause(&wall) else { panic!("one push only") };
    assert_solvable(&wall.replace("max_count: 1", &format!("max_count: {needed}")));
}

#[test]
fn a_force_that_the_robot_lacks_is_stated_without_many_replays() {
    let crate_ = CAN
        .replace("cylinder: {radius: 0.04, height: 0.1}", "cuboid: {size: [0.12, 0.12, 0.12]}")
        .replace("mass: 0.4", "mass: 30")
        .replace("max: 0.9}", "max: 0.9}, max_force: 80")
        .replace("[0.77, 0.05]", "[0.57, 0.05]")
        .replace(", max_count: 1", "");
    let (_, solution) = solved(&crate_);
    let Some(Cause::Force { object: None, allowed: 80.0, needed }) = solution.cause else {
        panic!("{:?}", solution.cause)
    };
    assert!((100.0..400.0).contains(&needed), "{needed}");
    assert!(solution.statistics.verified <= 12, "{}", solution.statistics.verified);
    assert_solvable(&crate_.replace("max_force: 80", &format!("max_force: {needed}")));
}

#[test]
fn a_hand_between_high_walls_is_named_with_the_wall() {
    let walls = with_obstacles(&[
        "{name: left, size: [0.34, 0.02, 0.4], position: [0.44, 0.11]}",
        "{name: right, size: [0.34, 0.02, 0.4], position: [0.44, -0.01]}",
    ]);
    let walls = walls
        .replace("[0.42, 0.05]", "[0.50, 0.05]")
        .replace("[0.77, 0.05]", "[0.60, 0.05]")
        .replace("tools: all", "tools: [finger]");
    let Cause::Hand { meets } = cause(&walls) else { panic!("the hand does not fit") };
    assert!(meets.iter().any(|name| name == "left" || name == "right"), "{meets:?}");
    assert_solvable(&walls.replace("max: 0.9}", "max: 0.9}, hand: none"));
}

#[test]
fn walls_around_an_object_are_listed_with_one_to_remove() {
    let all = [
        "{name: north, size: [0.24, 0.02, 0.12], position: [0.5, 0.16]}",
        "{name: south, size: [0.24, 0.02, 0.12], position: [0.5, -0.06]}",
        "{name: east, size: [0.02, 0.2, 0.12], position: [0.61, 0.05]}",
        "{name: west, size: [0.02, 0.2, 0.12], position: [0.39, 0.05]}",
    ];
    let text = |walls: &[&str]| {
        let text = with_obstacles(walls).replace("[0.42, 0.05]", "[0.50, 0.05]");
        text.replace("max_count: 1", "max_count: 3").replace("[0.77, 0.05]", "[0.74, 0.05]")
    };
    let Cause::Enclosed { subject, by, open } = cause(&text(&all)) else { panic!("a pen") };
    assert_eq!((subject.as_str(), by.len()), ("`can`", 4));
    let is_left = |wall: &&str| !open.iter().any(|name| wall.contains(&format!("name: {name},")));
    let left: Vec<&str> = all.into_iter().filter(is_left).collect();
    assert!(left.len() < all.len());
    assert_solvable(&text(&left));
}

#[test]
fn kept_objects_are_named() {
    let vase = "\n    - {name: vase, shape: {cylinder: {radius: 0.05, height: 0.1}}, mass: 0.4, \
                friction: 0.4, position: [0.56, 0.05]}\nrobot:";
    let kept = CAN.replace("\nrobot:", vase).replace("[0.77, 0.05]", "[0.60, 0.05]");
    let kept = kept.replace("directions: 8", "directions: [0]");
    let Cause::Kept { names } = cause(&format!("{kept}keep: {{objects: [vase]}}\n")) else {
        panic!("the vase stays")
    };
    assert_eq!(names, ["vase"]);
    assert_solvable(&kept);
}

#[test]
fn a_low_tool_that_meets_the_disc_of_a_turntable_is_lifted() {
    let table = "
scene:
  objects:
    - name: table
      shape: {cylinder: {radius: 0.10, height: 0.04}}
      parts: [{name: peg, shape: {cylinder: {radius: 0.012, height: 0.06}}, position: [0.08, 0], z: 0.04}]
      mass: 0.8
      friction: 0.1
      position: [0.58, -0.073]
      yaw_deg: 81
  joints:
    - {between: [table, world], kind: revolute, at: [0.58, -0.073], limits_deg: [-10, 330]}
robot: {reach: {min: 0.2, max: 0.9}}
tools: [finger, paddle]
pushes: {directions: 8, lift: 0.03}
goal: {object: table, joint_deg: 51, heading_tolerance_deg: 10}
";
    let Cause::Lift { allowed: 0.03, needed } = cause(table) else { panic!("the disc is lower") };
    assert!((0.04..0.05).contains(&needed), "{needed}");
    // The tool passes over the disc and meets the peg, which the reader accepts.
    let text = |lift: f64| table.replace("lift: 0.03", &format!("lift: {lift}"));
    assert_solvable(&text(needed));
    let over = Task::parse(&text(0.105), "task.yaml").expect_err("a fault").to_string();
    assert!(over.contains("passes above every object (0.1 m high)"), "{over}");
}

#[test]
fn warnings_of_one_quantity_share_a_line_and_three_are_shown() {
    let post = "\n    - {name: post, shape: {cuboid: {size: [0.01, 0.02, 0.3]}}, mass: 0.4, \
                friction: 0.4, position: [0.50, 0.05]}\nrobot:";
    let text = CAN.replace("\nrobot:", post).replace("height: 0.1", "height: 0.3");
    let text = text.replace("[0.77, 0.05]", "[0.52, 0.05]").replace("0.015", "0.03");
    let (_, solution) = solved(&text.replace("tools: all", "tools: [paddle]"));
    let lines = warning_lines(&solution.warnings);
    assert!(solution.warnings.len() > SHOWN_WARNINGS, "{:?}", solution.warnings);
    assert!(lines.len() < solution.warnings.len());
    let heights = lines.iter().filter(|line| line.starts_with("height (m) of can")).count();
    assert_eq!(heights, 1, "{lines:?}");
}

#[test]
fn a_window_between_the_coarse_offsets_is_found_by_one_push() {
    let pocket = "
name: pocket
friction: 0.4
parts:
  - {name: handle, size: [0.50, 0.02, 0.05], position: [0.25, 0]}
  - {name: bar, size: [0.02, 0.06, 0.05], position: [0.49, -0.04]}
";
    let task = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.09}}, mass: 0.3, friction: 0.4, position: [0.86, 0.0]}
  obstacles:
    - {name: left, size: [0.34, 0.02, 0.12], position: [0.78, 0.085]}
    - {name: right, size: [0.34, 0.02, 0.12], position: [0.78, -0.045]}
    - {name: back, size: [0.02, 0.15, 0.12], position: [0.96, 0.02]}
robot: {reach: {min: 0.15, max: 0.50}}
tools: all
pushes: {max_count: 3}
goal: {object: can, position: [0.74, 0.0], tolerance: 0.03}
";
    let task = Task::parse(task, "design.yaml").expect("a task");
    let tool = pushplan::Tool::parse(pocket, "pocket.yaml").expect("a tool");
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let library = library.with(std::sync::Arc::new(tool)).expect("another name");
    let planner = Planner::for_effort(Effort::Standard).expect("its models").build();
    let solution = planner.solve(&task, &library).expect("a sound task");
    assert_eq!(solution.status, PlanStatus::Solved);
    assert_eq!(solution.best().expect("a plan").plan.pushes().len(), 1);
}
