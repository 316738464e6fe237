//! Joints to the world, and goals that use them.

use std::f64::consts::FRAC_PI_2;

use pushplan::effect::EffectModels;
use pushplan::solve::PlanStatus;
use pushplan::{
    EffectModel, Job, JointKind, Pose, Push, Simulated, Simulator, State, Task, ToolLibrary,
    ToolMotion, Vector,
};
use pushplan::{
    outcome::Record,
    scene::{Engine, ModelKind, Rate, Situation},
};

use crate::judged::{file, solved, works_in_mujoco};

/// Door that is ajar in front of a cabinet, and a drawer beside it.
const FURNITURE: &str = "
scene:
  objects:
    - {name: door, shape: {cuboid: {size: [0.30, 0.02, 0.15]}}, mass: 1.6, friction: 0.3,
       position: [0.6140, 0.0366], yaw_deg: 25}
    - name: drawer
      shape: {cuboid: {size: [0.20, 0.16, 0.10]}}
      parts: [{name: handle, shape: {cuboid: {size: [0.02, 0.10, 0.10]}}, position: [-0.13, 0]}]
      mass: 2
      friction: 0.2
      position: [0.70, -0.30]
  joints:
    - {between: [door, cabinet], kind: revolute, at: [0.75, 0.10], limits_deg: [-25, 80]}
    - {between: [world, drawer], kind: prismatic, axis: [-2, 0], limits: [-0.1, 0.05]}
  obstacles:
    - {name: cabinet, size: [0.34, 0.2, 0.15], position: [0.60, 0.215]}
robot: {reach: {min: 0.3, max: 0.9}}
tools: all
goal: {object: door, joint_deg: 40, heading_tolerance_deg: 5}
";

fn task(text: &str) -> Task {
    Task::parse(text, "furniture.yaml").expect("a task")
}

/// Returns the state after a push with the stick, given the end effector's start position and the
/// length.
fn pushed(task: &Task, model: &dyn EffectModel, [x, y]: [f64; 2], length: f64) -> State {
    let library = ToolLibrary::embedded().expect("tools");
    let stick = library.get("stick").expect("a stick");
    let push = Push { start: Vector::new(x, y), direction: 0.0, length, speed: 0.1 };
    let motion = ToolMotion::pushes(stick.clone(), 0.002, 0.0, &[push], true);
    let job = Job::new(&Situation::stated(&task.scene), motion);
    model.rollout(&task.scene, &[job], Record::Outcome).remove(0).outcome().clone()
}

#[test]
fn joints_to_the_world_are_written_as_they_were_read() {
    let task = task(FURNITURE);
    let scene = &task.scene;
    assert_eq!(scene.mounts.iter().map(|mount| mount.object).collect::<Vec<_>>(), [0, 1]);
    let JointKind::Prismatic { axis, .. } = scene.mounts[1].kind else { panic!("it slides") };
    assert_eq!(axis, Vector::new(-1.0, 0.0));
    let again = Task::parse(&task.to_yaml().expect("YAML"), "furniture.yaml").expect("a task");
    assert_eq!(again.scene, task.scene);
    let (goal, kept) = (task.goals[0].heading().expect("a heading"), again.goals[0].heading());
    assert!((goal.heading - 65f64.to_radians()).abs() < 1e-12 && kept == Some(goal));
}

#[test]
fn doors_turn_about_their_hinges_and_drawers_slide_alike_in_every_model() {
    let task = task(FURNITURE);
    let hinge = |state: &State| state.poses[0].point(Vector::new(0.15, 0.0));
    let start = hinge(&task.scene.start());
    let engine = |engine| Simulated::new(Simulator::new(engine, Rate::DEFAULT));
    let prior = EffectModels::build(&ModelKind::PRIOR.into()).expect("a model");
    let (planar, spatial) = (engine(Engine::Planar), engine(Engine::Spatial));
    let models: [&dyn EffectModel; 3] = [&prior, &planar, &spatial];
    let ends = models.map(|model| pushed(&task, model, [-0.16, -0.02], 0.10));
    for end in &ends {
        assert!((hinge(end) - start).norm() < 1e-4, "the hinge stays: {}", hinge(end));
        let turned = (end.poses[0].heading - 25f64.to_radians()).to_degrees();
        // By geometry alone: the tool's corner at (0.55, -0.06) touches the door's inner face, 1 cm
        // from its middle, and the door then slides slightly further.
        let (x, y) = (0.55 - start.x, -0.06 - start.y);
        let open = (y.atan2(x) + std::f64::consts::PI + (0.01 / x.hypot(y)).asin()).to_degrees();
        assert!((turned + 25.0 - open).abs() < 0.3, "{turned} is not {}", open - 25.0);
        assert!((end.poses[0].heading - ends[1].poses[0].heading).abs() < 2e-3);
        assert_eq!(end.poses[1], task.scene.objects[1].pose, "nothing touches the drawer");
    }
    let ends = models.map(|model| pushed(&task, model, [-0.10, -0.30], 0.12));
    for end in &ends {
        let Pose { position, heading } = end.poses[1];
        assert!((position.y + 0.30).abs() < 1e-4 && heading.abs() < 1e-4, "{position}");
        let slid = position.x - 0.70;
        assert!(slid > 0.04 && slid < 0.1005, "{slid}");
        assert!((position.x - ends[1].poses[1].position.x).abs() < 1e-3);
    }
}

