//! The library from a user's view: errors that read as text, tools that can be added, results that
//! can be written.

mod closure;
mod in_code;

use std::path::Path;

use pushplan::goals::{Demand, Flipped};
use pushplan::{
    EffectModel, Effort, Error, Goal, Job, LeverRules, Object, Outcome, Part, Pivot, PlanStatus,
    Planner, Pose, PushRules, Record, Robot, Scene, Simulated, Simulator, Solution, SolveError,
    Step, Task, Tool, ToolLibrary, Trust,
};
use rayon::ThreadPoolBuilder;

const TASKS: [&str; 3] = ["tasks/pull-back.yaml", "tasks/too-far.yaml", "tasks/diagonal.yaml"];

fn tasks() -> Vec<Task> {
    TASKS.iter().map(|path| Task::load(Path::new(crate::ROOT).join(path)).unwrap()).collect()
}

fn planner() -> Planner {
    Planner::builder(Simulated::new(Simulator::planar())).effort(Effort::Draft).build()
}

fn bar(name: &str) -> Tool {
    Tool::new(name, [Part::cuboid("bar", [0.04, 0.2, 0.05], Pose::default())]).unwrap()
}

/// Removes the wall-clock times, the only part that may differ.
fn timeless(mut solution: Solution) -> Solution {
    solution.statistics.timing = Default::default();
    solution
}

#[test]
fn an_error_that_leaves_main_is_printed_as_text() {
    let faults = Task::parse("scene: {table: {friction: -1}}", "bad.yaml").unwrap_err();
    let text = faults.to_string();
    assert!(text.contains("bad.yaml:1:27: error: expected a friction value"), "{text}");
    assert_eq!(format!("{:?}", Error::from(faults.clone())), text);
    let boxed: Box<dyn std::error::Error> = Box::new(faults);
    assert_eq!(format!("{boxed:?}"), text);

    let mut task = tasks().remove(0);
    task.goals[0].set_tolerance(0.0);
    let library = ToolLibrary::embedded().unwrap();
    let refused: SolveError = planner().solve(&task, &library).unwrap_err();
    let text =
        "task `pull-back`: goal: the tolerance of the goal is 0, but must be a positive number";
    assert_eq!(format!("{refused:?}"), text);
    assert_eq!(format!("{:?}", Error::from(refused)), text);

    let apart = ["left", "right"].map(|name| {
        let x = if name == "left" { 0.0 } else { 1.0 };
        Part::cuboid(name, [0.1, 0.1, 0.1], Pose::new(x, 0.0, 0.0))
    });
    let error = Error::from(Tool::new("pieces", apart).unwrap_err());
    assert_eq!(format!("{error:?}"), "the parts form 2 separate pieces: left | right");
}

#[test]
fn a_lever_up_is_planned_verified_and_written_like_a_push() {
    let library = ToolLibrary::embedded().unwrap();
    let plate = Object::cuboid("plate", [0.12, 0.08, 0.008]).mass(0.1).on_feet(0.006);
    let goal = Goal::of(0).with(Demand::Flipped(Flipped { flipped: true }));
    let scene = Scene::new([plate.at(0.5, 0.0, 0.0)]);
    let task = Task::new("turn", scene, Robot::reaching(0.1, 0.9), goal)
        .with_tools(["screwdriver"])
        .levering(LeverRules { pivots: vec![Pivot::Auto], ..LeverRules::default() })
        .pushing(PushRules::none());
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let solution = planner.solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().unwrap();
    let [Step::LeverUp(step)] = &best.plan.steps[..] else { panic!("{:?}", best.plan) };
    assert_eq!(step.tool, "screwdriver");
    // The model supports this motion, and a model that does not support it declines.
    let motions = best.plan.motions(&best.tools).unwrap();
    let job = Job::stated(&task.scene, motions[0].clone());
    assert_ne!(planner.model().trust(&task.scene, &job), Trust::NotMine);
    let planar = Simulated::new(Simulator::planar());
    assert_eq!(planar.trust(&task.scene, &job), Trust::NotMine);
    let found = planner.model().rollout(&task.scene, &[job], Record::Outcome).remove(0);
    assert_eq!(found.by.to_string(), "network");
    assert!(Outcome::judge(&task.scene, &task, &found).reached);
    let again = Task::parse(&task.to_yaml().unwrap(), "turn.yaml").unwrap();
    assert_eq!(again, task);
    let replay = best.verdict.as_ref().and_then(|verdict| verdict.evidence[0].trajectory.clone());
    assert!(replay.unwrap().outcome().space.is_some());
}

