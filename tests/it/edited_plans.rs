//! Plans that were edited: `verify` recomputes everything that the planner promises of pushes, of
//! lever-ups and of an arm's joints.

use std::f64::consts::PI;
use std::sync::Arc;

use pushplan::ToolLibrary;
use pushplan::asset::PlanFile;
use pushplan::geometry::{Pose, Vector};
use pushplan::outcome::{LeverFault, PushFault, Reason, Verdict, Warning};
use pushplan::scene::{ArmFault, JointTrajectory, Object, Situation, Tool};
use pushplan::task::{LeverUp, Plan, Push, PushForm, Step, Task};
use pushplan::verify::{Verifier, VerifySettings, rule_violations};

use crate::arms;
use crate::lever_follow_up::lever;

const SCREWDRIVER: &str = "screwdriver";

/// Plate whose right edge is at x = 0.56 m.
const PLATE: &str = "
scene:
  objects:
    - {name: plate, shape: {cuboid: {size: [0.12, 0.08, 0.008]}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [screwdriver]
levers: {pivot: auto, depth: [0.008, 0.2]}
goal: {object: plate, flipped: false}
";

/// Can that a hook pulls back, and room for a bottle beside the handle.
const CAN: &str = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.05, height: 0.1}}, mass: 0.4, friction: 0.4, \
position: [0.82, 0.1]}
robot: {reach: {min: 0.3, max: 0.7}}
tools: [l-hook]
goal: {object: can, position: [0.65, 0.1], tolerance: 0.02}
";

fn task(text: &str) -> Task {
    Task::parse(text, "task.yaml").expect("sound")
}

fn tool(name: &str) -> Arc<Tool> {
    ToolLibrary::embedded().expect("the shipped tools").get(name).expect("shipped").clone()
}

/// Returns the rules that a plan breaks in its nominal replay.
fn forbidden(task: &Task, tool: &Arc<Tool>, plan: &Plan) -> Vec<Warning> {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let situation = Situation::stated(&task.scene);
    verifier.nominal(task, &situation, std::slice::from_ref(tool), plan).forbidden
}

fn cannot(step: usize, fault: LeverFault) -> Warning {
    Warning::CannotLever { step, fault }
}

#[test]
fn every_number_of_a_lever_up_follows_the_rules_of_its_task() {
    let (task, tools) = (task(PLATE), [tool(SCREWDRIVER)]);
    let broken = |plan: &Plan| rule_violations(&task, &task.scene, &tools, plan);
    let levering = |lever: LeverUp| broken(&Plan::levering(SCREWDRIVER, lever));
    assert_eq!(levering(lever()), []);
    let what = |what: &str| cannot(0, LeverFault::ForbiddenLever { what: what.to_owned() });
    for (change, found) in [
        (LeverUp { speed: 1.5, ..lever() }, what("speed")),
        (LeverUp { speed: 0.05, ..lever() }, what("speed")),
        (LeverUp { hold: 0.0, ..lever() }, what("hold")),
        (LeverUp { hold: 1.2, ..lever() }, what("hold")),
        (LeverUp { retreat: 0.0, ..lever() }, what("retreat")),
        (LeverUp { retreat: 0.05, ..lever() }, what("retreat")),
        (LeverUp { pivot: 0.16, ..lever() }, what("pivot")),
        (LeverUp { angle: 0.1, ..lever() }, what("angle")),
        (LeverUp { depth: 0.004, ..lever() }, what("depth")),
        (LeverUp { pivot: 0.005, ..lever() }, cannot(0, LeverFault::NoSupport)),
        (LeverUp { depth: 0.13, ..lever() }, cannot(0, LeverFault::TooDeep)),
    ] {
        let broken = levering(change);
        assert!(broken.contains(&found), "{change:?}: {broken:?}");
    }
    let twice = Plan::levering(SCREWDRIVER, lever()).then(Plan::levering(SCREWDRIVER, lever()));
    let what = "second lever-up of an object".to_owned();
    assert_eq!(broken(&twice), [cannot(1, LeverFault::ForbiddenLever { what })]);
}

#[test]
fn blade_and_fingers_keep_clear_of_objects_and_find_their_object() {
    let (task, tool) = (task(PLATE), tool(SCREWDRIVER));
    let plan = Plan::levering(SCREWDRIVER, lever());
    assert_eq!(forbidden(&task, &tool, &plan), []);
    let with = |x: f64, y: f64| {
        let mut task = task.clone();
        let block = Object::cuboid("block", [0.02, 0.02, 0.05]);
        task.scene.objects.push(block.at(x, y, 0.0));
        forbidden(&task, &tool, &plan)
    };
    let body = || "block".to_owned();
    assert_eq!(with(0.6, 0.0), [cannot(0, LeverFault::Meets { body: body() })]);
    // Beside the shaft, where the fingers hold it.
    let behind = 0.56 - 0.012 + tool.blade().expect("a blade").length + 0.02;
    assert_eq!(with(behind, 0.02), [cannot(0, LeverFault::HandMeets { body: body() })]);
    assert_eq!(with(behind, 0.06), []);

    let mut elsewhere = plan;
    let Step::LeverUp(step) = &mut elsewhere.steps[0] else { panic!("a lever-up") };
    step.expected = Some(Pose::new(0.52, 0.0, 0.0));
    assert_eq!(forbidden(&task, &tool, &elsewhere), [cannot(0, LeverFault::Displaced)]);
}

