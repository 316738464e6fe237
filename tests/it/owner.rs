//! Errors that the robot's owner would see at once: hands in walls, gaps that are too narrow,
//! pushes that no arm can execute, and plans of a form that is not allowed.

use std::sync::Arc;

use pushplan::asset::ToolLibrary;
use pushplan::geometry::{Pose, Vector, wrap_angle};
use pushplan::progress::NoProgress;
use pushplan::sim::Simulator;
use pushplan::solve::{Cause, Effort, PlanStatus, Planner, RankedPlan, Solution};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    outcome::{PushFault, Record, Verdict, Warning},
    scene::{Object, Scene, Situation, Tool},
    task::{Job, Plan, Push, PushForm, Task, ToolMotion, Truth},
};
use pushplan_act::act::{End, Note, RunSettings, Runner, SimulatedWorld, Trace};
use pushplan_report::solution_document;

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").unwrap_or_else(|faults| panic!("{faults}"))
}

fn planner() -> Planner {
    Planner::for_effort(Effort::Draft).expect("its models").build()
}

fn solved(task: &Task) -> Solution {
    planner().solve(task, &library()).expect("a sound task")
}

/// Returns a task with a can before a pen whose entrance is narrower than the can by `less` metres.
fn pen(less: f64, unknown: &str) -> Task {
    let half = 0.04 - 0.5 * less;
    let side = 0.17 - half;
    let at = half + 0.5 * side;
    task(&format!(
        "
scene:
  objects: [{{name: can, shape: {{cylinder: {{radius: 0.04, height: 0.08}}}}, mass: 0.4, friction: 0.4, position: [0.42, 0]}}]
  obstacles:
    - {{name: back, size: [0.02, 0.34, 0.12], position: [0.79, 0]}}
    - {{name: front-left, size: [0.02, {side}, 0.12], position: [0.53, {at}]}}
    - {{name: front-right, size: [0.02, {side}, 0.12], position: [0.53, -{at}]}}
    - {{name: left, size: [0.24, 0.02, 0.12], position: [0.66, 0.16]}}
    - {{name: right, size: [0.24, 0.02, 0.12], position: [0.66, -0.16]}}
{unknown}
robot: {{reach: {{min: 0.05, max: 0.95}}}}
tools: [finger, paddle, stick]
pushes: {{length: 0.3, directions: 8, max_count: 2}}
goal: {{object: can, position: [0.66, 0], tolerance: 0.03}}
"
    ))
}

#[test]
fn a_can_does_not_come_through_a_gap_that_is_a_little_too_narrow() {
    for less in [0.0002, 0.001, 0.002] {
        let found = solved(&pen(less, ""));
        assert!(!matches!(found.status, PlanStatus::Solved | PlanStatus::Fragile), "{less}");
    }
    // With a positive clearance it works.
    assert_eq!(solved(&pen(-0.004, "")).status, PlanStatus::Solved);
}

/// Runs `task` in a world that `truth` changes.
fn run(task: &Task, truth: impl FnOnce(&mut Truth)) -> (Trace, SimulatedWorld) {
    let planner = Planner::for_effort(Effort::Draft).expect("its models").build();
    let mut real = Truth::stated(&task.scene, 1);
    truth(&mut real);
    let settings = RunSettings { max_pushes: 4, samples: 4, ..RunSettings::default() };
    let mut world = SimulatedWorld::new(real).pushed_with(task.robot.max_force);
    let mut trace = Trace::new(task.clone(), settings, "draft".into(), None);
    let library = library();
    let runner = Runner::new(&planner, &library);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
    (trace, world)
}

#[test]
fn a_run_comes_through_no_gap_that_is_too_narrow_however_often_it_pushes() {
    let task = pen(0.002, "unknown: [masses, frictions]");
    let (trace, world) = run(&task, |_| ());
    assert_ne!(trace.end, Some(End::Reached));
    // Because the can is round, it moves slightly in between the posts.
    assert!(world.state().poses[0].position.x < 0.515);
    let ended = |note: &Note| matches!(note, Note::Ended { why } if why.contains("jams"));
    assert!(trace.all_notes().any(ended), "{:?}", trace.all_notes().collect::<Vec<_>>());
}

