//! Obstructing objects are cleared first.

use pushplan::{Effort, PlanStatus, Planner, Solution, Task, ToolLibrary};

/// Task of a can whose goal is occupied by a crate, with a wall behind.
const TAKEN: &str = include_str!("../../tasks/taken-place.yaml");

fn task(change: impl Fn(&str) -> String) -> Task {
    Task::parse(&change(TAKEN), "taken-place.yaml").unwrap()
}

fn solve(task: &Task) -> Solution {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    planner.solve(task, &ToolLibrary::embedded().unwrap()).unwrap()
}

#[test]
fn the_crate_leaves_the_place_before_the_can_comes() {
    let task = task(str::to_owned);
    let solution = solve(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = &solution.plans[0];
    let frames = &best.predicted.frames;
    let moved = |object: usize, from: usize, to: usize| {
        let [from, to] = [from, to].map(|k| frames[k].state.poses[object].position);
        (to - from).norm()
    };
    let last = best.plan.steps.len() - 1;
    let before = frames.iter().take_while(|frame| frame.stroke < last).count() - 1;
    let end = frames.len() - 1;
    // The crate moves first and is not touched again; the can moves with the last push.
    assert!(moved(1, 0, before) > 0.1 && moved(1, before, end) < 0.005);
    assert!(moved(0, 0, before) < 0.005 && moved(0, before, end) > 0.2);
}

#[test]
fn kept_objects_and_costly_obstructions_are_not_cleared() {
    let kept = task(|yaml| format!("{yaml}\nkeep: {{objects: [crate]}}\n"));
    assert_ne!(solve(&kept).status, PlanStatus::Solved);
    let hasty = task(|yaml| yaml.replace("max_count: 4", "max_count: 1"));
    assert_ne!(solve(&hasty).status, PlanStatus::Solved);
}