#[test]
fn a_hand_passes_through_no_object_as_tall_as_itself() {
    let tool = tool("l-hook");
    let push = Push { start: Vector::new(0.485, -0.02), direction: PI, length: 0.174, speed: 0.1 };
    let plan = Plan::pushing("l-hook", 0.0, PushForm::Placed, 0.002, [push]);
    let mut task = task(CAN);
    assert_eq!(forbidden(&task, &tool, &plan), []);
    let bottle = Object::cylinder("bottle", 0.015, 0.3).at(0.398, 0.04, 0.0);
    task.scene.objects.push(bottle);
    let through = Warning::HandThrough { push: 0, obstacle: "bottle".to_owned() };
    assert_eq!(forbidden(&task, &tool, &plan), [through]);
}

#[test]
fn chained_pushes_are_at_most_as_long_as_their_task_states() {
    let task = task(&CAN.replace("goal:", "pushes: {form: chained, max_count: 1}\ngoal:"));
    let long = |length: f64| {
        let push = Push { start: task.robot.home, direction: 0.0, length, speed: 0.1 };
        let plan = Plan::pushing("l-hook", 0.0, PushForm::Chained, 0.002, [push]);
        rule_violations(&task, &task.scene, &[tool("l-hook")], &plan)
    };
    assert_eq!(long(0.2), []);
    let fault = PushFault::Length(0.22);
    assert_eq!(long(0.22), [Warning::ForbiddenPush { push: 0, fault }]);
}

/// Stretches the time between two points of a trajectory.
fn stretch(path: &mut JointTrajectory, [from, to]: [usize; 2], factor: f64) {
    let begun = path.points[from].time;
    let more = (path.points[to].time - begun) * (factor - 1.0);
    for point in &mut path.points[from..=to] {
        point.time = begun + factor * (point.time - begun);
        point.velocities.iter_mut().for_each(|velocity| *velocity /= factor);
        point.accelerations.iter_mut().for_each(|rate| *rate /= factor * factor);
    }
    path.points[to + 1..].iter_mut().for_each(|point| point.time += more);
}

/// Goes to the end of the first push, and back along its line, before it pushes.
fn sweep_back(path: &mut JointTrajectory) {
    let [begin, end] = path.pushes[0];
    let back = path.points[begin..=end].iter().rev().cloned();
    let mut points = vec![path.points[0].clone()];
    points.extend(back);
    for (k, point) in points.iter_mut().enumerate() {
        point.time = 3.0 * k as f64;
        point.velocities.iter_mut().for_each(|velocity| *velocity = 0.0);
        point.accelerations.iter_mut().for_each(|rate| *rate = 0.0);
    }
    let later = 3.0 * points.len() as f64 - path.points[begin].time;
    let shift = points.len() - begin - 1;
    points.extend(path.points[begin + 1..].iter().cloned().map(|mut point| {
        point.time += later;
        point
    }));
    path.points = points;
    path.pushes.iter_mut().for_each(|push| *push = push.map(|point| point + shift));
}

#[test]
fn joints_begin_at_home_and_move_the_tool_as_it_was_replayed() {
    // With high limits of acceleration and jerk, of which edits of the times are otherwise a fault.
    let limits = "joint_limits: {acceleration: 10000, jerk: 1000000}, tool_mount";
    let folder = arms::folder(&arms::ROBOT.replace("tool_mount", limits));
    assert_eq!(arms::solve(folder.path()).status.code(), Some(0));
    let file = PlanFile::load(folder.path().join("out/push.plan.json")).expect("a plan");
    let joints = file.joints.as_ref().expect("a motion of joints");
    let (push, last) = (joints.pushes[0], joints.points.len() - 1);
    let verdict = |change: &dyn Fn(&mut JointTrajectory)| -> Verdict {
        let mut changed = joints.clone();
        change(&mut changed);
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        let situation = Situation::stated(&file.task.scene);
        let verifier = verifier.moving(Some(&changed));
        verifier.nominal(&file.task, &situation, &file.tools, &file.plan)
    };
    let fault = |change: &dyn Fn(&mut JointTrajectory)| match verdict(change).reason {
        Some(Reason::Forbidden(Warning::Arm { fault, .. })) => fault,
        other => panic!("{other:?}"),
    };
    assert!(verdict(&|_| ()).passed);
    let jumps = fault(&|path| path.points[0].positions[1] += 0.5);
    assert!(matches!(jumps, ArmFault::NotHome { distance, .. } if (distance - 0.5).abs() < 1e-9));
    for end in [0, last] {
        let joint = "elbow".to_owned();
        let moves = fault(&|path| path.points[end].velocities[2] = 0.3);
        assert_eq!(moves, ArmFault::NotAtRest { joint });
    }
    // The whole trajectory, or the push alone, runs at another speed.
    for factor in [0.8, 1.25] {
        for part in [[0, last], push] {
            let runs = fault(&|path| stretch(path, part, factor));
            let ArmFault::Pace { speed, planned } = runs else { panic!("{runs:?}") };
            assert!((speed > planned) == (factor < 1.0) && planned == 0.1, "{speed}");
        }
    }
    let stops = fault(&|path| {
        let inner = path.points[push[0]..push[1]].iter_mut();
        inner.for_each(|point| point.velocities.iter_mut().for_each(|v| *v = 0.0));
    });
    assert!(matches!(stops, ArmFault::Pace { .. }), "{stops:?}");
    let late = fault(&|path| path.points.iter_mut().for_each(|point| point.time += 1.0));
    assert_eq!(late, ArmFault::OfAnother);
    let swept = fault(&sweep_back);
    let between = ["tool", "can"].map(str::to_owned);
    assert_eq!(swept, ArmFault::Collides { between });

    // An arm levers nothing.
    let levering = Task { arm: file.task.arm.clone(), ..task(PLATE) };
    let plan = Plan::levering(SCREWDRIVER, lever());
    let found = rule_violations(&levering, &levering.scene, &[tool(SCREWDRIVER)], &plan);
    assert_eq!(found, [cannot(0, LeverFault::ByArm)]);
}
