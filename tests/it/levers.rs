//! Levering tasks: their files, refusals with reasons, and plans of the shipped tasks.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pushplan::ToolLibrary;
use pushplan::asset::{Kind, PlanFile, check, load_task};
use pushplan::solve::{
    Effort, ManualLever, ManualPlace, PlanStatus, Planner, RankedPlan, Solution, manual_lever,
};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    outcome::{LeverFault, Reason, Warning},
    scene::{Engine, Situation, Tool},
    task::{LeverUp, Pivot, Place, Plan, Task},
};

/// Small plate that one lever-up tips over.
const PLATE: &str = "
scene:
  objects:
    - {name: plate, shape: {cuboid: {size: [0.12, 0.08, 0.008]}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [screwdriver]
levers: {pivot: auto}
goal: {object: plate, flipped: true}
";

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(crate::ROOT).join("tasks/levers");
    let entries = std::fs::read_dir(folder).expect("a folder of tasks");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "yaml"));
    paths.sort();
    paths
}

fn load(path: &Path) -> Task {
    let task = load_task(path, &library()).unwrap_or_else(|faults| panic!("{faults}"));
    assert!(task.levers.is_some(), "{} is a task of pushes", path.display());
    task
}

fn planner(effort: Effort) -> Planner {
    Planner::for_effort(effort).expect("the shipped weights").build()
}

/// Returns a plan as it is written, with the task that it solves.
pub fn plan_file(task: &Task, best: &RankedPlan) -> PlanFile {
    PlanFile {
        joints: None,
        task: task.clone(),
        tools: best.tools.clone(),
        plan: best.plan.clone(),
        model: Some(best.predicted.by.clone()),
        fit: None,
        predicted: Some(best.outcome.clone()),
        verdict: best.verdict.clone(),
    }
}

/// Returns the only fault of a lever-up as the first step.
fn cannot(fault: LeverFault) -> Warning {
    Warning::CannotLever { step: 0, fault }
}

#[test]
fn shipped_tasks_are_solved_or_refused_as_described() {
    let paths = shipped();
    assert!(paths.len() >= 6, "{paths:?}");
    for path in paths {
        let task = load(&path);
        assert_eq!(task.name, path.file_stem().expect("a name").to_string_lossy());
        let solution = planner(Effort::Standard).solve(&task, &library()).expect("a sound task");
        if task.description.contains("no solution") {
            assert_eq!(solution.status, PlanStatus::NoPlan, "{}", task.name);
            let levers = solution.statistics.levers.as_ref().expect("it was searched");
            assert!(!levers.search.refused.is_empty());
            continue;
        }
        assert_eq!(solution.status, PlanStatus::Solved, "{}", task.name);
        let best = solution.best().expect("a plan");
        let verdict = best.verdict.as_ref().expect("a verdict");
        assert!(verdict.passed && verdict.robustness >= Some(0.75), "{}", task.name);
        // Perturbations from another seed agree, and the plan is identical after writing and
        // reading.
        let text = serde_json::to_string(&plan_file(&task, best)).expect("numbers");
        let again = PlanFile::parse(&text, "again.json").unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(again.task, task, "to the bit");
        let verifier = Verifier::new(VerifySettings { replays: 16, seed: 5 });
        let situation = Situation::stated(&again.task.scene);
        let verdict = verifier.verify(&again.task, &situation, &again.tools, &again.plan);
        assert!(verdict.nominal_ok() && verdict.robustness >= Some(0.5), "{}", task.name);
    }
}

#[test]
fn blades_are_no_tools_for_pushes() {
    let library = library();
    assert!(library.get("screwdriver").is_some() && library.get("scraper").is_some());
    assert!(library.iter().all(|tool| tool.pushes() && tool.blade().is_none()));
    for tool in library.blades() {
        let text = serde_json::to_string(&tool.to_json()).expect("numbers");
        assert_eq!(&Tool::parse(&text, "again.yaml").expect("sound"), &**tool);
        let path = Path::new(crate::ROOT).join(format!("tools/{}.yaml", tool.name));
        assert_eq!(&Tool::load(&path).expect("named after its tool"), &**tool);
        assert_eq!(check(&path, None).ok(), Some(Kind::Tool));
    }
    let again = library.blades()[0].clone();
    assert!(library.with(again).is_err(), "names are unique");
}

