//! Goals of the gap between two bodies: touching, side by side, or clear of each other.

use pushplan::solve::PlanStatus;
use pushplan::{
    scene::{Body, Engine, State},
    task::{Demand, End, Task},
};

use crate::judged::{file, solved, works_in_mujoco};

/// Returns a task with a box, a mug whose handle points at it, and a wall; `goal` is the box's.
fn task(mug: [f64; 2], goal: &str) -> Task {
    let text = format!(
        "
scene:
  objects:
    - {{name: box, shape: {{cuboid: {{size: [0.08, 0.06, 0.08]}}}}, mass: 0.5, friction: 0.4, position: [0.45, 0.12]}}
    - name: mug
      shape: {{cylinder: {{radius: 0.035, height: 0.1}}}}
      parts: [{{name: handle, shape: {{cuboid: {{size: [0.03, 0.015, 0.08]}}}}, position: [-0.045, 0]}}]
      mass: 0.4
      friction: 0.4
      position: {mug:?}
  obstacles:
    - {{name: wall, size: [0.02, 0.4, 0.1], position: [0.75, 0.0]}}
robot: {{reach: {{min: 0.1, max: 0.9}}}}
tools: [stick, l-hook]
pushes: {{directions: 16}}
goal: {{object: box, {goal}}}
"
    );
    Task::parse(&text, "gap.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

/// Returns the gap of the goal, metres.
fn gap(task: &Task, state: &State) -> f64 {
    let [Demand::Gap(gap), ..] = &task.goals[0].demands[..] else { panic!("a goal of a gap") };
    gap.nearest(&state.poses[task.goals[0].object], state).expect("both exist").gap
}

#[test]
fn things_are_brought_to_touch_apart_and_beside_each_other_whatever_is_a_little_different() {
    for (mug, goal, [min, max]) in [
        ([0.6, -0.1], "gap: {to: mug, max: 0.002}", [f64::NEG_INFINITY, 0.002]),
        ([0.6, 0.12], "gap: {to: mug, min: 0.10}", [0.10, f64::INFINITY]),
        ([0.6, -0.1], "gap: {to: mug, min: 0.01, max: 0.04}, heading_deg: 0", [0.01, 0.04]),
        ([0.6, -0.1], "gap: {to: wall, max: 0.005}", [f64::NEG_INFINITY, 0.005]),
    ] {
        let task = task(mug, goal);
        assert!(!task.reached(&task.scene.start()), "{goal}");
        let solution = solved(&task);
        assert_eq!(solution.status, PlanStatus::Solved, "{goal}");
        let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
        for engine in Engine::ALL {
            let ends: Vec<f64> = verdict
                .nominal(engine)
                .into_iter()
                .chain(verdict.perturbed(engine).filter(|evidence| evidence.outcome.reached))
                .map(|evidence| gap(&task, &evidence.outcome.state))
                .collect();
            assert!(ends.len() > 4 && ends.iter().all(|gap| (min..=max).contains(gap)), "{ends:?}");
        }
        works_in_mujoco(&file(&task, &solution));
    }
}

#[test]
fn goals_that_are_met_need_no_push() {
    let solution = solved(&task([0.6, -0.1], "gap: {to: mug, min: 0.05}"));
    assert_eq!(solution.status, PlanStatus::Solved);
    assert!(solution.plans[0].plan.is_empty());
}

#[test]
fn it_is_read_as_it_is_written_and_a_plan_file_keeps_it() {
    for (goal, to) in [
        ("gap: {to: mug, min: 0.10}", Body::Object(1)),
        ("gap: {to: wall, max: 0.002}", Body::Obstacle(0)),
        ("gap: {to: mug, min: 0.01, max: 0.04}, heading_deg: 30", Body::Object(1)),
    ] {
        let task = task([0.6, -0.1], goal);
        assert_eq!(task.goals[0].demands[0].kind().to(), Some(to));
        let again = Task::parse(&task.to_yaml().expect("as text"), "gap.yaml").expect("sound");
        assert_eq!(again, task);
        let json = serde_json::to_string(&task).expect("as JSON");
        assert_eq!(serde_json::from_str::<Task>(&json).expect("the same"), task);
    }
}

/// Moving the mug changes the goal's error in the same way as moving the box, because only their
/// distance counts.
#[test]
fn only_where_they_are_to_each_other_counts() {
    let task = task([0.6, -0.1], "gap: {to: mug, min: 0.01, max: 0.04}");
    let start = task.scene.start();
    for k in 0..24 {
        let by = pushplan::Vector::new(0.1 * f64::from(k).sin(), 0.01 * f64::from(k));
        let mut own = start.clone();
        own.poses[0].position += by;
        let mut other = start.clone();
        other.poses[1].position -= by;
        assert!((task.goals[0].error(&own) - task.goals[0].error(&other)).abs() < 1e-9, "{by}");
        assert_eq!(task.reached(&own), task.reached(&other));
        assert_eq!(task.reached(&own), (0.01..=0.04).contains(&gap(&task, &own)));
        assert_eq!(task.score(&own) <= 1.0 + 1e-9, task.reached(&own), "{by}");
    }
}

/// A longer push would press on both touching objects; a fragile object is pushed no further than
/// contact.
#[test]
fn fragile_objects_are_touched_without_further_pushing() {
    let text = task([0.6, -0.1], "gap: {to: mug, max: 0.004}").to_yaml().expect("as text");
    let mut task = Task::parse(&text, "gap.yaml").expect("sound");
    task.scene.objects[0].max_force = Some(1.0);
    let solution = solved(&task);
    assert_ne!(solution.status, PlanStatus::Solved, "less than its friction");
    task.scene.objects[0].max_force = Some(3.0);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
    assert!(Engine::ALL.iter().all(|engine| {
        verdict.nominal(*engine).and_then(|one| one.force).is_some_and(|force| force.lasting < 3.0)
    }));
}

/// Block that must come near a wall and stay away from a lamp: two demands of one kind.
const BOTH: &str = "
scene:
  objects:
    - {name: block, shape: {cuboid: {size: [0.08, 0.06, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.50, -0.10], yaw_deg: 20}
    - {name: lamp, shape: {cylinder: {radius: 0.05, height: 0.20}}, mass: 1.2, friction: 0.5, position: [0.60, 0.08]}
  obstacles:
    - {name: wall, size: [0.02, 0.8, 0.2], position: [0.78, 0.0]}
robot: {reach: {min: 0.2, max: 0.9}}
tools: all
pushes: {directions: 8}
keep: {objects: [lamp]}
goal:
  - {object: block, gap: {to: wall, min: 0.03, max: 0.06}}
  - {object: block, gap: {to: lamp, min: 0.10}}
";

#[test]
fn one_object_keeps_two_gaps_at_once() {
    let task = Task::parse(BOTH, "both.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let [goal] = &task.goals[..] else { panic!("one goal of one object") };
    let to: Vec<_> = goal.demands.iter().map(|demand| demand.kind().to()).collect();
    assert_eq!(to, [Some(Body::Obstacle(0)), Some(Body::Object(1))]);
    let again = Task::parse(&task.to_yaml().expect("as text"), "both.yaml").expect("sound");
    assert_eq!(again, task);
    // A position near the wall alone does not reach the goal.
    let mut state = task.scene.start();
    state.poses[0] = pushplan::Pose::new(0.695, 0.08, 0.0);
    let [near, far] = &goal.demands[..] else { panic!("two demands") };
    let end = End::resting(0, &state);
    assert!(near.kind().is_met(&end) && !far.kind().is_met(&end));
    assert!(!task.reached(&state) && task.score(&state) > 1.0);

    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    for evidence in &solution.plans[0].verdict.as_ref().expect("replayed").evidence[..2] {
        assert!(evidence.outcome.reached && task.reached(&evidence.outcome.state));
    }
}
