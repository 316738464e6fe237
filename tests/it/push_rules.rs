//! Rules of pushes apply equally in plans with lever-ups and in plans of pushes alone.

use std::sync::Arc;

use pushplan::ToolLibrary;
use pushplan::geometry::Vector;
use pushplan::outcome::{LeverFault, PushFault, Warning};
use pushplan::scene::{Obstacle, Scene, Situation, Tool};
use pushplan::task::{LeverUp, Plan, Push, PushForm, PushStep, Step, Task};
use pushplan::verify::{Verifier, VerifySettings, rule_violations};

use crate::lever_follow_up::lever;

/// Plate that may be pushed and levered.
const TASK: &str = "
scene:
  objects:
    - {name: plate, shape: {cuboid: {size: [0.12, 0.08, 0.008]}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: [screwdriver, paddle, stick]
pushes: {max_count: 2}
levers: {pivot: auto}
goal: {object: plate, flipped: false, position: [0.6, 0], tolerance: 0.01}
";

fn lever_task() -> Task {
    Task::parse(TASK, "task.yaml").expect("sound")
}

/// Returns the task without lever-ups.
fn push_task(task: &Task) -> Task {
    Task { levers: None, ..task.clone() }
}

fn tools() -> Vec<Arc<Tool>> {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    ["screwdriver", "paddle", "stick"]
        .map(|name| library.get(name).expect("shipped").clone())
        .into()
}

/// Returns two pushes that break no rule.
fn pushes() -> Vec<PushStep> {
    [0.2, 0.22]
        .map(|x| PushStep {
            tool: "paddle".to_owned(),
            grip_yaw: 0.0,
            form: PushForm::Placed,
            lift: 0.002,
            push: Push { start: Vector::new(x, 0.0), direction: 0.0, length: 0.1, speed: 0.1 },
        })
        .into()
}

/// Returns the rules that pushes break in a plan of their own, after asserting that they break the
/// same rules before a lever-up.
fn broken(task: &Task, steps: Vec<PushStep>) -> Vec<Warning> {
    let pushing = Plan { steps: steps.into_iter().map(Step::Push).collect() };
    let levering = pushing.clone().then(Plan::levering("screwdriver", lever()));
    let broken = |task: &Task, plan: &Plan| rule_violations(task, &task.scene, &tools(), plan);
    let alone = broken(&push_task(task), &pushing);
    let changes = |one: &Warning| matches!(one, Warning::TooManyToolChanges { .. });
    if !alone.iter().any(changes) {
        assert_eq!(broken(task, &levering), alone, "with a lever-up");
    }
    alone
}

/// Returns the only rule that the second push breaks after a change.
fn changed(task: &Task, change: impl FnOnce(&mut PushStep)) -> Warning {
    let mut steps = pushes();
    change(&mut steps[1]);
    let [only] = broken(task, steps).try_into().expect("one broken rule");
    only
}

#[test]
fn pushes_that_the_task_allows_break_no_rule() {
    assert_eq!(broken(&lever_task(), pushes()), []);
}

#[test]
fn each_property_of_a_push_has_its_rule() {
    let task = lever_task();
    let fault = |fault| Warning::ForbiddenPush { push: 1, fault };
    let form = changed(&task, |step| step.form = PushForm::Chained);
    assert_eq!(form, fault(PushFault::Form));
    assert_eq!(changed(&task, |step| step.lift = 0.02), fault(PushFault::Lift(0.02)));
    let aside = changed(&task, |step| step.push.direction = 0.7);
    assert_eq!(aside, fault(PushFault::Direction(0.7)));
    let long = changed(&task, |step| step.push.length = 0.35);
    assert_eq!(long, fault(PushFault::Length(0.35)));
    let fast = changed(&task, |step| step.push.speed = 5.0);
    assert_eq!(fast, fault(PushFault::Speed(5.0)));
    assert_eq!(changed(&task, |step| step.push.speed = 0.05), fault(PushFault::Speed(0.05)));
    let turned = changed(&task, |step| step.grip_yaw = 0.3);
    assert_eq!(turned, Warning::ForbiddenYaw { yaw: 0.3 });
    let far = changed(&task, |step| step.push.start.x = 0.85);
    assert_eq!(far, Warning::OutOfReach { push: 1 });
    let foreign = changed(&task, |step| step.tool = "rake".to_owned());
    assert_eq!(foreign, Warning::ForbiddenTool { tool: "rake".to_owned() });
}

#[test]
fn pushes_in_a_row_and_changes_of_the_tool_are_counted() {
    let mut task = lever_task();
    let row = [pushes(), pushes()].concat();
    assert_eq!(broken(&task, row), [Warning::TooManyPushes { pushes: 4, allowed: 2 }]);
    task.pushes.tool_changes = Some(0);
    let other = changed(&task, |step| step.tool = "stick".to_owned());
    assert_eq!(other, Warning::TooManyToolChanges { changes: 1, allowed: 0 });
    // A change from the tool to a blade also counts as a tool change.
    let push = |step: PushStep| Plan { steps: vec![Step::Push(step)] };
    let plan = push(pushes().remove(0)).then(Plan::levering("screwdriver", lever()));
    let found = rule_violations(&task, &task.scene, &tools(), &plan);
    assert_eq!(found, [Warning::TooManyToolChanges { changes: 1, allowed: 0 }]);
}

#[test]
fn tool_hand_and_lifted_tool_keep_clear_of_obstacles() {
    let with = |name: &str, size: [f64; 3], at: [f64; 2], z: f64| {
        let mut task = lever_task();
        let obstacle = Obstacle::cuboid(name, size).at(at[0], at[1], 0.0);
        task.scene.obstacles.push(Obstacle { z, ..obstacle });
        task
    };
    let named = |name: &str| name.to_owned();
    let through = |push| Warning::ThroughObstacle { push, obstacle: named("post") };
    let post = with("post", [0.02, 0.02, 0.01], [0.4, 0.0], 0.0);
    let far = |step: &mut PushStep| step.push.start.y = 0.3;
    assert!(broken(&post, pushes()).contains(&through(1)));
    let mut aside = pushes();
    aside.iter_mut().for_each(far);
    assert_eq!(broken(&post, aside), []);
    // A beam above the tool obstructs the hand.
    let beam = with("beam", [0.02, 0.3, 0.05], [0.2, 0.0], 0.2);
    let hand = Warning::HandThrough { push: 0, obstacle: named("beam") };
    assert!(broken(&beam, pushes()).contains(&hand), "{:?}", broken(&beam, pushes()));
    // A wall across the whole reach that is too high to travel over.
    let wall = with("wall", [2.0, 0.01, 0.5], [0.0, 0.25], 0.0);
    let wall = push_task(&wall);
    let mut beyond = pushes();
    beyond[1].push.start.y = 0.5;
    let plan = Plan { steps: beyond.into_iter().map(Step::Push).collect() };
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let verdict = verifier.nominal(&wall, &Situation::stated(&wall.scene), &tools(), &plan);
    let no_way = Warning::NoWay { push: 1, back: false, obstacle: named("wall") };
    assert!(verdict.forbidden.contains(&no_way), "{:?}", verdict.forbidden);
}

#[test]
fn pushes_that_follow_a_lever_up_are_numbered_by_their_step() {
    let task = lever_task();
    let mut step = pushes().remove(0);
    step.push.speed = 5.0;
    let plan = Plan::levering("screwdriver", lever()).then(Plan { steps: vec![Step::Push(step)] });
    let found = rule_violations(&task, &task.scene, &tools(), &plan);
    assert_eq!(found, [Warning::ForbiddenPush { push: 1, fault: PushFault::Speed(5.0) }]);
}

#[test]
fn a_lever_up_that_the_scene_does_not_have_is_refused_as_such() {
    let task = lever_task();
    let scene: &Scene = &task.scene;
    let plan = |lever| Plan::levering("screwdriver", lever);
    let what = |what: &str| {
        let fault = LeverFault::ForbiddenLever { what: what.to_owned() };
        [Warning::CannotLever { step: 0, fault }]
    };
    let found = rule_violations(&task, scene, &tools(), &plan(LeverUp { plate: 9, ..lever() }));
    assert_eq!(found, what("object"));
    let fast = LeverUp { speed: 1.0, ..lever() };
    assert_eq!(rule_violations(&task, scene, &tools(), &plan(fast)), what("speed"));
}
