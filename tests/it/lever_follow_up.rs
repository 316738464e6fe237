//! Pushes before and after a lever-up: their files, their engine, plans with both, and refused
//! tasks.

use std::path::Path;
use std::sync::Arc;

use pushplan::ToolLibrary;
use pushplan::asset::{PlanFile, load_task};
use pushplan::geometry::{Shape, Vector};
use pushplan::progress::NoProgress;
use pushplan::sim::LeverSimulator;
use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    outcome::{PushFault, Reason, Record, Trajectory, Verdict, Warning},
    scene::{Engine, GRAVITY, Situation, Tool},
    task::{LeverUp, Place, Plan, Push, PushForm, PushRules, Step, Task, ToolChoice},
};

use crate::levers::plan_file;

/// Plate that is levered up slightly, falls back, and may be pushed.
const TASK: &str = "
scene:
  objects:
    - {name: plate, shape: {cuboid: {size: [0.12, 0.08, 0.008]}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [screwdriver, paddle]
pushes: {max_count: 1}
levers: {pivot: auto}
goal: {object: plate, flipped: false, position: [0.6, 0], tolerance: 0.01}
";

/// Half length of the plate along x, metres.
const HALF: f64 = 0.06;

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn task() -> Task {
    Task::parse(TASK, "task.yaml").expect("sound")
}

/// Returns a small lever-up and return.
pub fn lever() -> LeverUp {
    LeverUp {
        plate: 0,
        place: Place { edge: 1, fraction: 0.5 },
        depth: 0.012,
        pivot: 0.12,
        angle: 0.6,
        speed: 0.1,
        hold: 0.2,
        retreat: 0.1,
    }
}

/// Returns the tools used by the plans in these tests.
fn tools() -> [Arc<Tool>; 2] {
    ["screwdriver", "paddle"].map(|name| library().get(name).expect("shipped").clone())
}

/// Returns a lever-up followed by a push along x that begins with the tool's front `gap` metres
/// before the plate.
fn plan(gap: f64, length: f64) -> Plan {
    Plan::levering("screwdriver", lever()).then(pushed(0.5, gap, length))
}

/// Returns a push along x of a plate at `x`.
fn pushed(x: f64, gap: f64, length: f64) -> Plan {
    let tool = library().get("paddle").expect("shipped").clone();
    let front = tool.parts().iter().map(|part| match part.shape {
        Shape::Cuboid { size } => part.pose.position.x + 0.5 * size[0],
        _ => panic!("the paddle consists of cuboids"),
    });
    let front = front.fold(0.0, f64::max) - tool.grip.position.x;
    let start = Vector::new(x - HALF - gap - front, 0.0);
    let push = Push { start, direction: 0.0, length, speed: 0.1 };
    Plan::pushing(&tool.name, 0.0, PushForm::Placed, 0.002, [push])
}

fn verify(task: &Task, plan: &Plan) -> Verdict {
    let situation = Situation::stated(&task.scene);
    let verifier = Verifier::new(VerifySettings { replays: 4, seed: 0 });
    verifier.verify(task, &situation, &tools(), plan)
}

/// Returns the plan with its first push changed.
fn changed(mut plan: Plan, change: impl FnOnce(&mut Push)) -> Plan {
    let step = plan.steps.iter_mut().find_map(|step| match step {
        Step::Push(step) => Some(step),
        Step::LeverUp(_) => None,
    });
    change(&mut step.expect("a push").push);
    plan
}

#[test]
fn a_push_carries_the_plate_as_far_as_the_tool_goes() {
    let task = task();
    let really = Situation::stated(&task.scene);
    let run = |plan: &Plan| -> Trajectory {
        let motions = plan.motions(&tools()).expect("its tools");
        let watched = (Record::Outcome, &NoProgress as _);
        LeverSimulator::FINE.run_all(&really, &task.scene, &motions, watched)
    };
    let rest = |found: &Trajectory| found.outcome().space.as_ref().expect("in space")[0];
    let (gap, length) = (0.02, 0.10);
    let (alone, pushed) = (run(&plan(gap, length).first(1)), run(&plan(gap, length)));
    assert_eq!(pushed.lifts, alone.lifts, "the lever-up is the same");
    // The plate is carried from the position to which it fell back, and then slides by v^2 / (2 mu
    // g).
    let moved = rest(&pushed).position - rest(&alone).position;
    let began = rest(&alone).position.x - 0.5;
    let friction = 0.5 * (0.4 + task.scene.table_friction);
    let carried = length - gap - began + 0.1 * 0.1 / (2.0 * friction * GRAVITY);
    assert!((moved.x - carried).abs() < 3e-4, "{moved:?} for {carried}");
    assert!(moved.y.abs() < 2e-3 && rest(&pushed).tilt() < 0.01, "{pushed:?}");
    assert_eq!(pushed.warnings, alone.warnings);
}

#[test]
fn the_whole_is_judged_and_perturbed_as_one() {
    let verdict = verify(&task(), &plan(0.02, 0.12));
    assert!(verdict.passed, "{:?}", verdict.reason);
    assert_eq!(verdict.evidence.len(), 5);
    // A push that is too short misses the goal, and the reason states it.
    let short = verify(&task(), &plan(0.02, 0.05));
    assert!(matches!(short.reason, Some(Reason::Misses { .. })), "{:?}", short.reason);
    let nominal = short.nominal(Engine::Spatial).expect("a replay");
    let end = nominal.outcome.state.poses[0].position;
    assert!((end.x - 0.53).abs() < 5e-3, "{end:?}");
}

#[test]
fn forbidden_pushes_are_found() {
    let on_it = verify(&task(), &plan(-0.03, 0.12));
    let fault = Warning::SetDownOn { object: "plate".to_owned(), stroke: 1 };
    assert_eq!(on_it.reason, Some(Reason::GoesWrong { engine: Engine::Spatial, fault }));
    let walled = TASK.replace(
        "robot:",
        "  obstacles: [{name: wall, size: [0.01, 0.4, 0.03], position: [0.41, 0]}]\nrobot:",
    );
    let walled = Task::parse(&walled, "walled.yaml").expect("sound");
    let through = verify(&walled, &plan(0.04, 0.14)).forbidden;
    let met = Warning::ThroughObstacle { push: 1, obstacle: "wall".to_owned() };
    assert!(through.contains(&met), "{through:?}");
    let forbidden = |task: &Task, plan: Plan| verify(task, &plan).forbidden;
    let far = changed(plan(0.02, 0.12), |push| push.length = 1.0);
    assert!(forbidden(&task(), far).contains(&Warning::OutOfReach { push: 1 }));
    let twice = plan(0.02, 0.12).then(pushed(0.5, 0.02, 0.12));
    let many = |allowed| Warning::TooManyPushes { pushes: 2 - usize::from(allowed == 0), allowed };
    assert!(forbidden(&task(), twice).contains(&many(1)), "one is allowed");
    let mut turned = plan(0.02, 0.12);
    let Step::Push(step) = &mut turned.steps[1] else { panic!("a push") };
    step.grip_yaw = 0.3;
    assert!(forbidden(&task(), turned).contains(&Warning::ForbiddenYaw { yaw: 0.3 }));
    let none = task().pushing(PushRules::none());
    assert!(forbidden(&none, plan(0.02, 0.12)).contains(&many(0)));
    let endless = changed(plan(0.02, 0.12), |push| push.speed = 1e-4);
    let too_long = Warning::ForbiddenPush { push: 1, fault: PushFault::TooLong(1200.0) };
    assert_eq!(forbidden(&task(), endless), [too_long]);
}

#[test]
fn a_plan_pushes_levers_and_pushes_again() {
    // Pushed 8 cm away, levered up slightly at its expected position, and pushed to its goal.
    let Step::LeverUp(mut levering) = plan(0.0, 0.1).steps.remove(0) else { panic!("a lever-up") };
    let first = pushed(0.5, 0.02, 0.10);
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let situation = Situation::stated(&task().scene);
    let moved = verifier.nominal(&task(), &situation, &tools(), &first);
    let nominal = moved.nominal(Engine::Spatial).expect("a replay");
    let there = nominal.outcome.state.poses[0];
    assert!((there.position.x - 0.58).abs() < 3e-3, "{there:?}");
    levering.expected = Some(there);
    let levering = Plan { steps: vec![Step::LeverUp(levering)] };
    let whole = first.then(levering).then(pushed(there.position.x, 0.02, 0.10));
    let mut task = task();
    let place = task.goals[0].position().unwrap();
    task.goals[0].set_position(Vector::new(0.66, place.y));
    let verdict = verify(&task, &whole);
    assert!(verdict.passed, "{:?}", verdict.reason);
    let trajectory = verdict.evidence[0].trajectory.as_ref().expect("frame by frame");
    let [lift] = trajectory.lifts[..] else { panic!("one lever-up") };
    assert!(lift.held && lift.raised > 0.02, "{lift:?}");
    let strokes: Vec<usize> = trajectory.frames.iter().map(|frame| frame.stroke).collect();
    assert!(strokes.is_sorted() && strokes.last() == Some(&2));
    // Without the expected position of the plate, the blade goes to another place under it.
    let mut blind = whole.clone();
    let Step::LeverUp(step) = &mut blind.steps[1] else { panic!("a lever-up") };
    step.expected = None;
    let verdict_of_blind = verify(&task, &blind);
    let elsewhere = verdict_of_blind.evidence[0].trajectory.as_ref().expect("frames");
    assert_ne!(elsewhere.lifts, trajectory.lifts);
    // A single page and a single file hold the whole plan.
    let file = PlanFile {
        verdict: Some(verdict.clone()),
        ..PlanFile::new(task.clone(), tools().to_vec(), whole)
    };
    let text = serde_json::to_string(&file).expect("numbers");
    assert_eq!(PlanFile::parse(&text, "again.json").expect("sound").plan, file.plan);
    let (recipe, view) = Default::default();
    let page = pushplan_report::verdict_page(&file, None, &verdict, recipe, view);
    assert!(
        page.contains("paddle, grip yaw 0\u{b0}, 1 push, then screwdriver, lifting by 34.4\u{b0}")
    );
    let figures = pushplan_report::space_figures(
        &task,
        (&file.plan, &file.tools),
        trajectory,
        &[],
        ("whole", true),
    );
    assert!(figures[1].to_svg().contains("<animate attributeName=\"points\""));
}

#[test]
fn the_shipped_task_needs_both_and_its_plan_reads_back() {
    let path = Path::new(crate::ROOT).join("tasks/levers/turn-and-push.yaml");
    let task = load_task(&path, &library()).expect("a task of levering");
    let planner = |effort| Planner::for_effort(effort).expect("the shipped weights").build();
    let tools = ToolChoice::Named(vec!["screwdriver".to_owned()]);
    let alone = Task { pushes: PushRules::none(), tools, ..task.clone() };
    let solution = planner(Effort::Draft).solve(&alone, &library()).expect("sound");
    assert_ne!(solution.status, PlanStatus::Solved, "a lever-up alone would do");
    let solve = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let solution = pool.install(|| planner(Effort::Draft).solve(&task, &library()));
        solution.expect("a sound task")
    };
    let solution = solve(1);
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().expect("a plan");
    assert!(best.plan.levers() && best.plan.push_steps().count() > 0);
    let again = solve(3);
    assert_eq!(again.best().expect("a plan").plan, best.plan, "for any number of threads");
    let file = plan_file(&task, best);
    let text = serde_json::to_string(&file).expect("numbers");
    let read = PlanFile::parse(&text, "again.json").expect("sound");
    assert_eq!((read.plan, read.predicted), (file.plan, file.predicted));
    let mixed = text.replacen("\"grip_yaw\"", "\"grip_jaw\"", 1);
    let fault = PlanFile::parse(&mixed, "mixed.json").expect_err("an unknown key");
    assert!(fault.to_string().contains("`grip_jaw`"), "{fault}");
}

/// Returns the faults of `TASK` with every `from` replaced.
fn faults(changes: &[(&str, &str)]) -> String {
    let text = changes.iter().fold(TASK.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("task.yaml");
    std::fs::write(&path, text).expect("a file");
    let found = load_task(&path, &library()).expect_err("a fault").to_string();
    found.replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn errors_of_files_have_reason_and_location() {
    insta::assert_snapshot!(faults(&[(", position: [0.6, 0], tolerance: 0.01", "")]), @r"
    task.yaml:7:9: error: pushes may follow, but the goal states no position to push to
      help: add `position` and `tolerance` to the goal, or remove this
    ");
    insta::assert_snapshot!(faults(&[("max_count: 1", "form: chained")]), @r"
    task.yaml:7:16: error: pushes that follow a lever-up are placed and cannot continue from `home`
      help: remove `form`
    ");
    insta::assert_snapshot!(faults(&[("screwdriver, paddle", "screwdriver")]), @r"
    task.yaml:6:8: error: the task allows pushes, but none of these tools can push
      help: add a tool that can push, or remove `pushes`
    ");
    insta::assert_snapshot!(faults(&[("screwdriver, paddle", "stick, paddle")]), @r"
    task.yaml:6:8: error: none of these tools has a blade
      help: name a tool that levers as well
    ");
    insta::assert_snapshot!(faults(&[("max_count: 1", "grip_yaws_deg: [0, 360]")]), @r"
    task.yaml:7:29: error: this is the same as item 1 of `grip_yaws_deg`
      help: remove one of the two
    ");
}