#[test]
fn errors_of_world_joints_are_reported() {
    let faults = |from: &str, to: &str| {
        let text = FURNITURE.replace(from, to);
        Task::parse(&text, "furniture.yaml").expect_err("faults").to_string()
    };
    let text = faults("between: [world, drawer]", "between: [world, door]");
    assert!(text.contains("`door` is joined to the world twice"), "{text}");
    let text = faults("kind: prismatic, axis: [-2, 0], limits: [-0.1, 0.05]", "kind: fixed");
    assert!(text.contains("make it an obstacle"), "{text}");
    let text = faults("joint_deg: 40", "joint: 0.1, tolerance: 0.01");
    assert!(text.contains("the joint of `door` is not prismatic"), "{text}");
    let text = faults(", joint_deg: 40, heading_tolerance_deg: 5", "");
    assert!(text.contains("the goal has no criterion"), "{text}");
    let text = faults("joint_deg: 40", "joint_deg: 85");
    assert!(text.contains("the joint of `door` moves only from -25 to 80"), "{text}");
    let text = faults("joint_deg: 40", "joint_deg: 40, heading_deg: 10");
    assert!(text.contains("`heading_deg` and `joint_deg` constrain the same property"), "{text}");
    let text = faults("joint_deg: 40, heading_tolerance_deg: 5", "position: [0.6, 0]");
    assert!(text.contains("`position` needs a `tolerance`"), "{text}");
}

/// Door without obstacles that opens by up to 225 degrees counter-clockwise.
const WIDE: &str = "
scene:
  objects:
    - {name: door, shape: {cuboid: {size: [0.20, 0.02, 0.15]}}, mass: 0.6, friction: 0.3, position: [0.5, 0.0]}
  joints:
    - {between: [world, door], kind: revolute, at: [0.6, 0.0], limits_deg: [-10, 225]}
robot: {reach: {min: 0.1, max: 0.95}}
tools: [stick, l-hook]
goal: {object: door, joint_deg: 200, heading_tolerance_deg: 10}
";

/// Returns the y, metres, at which a stick from the robot's right meets the door, open by `turn`
/// degrees. Its end covers 8 to 16 cm beyond the hinge along x.
fn face(turn: f64) -> f64 {
    let (sin, cos) = (turn - 180.0).to_radians().sin_cos();
    [0.08, 0.16].map(|x| (x * sin - 0.01) / cos).into_iter().fold(f64::INFINITY, f64::min)
}

/// Returns the angle by which such a stick opens the door by moving to `y`, degrees; the initial
/// angle is `from`.
fn opened(task: &Task, model: &dyn EffectModel, from: f64, y: f64) -> f64 {
    let library = ToolLibrary::embedded().expect("tools");
    let stick = library.get("stick").expect("a stick");
    let mut situation = Situation::stated(&task.scene);
    let closed = task.scene.objects[0].pose;
    situation.start.poses[0] = task.scene.mounts[0].pose(&closed, from.to_radians());
    // The stick reaches 0.61 m beyond the grip, and comes down one centimetre from the door.
    let below = face(from) - 0.01;
    let start = Vector::new(0.72, below - 0.61);
    let push = Push { start, direction: FRAC_PI_2, length: y - below, speed: 0.1 };
    let motion = ToolMotion::pushes(stick.clone(), 0.002, FRAC_PI_2, &[push], true);
    let job = Job::new(&situation, motion);
    let end = model.rollout(&task.scene, &[job], Record::Outcome).remove(0).outcome().clone();
    (end.poses[0].heading - closed.heading).to_degrees()
}

#[test]
fn a_door_turns_on_beyond_half_a_turn_and_stops_at_its_limit_in_every_model() {
    let task = task(WIDE);
    let again = Task::parse(&task.to_yaml().expect("YAML"), "furniture.yaml").expect("a task");
    assert_eq!(again.scene, task.scene);
    let engine = |engine| Simulated::new(Simulator::new(engine, Rate::DEFAULT));
    let prior = EffectModels::build(&ModelKind::PRIOR.into()).expect("a model");
    let (planar, spatial) = (engine(Engine::Planar), engine(Engine::Spatial));
    for model in [&prior as &dyn EffectModel, &planar, &spatial] {
        for (from, to) in [(165.0, 175.0), (165.0, 200.0), (185.0, 220.0)] {
            let open = opened(&task, model, from, face(to));
            assert!((open - to).abs() < 1.5, "{}: {open} of {to}", model.spec());
        }
        let open = opened(&task, model, 200.0, face(225.0) + 0.008);
        assert!((open - 225.0).abs() < 4.0, "{}: {open} at the limit", model.spec());
    }
}