const CAN: &str = "
scene:
  objects: [{name: can, shape: {cylinder: {radius: 0.04, height: 0.08}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}]
unknown: [masses, frictions]
robot: {reach: {min: 0.05, max: 0.9}, max_force: 3}
tools: [finger, paddle]
pushes: {directions: 8, max_count: 2}
goal: {object: can, position: [0.6, 0.03], tolerance: 0.02}
";

#[test]
fn an_arm_does_not_push_what_is_too_heavy_for_it() {
    let (trace, world) = run(&task(CAN), |truth| truth.scene.objects[0].mass = 500.0);
    assert_ne!(trace.end, Some(End::Reached));
    let moved = (world.state().poses[0].position - Vector::new(0.5, 0.0)).norm();
    assert!(moved < 2e-3, "{moved}");
    let light = run(&task(CAN), |_| ()).0;
    assert_eq!(light.end, Some(End::Reached));
}

#[test]
fn objects_that_would_topple_are_not_pushed_in_2d() {
    let post = |lift: f64| {
        let rules = format!("max_count: 2, lift: {lift}");
        let slim = "cuboid: {size: [0.03, 0.03, 0.28]}";
        let text = CAN.replace("cylinder: {radius: 0.04, height: 0.08}", slim);
        task(
            &text
                .replace("scene:", "scene:\n  table: {friction: 1}")
                .replace("max_count: 2", &rules)
                .replace(", max_force: 3", ""),
        )
    };
    // It slides if the friction moment (0.7 of the weight) is less than the weight moment.
    for (lift, slides) in [(0.002, true), (0.2, false)] {
        assert_eq!(matches!(solved(&post(lift)).status, PlanStatus::Solved), slides, "{lift}");
        assert_eq!(run(&post(lift), |_| ()).0.end == Some(End::Reached), slides, "{lift}");
    }
}

#[test]
fn displaced_objects_are_pushed_at_their_true_poses() {
    let elsewhere = |truth: &mut Truth| truth.scene.objects[0].pose.position.y = 0.11;
    let (trace, world) = run(&task(CAN), elsewhere);
    assert_eq!(trace.notes, [Note::Elsewhere { object: 0 }]);
    assert!(trace.end == Some(End::Reached) && trace.task.goals[0].reached(world.state()));
}

/// Thin can in a closed pen with walls as high as the lower end of the hand.
const PEN: &str = "
scene:
  objects: [{name: can, shape: {cylinder: {radius: 0.012, height: 0.06}}, mass: 0.2, friction: 0.4, position: [0.7675, 0.02]}]
  obstacles:
    - {name: far, size: [0.02, 0.4, 0.12], position: [0.8075, 0]}
    - {name: near, size: [0.02, 0.4, 0.12], position: [0.1925, 0]}
    - {name: left, size: [0.595, 0.02, 0.12], position: [0.5, 0.19]}
    - {name: right, size: [0.595, 0.02, 0.12], position: [0.5, -0.19]}
robot: {reach: {min: 0.05, max: 0.95}}
tools: [stick]
pushes: {length: 0.08, max_count: 2, directions: 8}
goal: {object: can, position: [0.7675, -0.03], tolerance: 0.01}
";

#[test]
fn a_tool_is_not_held_through_a_wall_unless_the_robot_has_no_body() {
    assert_eq!(solved(&task(PEN)).status, PlanStatus::NoPlan);
    let bodiless = PEN.replace("max: 0.95}", "max: 0.95}, hand: none, base: none");
    assert_eq!(solved(&task(&bodiless)).status, PlanStatus::Solved);
}

/// Returns the broken rules of pushes for `task` before anything moves.
fn forbidden(task: &Task, form: PushForm, lift: f64, pushes: &[([f64; 2], f64, f64)]) -> Verdict {
    let tool: Arc<Tool> = library().get("paddle").expect("a shipped tool").clone();
    let push = |(start, direction, length): &([f64; 2], f64, f64)| Push {
        start: Vector::from(*start),
        direction: *direction,
        length: *length,
        speed: 0.1,
    };
    let plan = Plan::pushing(&tool.name, 0.0, form, lift, pushes.iter().map(push));
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    verifier.nominal(task, &Situation::stated(&task.scene), &[tool], &plan)
}

#[test]
fn pushes_that_are_not_of_the_allowed_form_do_not_pass() {
    let placed = task(CAN);
    let one = [([0.4, 0.0], 0.0, 0.1)];
    let faults = |verdict: Verdict| -> Vec<PushFault> {
        let faults = verdict.forbidden.into_iter().filter_map(|warning| match warning {
            Warning::ForbiddenPush { fault, .. } => Some(fault),
            _ => None,
        });
        faults.collect()
    };
    let lift = placed.pushes.lift;
    assert_eq!(faults(forbidden(&placed, PushForm::Placed, lift, &one)), []);
    let slow = task(&CAN.replace("max_count: 2", "max_count: 2, speed: 0.05"));
    assert_eq!(faults(forbidden(&slow, PushForm::Placed, lift, &one)), [PushFault::Speed(0.1)]);
    assert_eq!(faults(forbidden(&placed, PushForm::Chained, lift, &one)), [PushFault::Form]);
    assert_eq!(faults(forbidden(&placed, PushForm::Placed, 0.01, &one)), [PushFault::Lift(0.01)]);
    let long = [([0.4, 0.0], 0.0, 0.4)];
    assert_eq!(faults(forbidden(&placed, PushForm::Placed, lift, &long)), [PushFault::Length(0.4)]);
    let thrice = [one[0], one[0], one[0]];
    let many = forbidden(&placed, PushForm::Placed, lift, &thrice).forbidden;
    assert!(many.contains(&Warning::TooManyPushes { pushes: 3, allowed: 2 }), "{many:?}");

    let chained = task(&CAN.replace("pushes: {", "pushes: {form: chained, "));
    let home: [f64; 2] = chained.robot.home.into();
    let jump = [(home, 0.0, 0.1), ([0.4, 0.1], 0.0, 0.1)];
    let found = faults(forbidden(&chained, PushForm::Chained, lift, &jump));
    assert!(matches!(found[..], [PushFault::Apart(far)] if far > 0.2), "{found:?}");
    let found = faults(forbidden(&chained, PushForm::Chained, lift, &one));
    assert!(matches!(found[..], [PushFault::Home(far)] if far > 0.3), "{found:?}");
    let few = task(&CAN.replace("directions: 8", "directions: [0]"));
    let back = [([0.7, 0.0], 3.0, 0.1)];
    assert_eq!(faults(forbidden(&few, PushForm::Placed, lift, &back)), [PushFault::Direction(3.0)]);
}

#[test]
fn jointed_objects_have_no_rotational_symmetry() {
    let text = "
scene:
  objects:
    - {name: bar, shape: {cuboid: {size: [0.1, 0.1, 0.05]}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}
    - {name: stem, shape: {cuboid: {size: [0.1, 0.04, 0.05]}}, mass: 0.4, friction: 0.4, position: [0.605, 0]}
  joints: [{between: [bar, stem], kind: fixed}]
robot: {reach: {min: 0.3, max: 0.9}}
tools: all
goal: {object: bar, position: [0.5, 0], tolerance: 0.02, heading_deg: 180}
";
    let whole = task(text);
    let at_the_start = whole.scene.start();
    assert!(!whole.goals[0].reached(&at_the_start));
    let alone = text.replace("  joints: [{between: [bar, stem], kind: fixed}]\n", "");
    assert!(task(&alone).goals[0].reached(&at_the_start));
}

/// Box whose path to the goal is blocked by a vase.
const VASE: &str = "
scene:
  objects:
    - {name: box, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.45, 0]}
    - {name: vase, shape: {cylinder: {radius: 0.03, height: 0.06}}, mass: 0.3, friction: 0.4, position: [0.56, 0.02]}
robot: {reach: {min: 0.3, max: 0.9}, hand: none}
tools: [paddle, finger]
pushes: {directions: [0]}
goal: {object: box, position: [0.6, 0], tolerance: 0.02}
";

#[test]
fn displaced_objects_are_reported_and_kept_objects_stay() {
    let text = |task: &Task| solution_document(task, &solved(task)).to_text();
    let shoved = text(&task(VASE));
    let line = shoved.lines().find(|line| line.starts_with("also moves: vase by "));
    assert!(line.is_some() && shoved.contains("solved with"), "{shoved}");
    let kept = task(&format!("{VASE}keep: {{objects: [vase], within: 0.005}}\n"));
    let solution = solved(&kept);
    assert!(!matches!(solution.status, PlanStatus::Solved | PlanStatus::Fragile));
    let again =
        Task::parse(&kept.to_yaml().expect("a file"), "kept.yaml").expect("the written task");
    assert_eq!(again, kept);
    // Beside the vase there is a free path.
    let aside = kept.to_yaml().expect("a file").replace("- 0.6\n  - 0.0", "- 0.58\n  - -0.14");
    let free = task(&aside.replace("directions:\n  - 0.0", "directions: 16"));
    let found = solved(&free);
    assert_eq!(found.status, PlanStatus::Solved, "{}", solution_document(&free, &found).to_text());
}

#[test]
fn kept_objects_are_present_and_moved_objects_are_not() {
    let faults = |keep: &str| {
        let text = format!("{VASE}keep: {keep}\n");
        Task::parse(&text, "task.yaml").expect_err("a fault").to_string()
    };
    assert!(faults("{objects: [urn]}").contains("no object is called `urn`"));
    assert!(faults("{objects: [box]}").contains("`box` is named by a goal and by `keep`"));
}

#[test]
fn a_scene_that_is_turned_with_its_push_ends_turned_in_3d() {
    let tool = library().get("finger").expect("a shipped tool").clone();
    let end = |turn: f64| {
        let turned = Pose { position: Vector::zeros(), heading: turn };
        let pose = turned * Pose::new(0.55, 0.05, 0.35);
        let shape = [0.10, 0.06, 0.05];
        let box_ = Object::cuboid("box", shape).mass(0.5).friction(0.5);
        let scene = Scene::new([box_.at(pose.position.x, pose.position.y, pose.heading)]);
        let start = turned.point(Vector::new(0.42, 0.062));
        let push = Push { start, direction: turn, length: 0.2, speed: 0.1 };
        let motion = ToolMotion::pushes(tool.clone(), 0.002, turn, &[push], true);
        let job = Job::stated(&scene, motion);
        let run = Simulator::spatial().run(&scene, &job, Record::Outcome);
        turned.inverse() * run.outcome().poses[0]
    };
    let straight = end(0.0);
    for turn in [0.4, 0.5 * std::f64::consts::FRAC_PI_2, 2.0, -2.9] {
        let turned = end(turn);
        let off = (turned.position - straight.position).norm();
        let angle = wrap_angle(turned.heading - straight.heading).abs();
        assert!(off < 1e-4 && angle < 1e-3, "{turn}: {off} m, {angle} rad");
    }
}

/// Box that is pushed to 1 mm from the end of the table, or by a tool that hardly touches it.
const EDGE: &str = "
scene:
  table: {size: [0.8, 1], position: [0.3, 0]}
  objects: [{name: box, shape: {cuboid: {size: [0.08, 0.08, 0.08]}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}]
robot: {reach: {min: 0.05, max: 0.95}}
tools: [finger, paddle]
pushes: {length: 0.3, directions: 8, max_count: 2}
goal: {object: box, position: [0.699, 0], tolerance: 0.002}
";

#[test]
fn plans_with_a_margin_of_a_millimetre_are_fragile() {
    let planner = Planner::for_effort(Effort::Standard).expect("its models").build();
    let status = |text: &str| planner.solve(&task(text), &library()).expect("sound").status;
    assert_eq!(status(EDGE), PlanStatus::Fragile);
    let room = |at: &str| EDGE.replace("0.699", at).replace("tolerance: 0.002", "tolerance: 0.01");
    assert_eq!(status(&room("0.68")), PlanStatus::Solved);
    let low = room("0.62");
    let held = |lift: f64| low.replace("length: 0.3", &format!("length: 0.3, lift: {lift}"));
    assert_eq!(status(&held(0.0798)), PlanStatus::Fragile);
    assert_eq!(status(&held(0.06)), PlanStatus::Solved);
}

/// Can whose goal is farther than the length of one push.
const FAR: &str = "
scene:
  objects: [{name: can, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.35, 0]}]
robot: {reach: {min: 0.1, max: 0.95}}
tools: all
goal: {object: can, position: [0.81, 0], tolerance: 0.02}
";

#[test]
fn as_many_pushes_are_made_as_it_takes_and_no_more() {
    let pushes = |task: &Task| {
        let found = solved(task);
        assert_eq!(found.status, PlanStatus::Solved);
        found.best().expect("a plan").plan.pushes().len()
    };
    assert_eq!(pushes(&task(FAR)), 2);
    assert_eq!(pushes(&task(&FAR.replace("0.81", "0.5"))), 1);
}

#[test]
fn obstructions_of_a_plan_are_named() {
    let cause = |text: &str| {
        let task = task(text);
        let found = solved(&task);
        assert_eq!(found.status, PlanStatus::NoPlan, "{text}");
        let first = solution_document(&task, &found).title;
        let cause = found.cause.expect("a cause");
        let why = planner().why(&task, &library(), &NoProgress).expect("a sound task");
        assert_eq!(why.as_ref(), Some(&cause));
        assert!(first.starts_with(&format!("task: no plan: {cause}")), "{first}");
        // A plan must be clearly nearer to the goal than doing nothing.
        let start = task.goals[0].error(&task.scene.start());
        let nearer = |ranked: &RankedPlan| ranked.outcome.error() < start - 5e-3;
        assert!(found.plans.iter().filter(|ranked| !ranked.plan.is_empty()).all(nearer));
        cause
    };
    let with =
        |pushes: &str| FAR.replace("tools: all", &format!("tools: all\npushes: {{{pushes}}}"));
    let short = cause(&with("max_count: 1"));
    assert!(matches!(short, Cause::TooFewPushes { allowed: 1, .. }), "{short:?}");
    let one = cause(&with("max_count: 2, length: 0.05").replace("0.81", "0.7"));
    assert!(matches!(one, Cause::TooFewPushes { length: 0.05, .. }), "{one:?}");
    let narrow = with("directions: [0]").replace("[0.81, 0]", "[0.35, 0.3]");
    assert_eq!(cause(&narrow), Cause::Directions { needed: 16 });
    let paddle = FAR.replace("tools: all", "tools: [paddle]").replace("max: 0.95", "max: 0.4");
    let Cause::Tool { needed } = cause(&paddle) else { panic!("the task names one tool") };
    assert_ne!(needed, "paddle");
    let away = FAR.replace("0.35, 0]", "1.6, 0]").replace("0.81", "1.8");
    let Cause::Beyond { needed: 1.8..2.0, .. } = cause(&away) else { panic!("it is far away") };
    assert!(matches!(cause(PEN), Cause::Hand { .. }));
    assert_eq!(planner().why(&task(FAR), &library(), &NoProgress).expect("a sound task"), None);
}

#[test]
fn pushes_turn_no_farther_from_what_is_allowed_however_often_they_are_aimed_again() {
    let text = FAR.replace("tools: all", "tools: all\npushes: {directions: [0]}");
    let found = solved(&task(&text.replace("[0.81, 0]", "[0.4, 0.2]")));
    let pushes = found.plans.iter().flat_map(|ranked| ranked.plan.pushes());
    let most = pushes.map(|push| push.direction.abs()).fold(0.0, f64::max);
    assert!(most > 0.1 && most < 0.44, "{most}");
}

#[test]
fn solved_plans_are_not_fragile_in_verification() {
    let folder = std::path::Path::new(crate::ROOT).join("tasks");
    for name in ["triangle-turned", "turn-the-box", "pull-back"] {
        let task = Task::load(folder.join(format!("{name}.yaml"))).expect("a shipped task");
        let planner = Planner::for_effort(Effort::Standard).expect("its models").build();
        let found = planner.solve(&task, &library()).expect("a sound task");
        let best = found.best().expect("a plan");
        let situation = Situation::stated(&task.scene);
        let verifier = Verifier::new(VerifySettings { replays: 8, seed: 0 }).until_clear();
        let verdict = verifier.verify(&task, &situation, &best.tools, &best.plan);
        assert_eq!(verdict.passed, found.status == PlanStatus::Solved, "{name}");
        assert_eq!(Some(&verdict.robustness), best.verdict.as_ref().map(|own| &own.robustness));
    }
}