#[test]
fn a_task_is_written_as_it_was_read() {
    for path in shipped() {
        let task = load(&path);
        let text = task.to_yaml().expect("numbers");
        assert_eq!(Task::parse(&text, "again.yaml").expect("sound"), task);
        assert_eq!(check(&path, Some(&library())).ok(), Some(Kind::Task));
    }
}

/// Returns the faults of `text` with every `from` replaced.
fn faults(changes: &[(&str, &str)]) -> String {
    let text = changes.iter().fold(PLATE.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("task.yaml");
    std::fs::write(&path, text).expect("a file");
    match load_task(&path, &library()) {
        Ok(_) => String::new(),
        Err(found) => found
            .to_string()
            .replace(&folder.path().display().to_string(), "")
            .replace("/task", "task"),
    }
}

#[test]
fn errors_of_files_have_reason_and_location() {
    assert_eq!(faults(&[]), "");
    insta::assert_snapshot!(faults(&[("clearance: 0.006", "clearance: 0.001")]), @r"
    task.yaml:6:9: error: `screwdriver` does not fit: its blade is 2 mm thick, but the clearance below `plate` is 1 mm
      help: name a thinner tool, or check the clearance
    ");
    insta::assert_snapshot!(faults(&[("clearance: 0.006", "clearance: 0.006, z: 0.02")]), @r"
    task.yaml:4:114: error: no obstacle supports `plate` at 0.02 m
      help: obstacles below it must end at `z` on both sides of its centre of mass; leave `z` out for an object on feet
    ");
    insta::assert_snapshot!(faults(&[("[screwdriver]", "[stick]"), ("flipped: true", "raised: 30")]), @r"
    task.yaml:6:9: error: `stick` has no blade, so it cannot lever
      help: use `scraper` or `screwdriver`
    task.yaml:8:31: error: expected a height in metres from 0.001 to 1, found the number 30
      help: 2 cm is 0.02
    ");
    insta::assert_snapshot!(faults(&[("flipped: true", "position: [0.4, 0]")]), @r"
    task.yaml:8:33: error: `position` needs a `tolerance`
      help: add `tolerance: 0.02`, in metres
    ");
    insta::assert_snapshot!(faults(&[(", flipped: true", ", outside: tray")]), @r"
    task.yaml:8:32: error: no obstacle is called `tray`
    ");
    insta::assert_snapshot!(faults(&[(", flipped: true", "")]), @r"
    task.yaml:8:7: error: the goal has no criterion
      help: add `position`, `region`, `gap`, `coverage`, `off_table`, `outside`, `raised`, `flipped`, `heading_deg`, `joint_deg` or `joint`
    ");
    insta::assert_snapshot!(faults(&[("levers: {pivot: auto}", "levers: {pivot: front, depth: [0.02, 0.01]}")]), @r#"
    task.yaml:7:17: error: expected `auto`, a distance in metres from -0.2 to 1 or a list of 1 to 8 pivots, found the text "front"
      help: use `auto`
    task.yaml:7:31: error: the smallest, 0.02, is above the largest, 0.01
      help: swap them
    "#);
}

/// A flipped rectangle keeps its heading or rotates by half a turn; both look identical.
#[test]
fn a_lever_up_can_be_asked_for_a_heading() {
    let asked = |heading: f64| {
        let goal = format!("flipped: true, heading_deg: {heading}, heading_tolerance_deg: 12");
        let task = Task::parse(&PLATE.replace("flipped: true", &goal), "plate.yaml");
        let task = task.unwrap_or_else(|faults| panic!("{faults}"));
        let again = Task::parse(&task.to_yaml().expect("numbers"), "plate.yaml").expect("sound");
        assert_eq!(again, task);
        planner(Effort::Draft).solve(&task, &library()).expect("a sound task")
    };
    let solution = asked(180.0);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    let verdict = best.verdict.as_ref().expect("a verdict");
    assert!(verdict.passed && best.outcome.heading_error() <= Some(12_f64.to_radians()));
    assert_ne!(asked(45.0).status, PlanStatus::Solved);
}

/// An object that only stands nearby is described as in a pushing task.
#[test]
fn cans_and_mugs_may_stand_beside_what_is_levered() {
    let objects = "    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.1}}, mass: 0.3, friction: 0.4, \
position: [0.5, 0.3]}
    - name: mug
      shape: {cylinder: {radius: 0.04, height: 0.09}}
      parts: [{shape: {cuboid: {size: [0.02, 0.01, 0.05]}}, position: [0.048, 0], z: 0.02}]
      mass: 0.3
      friction: 0.4
      position: [0.5, -0.3]
";
    let text = PLATE.replace("robot:", &format!("{objects}robot:"));
    let text = format!("{text}keep: {{objects: [can, mug]}}\n");
    let task = Task::parse(&text, "plate.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(task.scene.plates().count(), 3);
    let again = Task::parse(&task.to_yaml().expect("numbers"), "plate.yaml").expect("sound");
    assert_eq!(again, task);
    let solution = planner(Effort::Draft).solve(&task, &library()).expect("a sound task");
    assert_eq!(solution.status, PlanStatus::Solved);
    let close = text.replace("[0.5, 0.3]", "[0.5, 0.06]");
    let faults = Task::parse(&close, "plate.yaml").expect_err("no room").to_string();
    assert!(faults.contains("`can` overlaps `plate`"), "{faults}");
}

#[test]
fn infeasible_lever_ups_are_refused_with_a_reason() {
    let mut task = Task::parse(PLATE, "plate.yaml").expect("sound");
    let tool = library().get("screwdriver").expect("shipped").clone();
    let asked = |fraction: f64| ManualLever {
        place: ManualPlace::Edge(1, fraction),
        depth: 0.012,
        angle: 1.5,
        pivot: Pivot::Auto,
        speed: None,
    };
    let broken =
        |task: &Task, lever: &ManualLever| manual_lever(task, &tool, lever).expect("a lever-up").1;
    assert_eq!(broken(&task, &asked(0.5)), None);
    assert_eq!(broken(&task, &asked(0.1)), Some(LeverFault::NearCorner));
    assert_eq!(broken(&task, &ManualLever { depth: 0.1, ..asked(0.5) }), Some(LeverFault::TooDeep));
    let pry = ManualLever { pivot: Pivot::At(-0.012), angle: 0.5, ..asked(0.5) };
    assert_eq!(broken(&task, &pry), Some(LeverFault::BelowTable));
    let over = ManualLever { pivot: Pivot::At(0.005), ..asked(0.5) };
    assert_eq!(broken(&task, &over), Some(LeverFault::NoSupport));
    task.robot.reach_max = 0.5;
    assert_eq!(broken(&task, &asked(0.5)), Some(LeverFault::OutOfReach));
    let along = ManualLever { place: ManualPlace::Along(0.16), ..asked(0.5) };
    let plan = manual_lever(&task, &tool, &along).expect("a lever-up").0;
    let place = plan.lever_steps().next().expect("a lever-up").lever.place;
    assert!(place.edge == 1 && (place.fraction - 0.5).abs() < 1e-9, "{place:?}");
    assert!(
        manual_lever(&task, &tool, &ManualLever { place: ManualPlace::Edge(9, 0.5), ..along })
            .is_err()
    );
}

#[test]
fn verification_finds_by_itself_what_the_planner_would_refuse() {
    let task = Task::parse(PLATE, "plate.yaml").expect("sound");
    let tool = library().get("screwdriver").expect("shipped").clone();
    let lever = LeverUp {
        plate: 0,
        place: Place { edge: 1, fraction: 0.5 },
        depth: 0.012,
        pivot: 0.12,
        angle: 1.6,
        speed: 0.1,
        hold: 0.2,
        retreat: 0.1,
    };
    let verifier = Verifier::new(VerifySettings { replays: 4, seed: 0 });
    let verify = |task: &Task, lever: LeverUp| {
        let plan = Plan::levering(&tool.name, lever);
        let situation = Situation::stated(&task.scene);
        verifier.verify(task, &situation, std::slice::from_ref(&tool), &plan)
    };
    let good = verify(&task, lever);
    assert!(good.passed, "{:?}", good.reason);
    assert_eq!(good, verify(&task, lever), "the same again");
    assert_eq!(good.robustness, Some(1.0));
    let forbidden = |task: &Task, lever: LeverUp| {
        let verdict = verify(task, lever);
        assert!(!verdict.passed && matches!(verdict.reason, Some(Reason::Forbidden(_))));
        verdict.forbidden
    };
    let near = Place { edge: 1, fraction: 0.05 };
    assert_eq!(
        forbidden(&task, LeverUp { place: near, ..lever }),
        [cannot(LeverFault::NearCorner)]
    );
    let nowhere = Place { edge: 7, fraction: 0.5 };
    assert_eq!(forbidden(&task, LeverUp { place: nowhere, ..lever }).len(), 1);
    assert!(!forbidden(&task, LeverUp { depth: 0.05, ..lever }).is_empty());
    assert_eq!(forbidden(&task, LeverUp { speed: 1e-4, ..lever }), [cannot(LeverFault::TooLong)]);
    let mut short = task.clone();
    short.robot.reach_max = 0.5;
    assert_eq!(forbidden(&short, lever), [cannot(LeverFault::OutOfReach)]);
    // With too small an angle, the plate falls back.
    let little = verify(&task, LeverUp { angle: 0.6, ..lever });
    let misses = Reason::Misses { engine: Engine::Spatial, error: 0.0, heading_error: None };
    assert_eq!(little.reason, Some(misses));
}

#[test]
fn a_blade_goes_through_no_wall() {
    let wall = "  obstacles: [{name: wall, size: [0.01, 0.2, 0.02], position: [0.58, 0]}]\nrobot:";
    let walled = PLATE.replace("robot:", wall);
    let task = Task::parse(&walled, "plate.yaml").expect("sound");
    let tool = library().get("screwdriver").expect("shipped").clone();
    let lever = ManualLever {
        place: ManualPlace::Edge(1, 0.5),
        depth: 0.012,
        angle: 1.5,
        pivot: Pivot::Auto,
        speed: None,
    };
    let (plan, broken) = manual_lever(&task, &tool, &lever).expect("a lever-up");
    let through = LeverFault::Meets { body: "wall".to_owned() };
    assert_eq!(broken, Some(through.clone()));
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let situation = Situation::stated(&task.scene);
    let tools = std::slice::from_ref(&tool);
    let verdict = verifier.verify(&task, &situation, tools, &plan);
    assert_eq!(verdict.forbidden, [cannot(through)]);
    // From the other side there is no wall.
    let other = ManualLever { place: ManualPlace::Edge(3, 0.5), ..lever };
    assert_eq!(manual_lever(&task, &tool, &other).expect("a lever-up").1, None);
}

#[test]
fn a_blade_is_held_by_fingers_that_need_room() {
    // A slot of 20 mm leads through 80 mm of wall to the plate.
    let slot = "  obstacles:
    - {name: left, size: [0.08, 0.1, 0.05], position: [0.61, 0.06]}
    - {name: right, size: [0.08, 0.1, 0.05], position: [0.61, -0.06]}
robot:";
    let task = Task::parse(&PLATE.replace("robot:", slot), "plate.yaml").expect("sound");
    let lever = ManualLever {
        place: ManualPlace::Edge(1, 0.5),
        depth: 0.012,
        angle: 0.2,
        pivot: Pivot::Auto,
        speed: None,
    };
    let broken = |length: f64, task: &Task| {
        let blade = format!("{{length: {length}, width: 0.006, thickness: 0.002}}");
        let text = format!("{{name: b, friction: 0.4, blade: {blade}}}");
        let tool = Arc::new(Tool::parse(&text, "b.yaml").expect("sound"));
        manual_lever(task, &tool, &lever).expect("a lever-up").1
    };
    let fingers = |broken: &Option<LeverFault>| {
        broken.as_ref().is_some_and(|fault| matches!(fault, LeverFault::HandMeets { .. }))
    };
    assert!(fingers(&broken(0.05, &task)), "{:?}", broken(0.05, &task));
    assert_eq!(broken(0.12, &task), None);
    let mut free = task;
    free.robot.hand = None;
    assert_eq!(broken(0.05, &free), None);
}

#[test]
fn plans_are_the_same_for_any_number_of_threads() {
    let task = Task::parse(PLATE, "plate.yaml").expect("sound");
    let solve = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let solution = pool.install(|| planner(Effort::Draft).solve(&task, &library()));
        let Solution { plans, .. } = solution.expect("a sound task");
        plans
    };
    assert_eq!(solve(1), solve(3));
}
