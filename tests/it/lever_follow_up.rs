//! Pushes that follow a lever-up: their files, their engine, plans of both, and what is refused.

use std::path::Path;
use std::sync::Arc;

use pushplan::ToolLibrary;
use pushplan::asset::{LeverPlanFile, load_task};
use pushplan::effect::SimulatedLevers;
use pushplan::geometry::{Shape, Vector};
use pushplan::scene::{
    FollowUp, GRAVITY, LeverFault, LeverJob, LeverPlan, LeverReason, LeverScene, LeverUp,
    LeverVerdict, LeverWarning, Place, Plan, Push, PushForm, PushRules, Task, ToolChoice,
};
use pushplan::sim::LeverSimulator;
use pushplan::solve::lever::LeverPlanner;
use pushplan::solve::{Effort, PlanStatus};
use pushplan::verify::{LeverVerifier, VerifySettings};

/// A plate that is levered up a little and falls back, and may be pushed.
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

/// Half of the plate along x, metres.
const HALF: f64 = 0.06;

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn task() -> Task {
    Task::parse(TASK, "task.yaml").expect("sound")
}

/// A little up and back.
fn lever() -> LeverUp {
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

/// A push along x that begins with the tool's front this far before the plate, metres.
fn follow_up(gap: f64, length: f64) -> FollowUp {
    let tool = library().get("paddle").expect("shipped").clone();
    let front = tool.parts().iter().map(|part| match part.shape {
        Shape::Cuboid { size } => part.pose.position.x + 0.5 * size[0],
        _ => panic!("the paddle is made of cuboids"),
    });
    let front = front.fold(0.0, f64::max) - tool.grip.position.x;
    let start = Vector::new(0.5 - HALF - gap - front, 0.0);
    let push = Push { start, direction: 0.0, length, speed: 0.1 };
    let plan = Plan {
        tool: tool.name.clone(),
        grip_yaw: 0.0,
        form: PushForm::Placed,
        lift: 0.002,
        pushes: vec![push],
    };
    FollowUp { tool, plan }
}

fn verify(task: &Task, follow_up: FollowUp) -> LeverVerdict {
    let blade = library().get("screwdriver").expect("shipped").clone();
    let plan = LeverPlan { tool: blade.name.clone(), lever: lever(), follow_up: Some(follow_up) };
    LeverVerifier::new(VerifySettings { disturbed: 4, seed: 0 }).verify(task, &blade, &plan)
}

#[test]
fn a_push_carries_the_plate_as_far_as_the_tool_goes() {
    let task = task();
    let blade = library().get("screwdriver").expect("shipped").clone();
    let scene = Arc::new(LeverScene::with(&task.scene, &blade));
    let job = LeverJob { scene, lever: lever() };
    let engine = LeverSimulator::FINE;
    let alone = engine.run(&job);
    let (gap, length) = (0.02, 0.10);
    let pushed = engine.run_with(&job, &job.scene, Some(&follow_up(gap, length).motion()));
    assert_eq!(pushed.lift, alone.lift, "the lever-up is the same");
    // It is carried from where it fell back to, and then slides on by v^2 / (2 mu g).
    let moved = pushed.rest.position - alone.rest.position;
    let began = alone.rest.position.x - 0.5;
    let friction = 0.5 * (0.4 + task.scene.table_friction);
    let carried = length - gap - began + 0.1 * 0.1 / (2.0 * friction * GRAVITY);
    assert!((moved.x - carried).abs() < 3e-4, "{moved:?} for {carried}");
    assert!(moved.y.abs() < 2e-3 && pushed.rest.tilt() < 0.01, "{pushed:?}");
    assert_eq!(pushed.warnings, alone.warnings);
}

#[test]
fn the_whole_is_judged_and_disturbed_as_one() {
    let verdict = verify(&task(), follow_up(0.02, 0.12));
    assert!(verdict.passed, "{:?}", verdict.reason);
    assert_eq!(verdict.evidence.len(), 5);
    // Too short a push misses, and says so.
    let short = verify(&task(), follow_up(0.02, 0.05));
    assert_eq!(short.reason, Some(LeverReason::Misses));
    let end = short.nominal().expect("a replay").outcome.rest;
    assert!((end.x - 0.53).abs() < 5e-3, "{end:?}");
}

#[test]
fn what_pushes_must_not_do_is_found() {
    let on_it = verify(&task(), follow_up(-0.03, 0.12));
    assert_eq!(on_it.reason, Some(LeverReason::GoesWrong(LeverWarning::SetDown)));
    let walled = TASK.replace(
        "robot:",
        "  obstacles: [{name: wall, size: [0.01, 0.4, 0.03], position: [0.41, 0]}]\nrobot:",
    );
    let walled = Task::parse(&walled, "walled.yaml").expect("sound");
    let through = verify(&walled, follow_up(0.04, 0.14));
    assert!(
        through.forbidden.contains(&LeverFault::PushMeets { body: "wall".to_owned() }),
        "{:?}",
        through.forbidden
    );
    let forbidden = |task: &Task, follow_up: FollowUp| verify(task, follow_up).forbidden;
    let mut far = follow_up(0.02, 0.12);
    far.plan.pushes[0].length = 1.0;
    assert!(forbidden(&task(), far).contains(&LeverFault::OutOfReach));
    let push = LeverFault::ForbiddenLever { what: "push".to_owned() };
    let mut twice = follow_up(0.02, 0.12);
    twice.plan.pushes.push(twice.plan.pushes[0]);
    assert!(forbidden(&task(), twice).contains(&push), "one is allowed");
    let mut turned = follow_up(0.02, 0.12);
    turned.plan.grip_yaw = 0.3;
    assert!(forbidden(&task(), turned).contains(&push));
    let none = task().pushing(PushRules::none());
    assert!(forbidden(&none, follow_up(0.02, 0.12)).contains(&push));
    let mut endless = follow_up(0.02, 0.12);
    endless.plan.pushes[0].speed = 1e-4;
    assert_eq!(forbidden(&task(), endless), [LeverFault::TooLong]);
}

#[test]
fn the_shipped_task_needs_both_and_its_plan_reads_back() {
    let path = Path::new(crate::ROOT).join("tasks/levers/turn-and-push.yaml");
    let task = load_task(&path, &library()).expect("a task of levering");
    let planner =
        |effort| LeverPlanner::new(SimulatedLevers { simulator: LeverSimulator::COARSE }, effort);
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
    assert!(best.plan.follow_up.is_some() && best.pushed.is_some());
    let again = solve(3);
    assert_eq!(again.best().expect("a plan").plan, best.plan, "for any number of threads");
    let file = LeverPlanFile {
        task: task.clone(),
        tool: best.tool.clone(),
        plan: best.plan.clone(),
        model: None,
        predicted: Some(best.predicted.clone()),
        verdict: best.verdict.clone(),
    };
    let text = serde_json::to_string(&file).expect("numbers");
    let read = LeverPlanFile::parse(&text, "again.json").expect("sound");
    assert_eq!((read.plan, read.predicted), (file.plan, file.predicted));
    let mixed = text.replacen("\"grip_yaw\"", "\"grip_jaw\"", 1);
    let fault = LeverPlanFile::parse(&mixed, "mixed.json").expect_err("an unknown key");
    assert!(fault.to_string().contains("`grip_jaw`"), "{fault}");
    // What the lever-up leaves is a task of its own that a file can hold.
    let left = &best.pushed.as_ref().expect("pushes").task;
    let text = left.to_yaml().expect("numbers");
    assert_eq!(&pushplan::Task::parse(&text, "left.yaml").expect("sound"), left);
}

/// The faults of `TASK` with every `from` replaced.
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
fn faults_of_files_say_what_and_where() {
    insta::assert_snapshot!(faults(&[(", position: [0.6, 0], tolerance: 0.01", "")]), @r"
    task.yaml:7:9: error: pushes may follow, but the goal names no place to push to
      help: add `position` and `tolerance` to the goal, or remove this
    ");
    insta::assert_snapshot!(faults(&[("max_count: 1", "form: chained")]), @r"
    task.yaml:7:16: error: pushes that follow a lever-up are placed, none goes on from `home`
      help: remove `form`
    ");
    insta::assert_snapshot!(faults(&[("screwdriver, paddle", "screwdriver")]), @r"
    task.yaml:6:8: error: pushes may follow, but none of these tools pushes
      help: name one that pushes, too, or remove `pushes`
    ");
    insta::assert_snapshot!(faults(&[("screwdriver, paddle", "stick, paddle")]), @r"
    task.yaml:6:8: error: none of these tools has a blade
      help: name one that levers, too
    ");
    insta::assert_snapshot!(faults(&[("max_count: 1", "grip_yaws_deg: [0, 360]")]), @r"
    task.yaml:7:29: error: this is the same as item 1 of `grip_yaws_deg`
      help: remove one of the two
    ");
}
