//! Goals of groups of objects, and goals outside of a region.

use pushplan::asset::PlanFile;
use pushplan::task::demand::Demand;
use pushplan::{Pose, State, Task, solve::PlanStatus};
use pushplan_export::mjcf;
use pushplan_report::task_stage;

use crate::judged::{file, solved, works_in_mujoco};

/// Three objects, two of which must reach a tray; the third is far from it.
const TWO_OF_THREE: &str = "
scene:
  table: {friction: 0.4}
  objects:
    - {name: crate, shape: {cuboid: {size: [0.08, 0.08, 0.08]}}, mass: 0.4, friction: 0.4, position: [0.40, 0.45]}
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.4, friction: 0.4, position: [0.58, 0.10]}
    - {name: cup, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.4, friction: 0.4, position: [0.58, -0.10]}
robot: {reach: {min: 0.1, max: 1.0}}
tools: [paddle]
pushes: {max_count: 2}
goal:
  objects: [crate, can, cup]
  at_least: 2
  region: {area: {rectangle: {size: [0.30, 0.60]}}, position: [0.82, 0.0]}
";

/// Box that must leave the middle of the table.
const OUT: &str = "
scene:
  table: {friction: 0.4}
  objects:
    - {name: box, shape: {cuboid: {size: [0.08, 0.08, 0.08]}}, mass: 0.4, friction: 0.4, position: [0.55, 0.02]}
robot: {reach: {min: 0.1, max: 1.0}}
tools: [paddle]
goal: {object: box, region: {outside: true, area: {circle: {radius: 0.12}}, position: [0.55, 0.0]}}
";

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn faults(change: [&str; 2]) -> String {
    assert!(TWO_OF_THREE.contains(change[0]), "{}", change[0]);
    let text = TWO_OF_THREE.replace(change[0], change[1]);
    Task::parse(&text, "task.yaml").expect_err("faulty").to_string()
}

#[test]
fn the_nearest_objects_of_a_group_are_pushed_and_all_reports_agree() {
    let task = task(TWO_OF_THREE);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = &solution.plans[0];
    // Can and cup need one push each; the crate stays.
    let start = task.scene.start();
    for evidence in &best.verdict.as_ref().expect("verified").evidence[..2] {
        let end = &evidence.outcome.state;
        assert!(task.reached(end) && evidence.outcome.reached && task.score(end) <= 1.0);
        assert!((end.poses[0].position - start.poses[0].position).norm() < 1e-3);
        assert_eq!(evidence.outcome.goals.len(), 1);
    }
    let plan = file(&task, &solution);
    works_in_mujoco(&plan);
    // One of two pushes is not enough, in every engine.
    let mut half = plan;
    half.plan.steps.truncate(1);
    let text = mjcf(&half).expect("a scene");
    assert!(text.contains("at_least") && text.contains("&quot;crate&quot;"), "{text}");
    assert!(!task.reached(&start));
    let drawn = &task_stage(&task)["goals"][0];
    assert_eq!(drawn["objects"], serde_json::json!([0, 1, 2]));
    assert_eq!(drawn["areas"].as_array().expect("a list").len(), 1, "one region for all");
}

#[test]
fn any_two_of_a_group_satisfy_it_and_files_keep_it() {
    let task = task(TWO_OF_THREE);
    let [Demand::Group(group)] = &task.goals[0].demands[..] else { panic!("a group") };
    assert_eq!((group.at_least, group.members.len()), (2, 3));
    assert_eq!(Task::parse(&task.to_yaml().expect("text"), "task.yaml").expect("sound"), task);
    for away in 0..3 {
        let at = |k| if k == away { [0.3, 0.2] } else { [0.8, 0.2 * k as f64 - 0.2] };
        let poses = (0..3).map(|k| Pose::new(at(k)[0], at(k)[1], 0.0)).collect();
        assert!(task.reached(&State::at_rest(poses)), "all but {away}");
    }
    let path = tempfile::tempdir().expect("a folder");
    let path = path.path().join("group.plan.json");
    let solution = solved(&task);
    file(&task, &solution).write(&path).expect("written");
    let text = std::fs::read_to_string(&path).expect("written");
    assert_eq!(PlanFile::parse(&text, "group.plan.json").expect("sound").task, task);
}

#[test]
fn impossible_groups_are_errors_with_a_remedy() {
    for (change, fault) in [
        (["at_least: 2", "at_least: 4"], "only 3 objects are named"),
        (["[crate, can, cup]", "[crate, can, can]"], "`can` is named twice"),
        (["objects: [crate, can, cup]", "object: can"], "`at_least` without `objects`"),
        (["  objects: [crate, can, cup]\n", ""], "missing key `object`"),
        (["[crate, can, cup]", "[crate, can, mug]"], "no object is called `mug`"),
    ] {
        let text = faults(change);
        assert!(text.contains(fault), "{fault}: {text}");
    }
    let all = task(&TWO_OF_THREE.replace("  at_least: 2\n", ""));
    assert_eq!(all.goals.len(), 3);
}

#[test]
fn an_object_leaves_a_region_the_shortest_way() {
    let task = task(OUT);
    assert_eq!(Task::parse(&task.to_yaml().expect("text"), "task.yaml").expect("sound"), task);
    assert!(!task.reached(&task.scene.start()));
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let end = solution.plans[0].outcome.state.poses[0].position;
    assert!((0.12..0.25).contains(&(end - pushplan::Vector::new(0.55, 0.0)).norm()), "{end}");
    works_in_mujoco(&file(&task, &solution));
}
