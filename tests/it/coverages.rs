//! Goals of coverage, Push-T's measure: share of its outline at the goal that an object covers.

use pushplan::solve::PlanStatus;
use pushplan::{scene::Engine, task::Task};

use crate::judged::{file, solved, works_in_mujoco};

/// Returns a task with a box, or a T of two solids; `goal` is its coverage.
fn task(object: &str, goal: &str) -> Task {
    let text = format!(
        "
scene:
  table: {{friction: 0.4}}
  objects:
    - {{name: it, mass: 0.4, friction: 0.4, position: [0.55, 0.1], yaw_deg: 10, {object}}}
robot: {{reach: {{min: 0.1, max: 0.9}}}}
tools: [stick, l-hook]
pushes: {{directions: 16}}
goal: {{object: it, coverage: {goal}}}
"
    );
    Task::parse(&text, "coverage.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

const BOX: &str = "shape: {cuboid: {size: [0.12, 0.08, 0.06]}}";
const CAN: &str = "shape: {cylinder: {radius: 0.05, height: 0.10}}";
const TEE: &str = "shape: {cuboid: {size: [0.12, 0.03, 0.03]}}, \
     parts: [{name: stem, shape: {cuboid: {size: [0.03, 0.09, 0.03]}}, position: [0, -0.06]}]";

#[test]
fn enough_of_the_outline_is_covered_in_every_engine() {
    for (object, goal) in [
        (BOX, "{share: 0.9, position: [0.7, 0.1], heading_deg: 0}"),
        (CAN, "{position: [0.4, 0.05]}"),
        (TEE, "{share: 0.8, position: [0.62, 0.1], heading_deg: 0}"),
    ] {
        let task = task(object, goal);
        assert!(!task.reached(&task.scene.start()), "{goal}");
        let solution = solved(&task);
        assert_eq!(solution.status, PlanStatus::Solved, "{goal}");
        let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
        let share = task.goals[0].wanted_share().expect("a coverage");
        for engine in Engine::ALL {
            for evidence in verdict.nominal(engine).into_iter().chain(verdict.perturbed(engine)) {
                let covered = task.goals[0].covered(&evidence.outcome.state).expect("a coverage");
                let sound = evidence.fault().is_none();
                assert_eq!(evidence.outcome.reached, sound && covered >= share, "{covered}");
            }
        }
        works_in_mujoco(&file(&task, &solution));
    }
}

/// A square covers all of its outline after a quarter turn, a T only after a full one.
#[test]
fn headings_that_look_the_same_cover_the_same() {
    let square = "shape: {cuboid: {size: [0.1, 0.1, 0.06]}}";
    for (object, turn, whole) in [(square, 90f64, true), (TEE, 90.0, false), (TEE, 360.0, true)] {
        let task = task(object, "{position: [0.55, 0.1]}");
        let mut state = task.scene.start();
        state.poses[0].heading = turn.to_radians();
        let covered = task.goals[0].covered(&state).expect("a coverage");
        assert_eq!(covered > 1.0 - 1e-9, whole, "{object} {turn}: {covered}");
        assert_eq!(task.score(&state) < 1e-6, whole);
    }
}

#[test]
fn it_is_read_as_it_is_written_and_a_plan_file_keeps_it() {
    for (object, goal, share) in [
        (BOX, "{share: 0.9, position: [0.7, 0.1], heading_deg: 30}", 0.9),
        (CAN, "{position: [0.4, 0.05]}", 0.95),
        (TEE, "{position: [0.4, 0.05], heading_deg: -125}", 0.95),
    ] {
        let task = task(object, goal);
        assert_eq!(task.goals[0].wanted_share(), Some(share));
        let again = Task::parse(&task.to_yaml().expect("as text"), "coverage.yaml").expect("sound");
        assert_eq!(again, task);
        let json = serde_json::to_string(&task).expect("as JSON");
        assert_eq!(serde_json::from_str::<Task>(&json).expect("the same"), task);
    }
}