#[test]
fn the_heading_error_of_a_jointed_object_respects_its_limits() {
    let off = |limits: &str, wanted: f64, now: f64, counted: f64| {
        let text = WIDE.replace("[-10, 225]", limits);
        let task = task(&text.replace("joint_deg: 200", &format!("joint_deg: {wanted}")));
        let closed = task.scene.objects[0].pose;
        let mut pose = task.scene.mounts[0].pose(&closed, now.to_radians());
        pose.heading += counted.to_radians();
        let state = State::at_rest(vec![pose]);
        assert_eq!(task.reached(&state), (now - wanted).abs() <= 10.0, "{limits} {wanted} {now}");
        task.goals[0].turned(&state).expect("a heading").to_degrees()
    };
    for (limits, wanted, now) in [
        ("[-10, 225]", 190.0, 0.0),
        ("[-10, 225]", 190.0, 215.0),
        ("[-10, 225]", 190.0, -5.0),
        // Slightly beyond a limit, the position is still distinguished from positions beyond the
        // other limit.
        ("[-10, 225]", 190.0, -14.0),
        ("[-225, 10]", -190.0, 5.0),
        ("[-170, 170]", -150.0, 160.0),
        ("[0, 340]", 335.0, 0.0),
        ("[-20, 150]", 120.0, -10.0),
    ] {
        // Observations do not count full turns.
        for counted in [0.0, 360.0, -360.0] {
            let off = off(limits, wanted, now, counted);
            assert!((off - (now - wanted)).abs() < 1e-9, "{limits} {wanted} {now}: {off}");
        }
    }
}

/// Doors opened by more than half a turn, in the other direction, and in several pushes.
#[test]
fn doors_are_opened_the_way_that_their_limits_leave() {
    let mut pushes = Vec::new();
    for (limits, wanted) in [("[-10, 225]", 190.0), ("[-10, 225]", 120.0), ("[-170, 20]", -150.0)] {
        let text = WIDE
            .replace("[-10, 225]", limits)
            .replace("joint_deg: 200", &format!("joint_deg: {wanted}"));
        let task = task(&text.replace("goal:", "pushes: {directions: 8, max_count: 4}\ngoal:"));
        let solution = solved(&task);
        assert_eq!(solution.status, PlanStatus::Solved, "{wanted}");
        let best = &solution.plans[0];
        pushes.push(best.plan.push_steps().count());
        for engine in Engine::ALL {
            let verdict = best.verdict.as_ref().expect("replayed");
            let end = &verdict.nominal(engine).expect("replayed").outcome.state.poses[0];
            // Headings count full turns.
            assert!((end.heading.to_degrees() - wanted).abs() < 10.0, "{wanted}: {}", end.heading);
        }
        works_in_mujoco(&file(&task, &solution));
    }
    assert!(pushes.iter().any(|count| *count > 1), "{pushes:?}");
}

/// A stronger push would press this door against its limit.
#[test]
fn a_door_is_not_slammed_where_a_lighter_push_does() {
    let text = "
scene:
  objects:
    - {name: door, shape: {cuboid: {size: [0.284, 0.02, 0.15]}}, mass: 2.275, friction: 0.381,
       position: [0.589027, 0.096331], yaw_deg: 130.9}
  joints:
    - {between: [door, world], kind: revolute, at: [0.682, -0.011], limits_deg: [-39.9, 64.1]}
  obstacles: [{name: cabinet, size: [0.2, 0.344, 0.15], position: [0.812, 0.131]}]
robot: {reach: {min: 0.1, max: 0.9}, home: [0.1, 0.0], hand: {radius: 0.05}}
tools: all
pushes: {max_count: 3, grip_yaws_deg: [0, 90, -90]}
goal: {object: door, heading_deg: 195, heading_tolerance_deg: 5}
";
    let task = task(text);
    let solution = solved(&task);
    assert_eq!(solution.status, PlanStatus::Solved);
    let verdict = solution.plans[0].verdict.as_ref().expect("replayed");
    for engine in Engine::ALL {
        let force = verdict.nominal(engine).and_then(|evidence| evidence.force).expect("a force");
        assert!(force.lasting < 150.0, "{engine:?}: {force:?}");
    }
    works_in_mujoco(&file(&task, &solution));
}

#[test]
fn limits_of_turns_leave_something_out() {
    let text = WIDE.replace("[-10, 225]", "[-120, 225]");
    let faults = Task::parse(&text, "furniture.yaml").expect_err("a fault").to_string();
    assert!(faults.contains("the range from -120 to 225 is larger than 340 degrees"), "{faults}");
}
