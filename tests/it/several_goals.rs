//! Several objects, each with its own goal.

use pushplan::asset::PlanFile;
use pushplan::{Effort, Goal, PlanStatus, Planner, Solution, Task, ToolLibrary};

const TWO: &str = include_str!("../../tasks/two-places.yaml");

fn solve(task: &Task) -> Solution {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    planner.solve(task, &ToolLibrary::embedded().unwrap()).unwrap()
}

fn faults(change: impl Fn(&str) -> String) -> String {
    Task::parse(&change(TWO), "two.yaml").unwrap_err().to_string()
}

#[test]
fn a_plan_counts_only_if_it_reaches_all_of_them() {
    let task = Task::parse(TWO, "two-places.yaml").unwrap();
    assert_eq!(task.goals.iter().map(|goal| goal.object).collect::<Vec<_>>(), [0, 1]);
    let solution = solve(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = &solution.plans[0];
    for evidence in &best.verdict.as_ref().unwrap().evidence[..2] {
        assert!(task.goals.iter().all(|goal| goal.reached(&evidence.outcome.state)));
        let [_, further] = evidence.outcome.goals[..] else { panic!("two goals") };
        assert_eq!(further.object, 1);
        assert!(further.error <= 0.02 && further.heading_error.unwrap() < 10f64.to_radians());
    }
    // With one push fewer allowed, one of them does not reach its goal.
    let hasty = TWO.replace("max_count: 4", "max_count: 1");
    assert_ne!(solve(&Task::parse(&hasty, "two.yaml").unwrap()).status, PlanStatus::Solved);
}

#[test]
fn the_order_in_which_they_are_written_does_not_matter_to_whether_they_are_reached() {
    let task = Task::parse(TWO, "two-places.yaml").unwrap();
    let mut turned = task.clone();
    turned.goals.swap(0, 1);
    let state = task.scene.start();
    assert_eq!(task.score(&state), turned.score(&state));
    assert_eq!(solve(&turned).status, PlanStatus::Solved);
}

#[test]
fn a_list_is_read_as_it_is_written_and_a_plan_file_keeps_it() {
    let task = Task::parse(TWO, "two-places.yaml").unwrap();
    assert_eq!(Task::parse(&task.to_yaml().unwrap(), "two-places.yaml").unwrap(), task);
    let one = task.only(&[0]).unwrap();
    assert_eq!(one.clone().and(task.goals[1].clone()), task);
    assert_eq!(Task::parse(&one.to_yaml().unwrap(), "two-places.yaml").unwrap(), one);

    let solution = solve(&task);
    let best = &solution.plans[0];
    let file = PlanFile {
        predicted: Some(best.outcome.clone()),
        ..PlanFile::new(task, best.tools.clone(), best.plan.clone())
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.plan.json");
    file.write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let read = PlanFile::parse(&text, "two.plan.json").unwrap();
    assert_eq!((read.task, read.predicted), (file.task, file.predicted));
    let mixed = text.replacen("\"object\": 1,", "\"object\": 0,", 1);
    assert_ne!(mixed, text);
    assert!(PlanFile::parse(&mixed, "two.plan.json").is_err());
}

#[test]
fn invalid_lists_are_errors_with_location() {
    let twice = faults(|yaml| yaml.replace("object: box, position", "object: can, position"));
    assert!(twice.contains("`can` has two goals"), "{twice}");
    let unknown = faults(|yaml| yaml.replace("object: box, position", "object: bx, position"));
    assert!(unknown.contains("no object is called `bx`"), "{unknown}");
    let kept = faults(|yaml| format!("{yaml}\nkeep: {{objects: [box]}}\n"));
    assert!(kept.contains("`box` is named by a goal and by `keep`"), "{kept}");
    let none = faults(|yaml| {
        let at = yaml.find("goal:").unwrap();
        format!("{}goal: []\n", &yaml[..at])
    });
    assert!(none.contains("goals"), "{none}");
    let far = Task::parse(TWO, "two.yaml").unwrap();
    assert!(far.with_goals(&[Goal::new(0, [0.1, 0.1], 0.01)]).goals[1] == far.goals[1]);
}

/// Can that can be pushed to its goal, and a block that no tool reaches.
const FAR: &str = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.3, friction: 0.4, position: [0.55, 0.1]}
    - {name: block, shape: {cuboid: {size: [0.06, 0.06, 0.06]}}, mass: 0.3, friction: 0.4, position: [0.6, -0.2]}
robot: {reach: {min: 0.3, max: 0.8}}
tools: [stick]
goal:
  - {object: block, position: [1.9, -0.2], tolerance: 0.02}
  - {object: can, position: [0.68, 0.1], tolerance: 0.02}
";

#[test]
fn where_not_all_goals_can_be_met_the_plan_is_partial_and_never_solved() {
    let solution = solve(&Task::parse(FAR, "far.yaml").expect("sound"));
    assert_eq!(solution.status, PlanStatus::Partial);
    let partial = solution.partial.as_ref().expect("a partial plan");
    assert_eq!(partial.met, [1]);
    let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
    assert!(!verdict.passed && !verdict.nominal_ok());
    // The reported goals are met in both engines.
    for evidence in &verdict.evidence {
        assert!(!evidence.outcome.reached && evidence.outcome.goals[1].error < 0.02);
    }
}

#[test]
fn goals_that_weigh_more_are_met_first() {
    // Either goal can be met, but not both, because the two goal positions overlap.
    let near = FAR.replace("[1.9, -0.2]", "[0.68, 0.1]");
    let met = |text: &str| {
        let solution = solve(&Task::parse(text, "near.yaml").expect("sound"));
        (solution.status, solution.partial.map(|partial| partial.met))
    };
    assert_eq!(met(&near), (PlanStatus::Partial, Some(vec![0])));
    let heavier = near.replacen("object: can, ", "object: can, weight: 2, ", 1);
    assert_eq!(met(&heavier), (PlanStatus::Partial, Some(vec![1])));
}