#[test]
fn tools_are_added_to_a_library_unless_their_name_is_taken() {
    let library = ToolLibrary::embedded().unwrap();
    let count = library.len();
    let library = library.with(bar("a-bar")).unwrap().with(bar("my-bar")).unwrap();
    assert_eq!(library.len(), count + 2);
    let names: Vec<&str> = library.iter().map(|tool| tool.name.as_str()).collect();
    assert!(names.is_sorted() && library.get("my-bar").is_some(), "{names:?}");
    let error = library.clone().with(bar("my-bar")).unwrap_err().to_string();
    assert!(error.starts_with("tool `my-bar`: error: the library already has"), "{error}");

    let folder = tempfile::tempdir().unwrap();
    let write = |file: &str, name: &str| {
        let text = format!(
            "name: {name}\nfriction: 0.4\nparts: [{{name: p, size: [0.1, 0.1, 0.1], position: [0, 0, 0]}}]\n"
        );
        std::fs::write(folder.path().join(file), text).unwrap();
    };
    write("paddle-2.yaml", "paddle-2");
    let more = library.clone().with_folder(folder.path()).unwrap();
    assert!(more.get("paddle-2").is_some() && more.get("my-bar").is_some());
    // A file replaces a tool of the library, but no other file.
    write("rake.yaml", "rake");
    let replaced = library.clone().with_folder(folder.path()).unwrap();
    assert_eq!(replaced.len(), more.len());
    assert_eq!(replaced.get("rake").unwrap().parts().len(), 1);
    write("twin.yaml", "paddle-2");
    let error = library.with_folder(folder.path()).unwrap_err();
    let [twin] = &error.0[..] else { panic!("one fault: {error}") };
    assert!(
        twin.message.contains("`paddle-2` is already defined in ")
            && twin.message.ends_with("paddle-2.yaml")
    );
}

#[test]
fn a_solution_survives_being_written_as_json() {
    let library = ToolLibrary::embedded().unwrap();
    let mut solution = planner().solve(&tasks()[0], &library).unwrap();
    // Frames of replays are not written, because they can be recomputed.
    for plan in &mut solution.plans {
        let evidence = plan.verdict.iter_mut().flat_map(|verdict| &mut verdict.evidence);
        evidence.for_each(|evidence| evidence.trajectory = None);
    }
    let text = serde_json::to_string(&solution).unwrap();
    assert_eq!(serde_json::from_str::<Solution>(&text).unwrap(), solution);
}

#[test]
fn tasks_solved_together_end_as_tasks_solved_alone_for_any_number_of_threads() {
    let (tasks, library, planner) = (tasks(), ToolLibrary::embedded().unwrap(), planner());
    let alone: Vec<Solution> =
        tasks.iter().map(|task| timeless(planner.solve(task, &library).unwrap())).collect();
    for threads in [1, 3] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let together = pool.install(|| planner.solve_all(&tasks, &library));
        for (alone, together) in alone.iter().zip(together) {
            assert_eq!(alone, &timeless(together.unwrap()), "{threads} threads");
        }
    }
    let mut bad = tasks;
    bad[1].goals[0].set_tolerance(f64::NAN);
    let outcomes = planner.solve_all(&bad, &library);
    assert_eq!(outcomes.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false, true]);
}
