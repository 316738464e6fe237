//! Builds a task and a tool in code, solves the task, and saves the plan:
//! `cargo run --release --example solve_task [-- FOLDER]`.

use std::path::PathBuf;

use pushplan::files::PlanFile;
use pushplan::{
    Effort, Goal, Object, Obstacle, Part, PlanStatus, Planner, Pose, Robot, Scene, Task, Tool,
    ToolLibrary,
};

fn main() -> Result<(), pushplan::Error> {
    // Units: metres, kilograms, radians.
    let can = Object::cylinder("can", 0.05, 0.10).mass(0.4).friction(0.4).at(0.62, 0.10, 0.0);
    let wall = Obstacle::cuboid("wall", [0.03, 0.10, 0.12]).at(0.36, 0.20, 0.0);
    let scene = Scene::new([can]).with_obstacle(wall);
    let goal = Goal::new(0, [0.45, 0.10], 0.02);
    let task = Task::new("can-behind-wall", scene, Robot::reaching(0.1, 0.7), goal);

    let handle = Part::cuboid("handle", [0.42, 0.04, 0.05], Pose::new(0.26, 0.0, 0.0));
    let bar = Part::cuboid("bar", [0.04, 0.16, 0.05], Pose::new(0.43, 0.08, 0.0));
    let library = ToolLibrary::embedded()?.with(Tool::new("long-hook", [handle, bar])?)?;

    let planner = Planner::for_effort(Effort::Standard)?.build();
    let solution = planner.solve(&task, &library)?;
    assert_eq!(solution.status, PlanStatus::Solved);
    let Some(best) = solution.best() else { return Ok(()) };
    let pushes = best.plan.steps.len();
    println!("{}: {pushes} push(es) with the {}", task.name, best.plan.tool());
    println!("predicted error {:.1} mm", 1000.0 * best.outcome.error());

    // `pushplan verify` and `pushplan export` read this file.
    if let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) {
        let path = folder.join("can-behind-wall.plan.json");
        best.to_file(&task).write(&path)?;
        let verdict = planner.verify(&PlanFile::load(&path)?)?;
        assert!(verdict.passed);
    }
    Ok(())
}
