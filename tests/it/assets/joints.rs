//! Joints in task files: interpretation, round trips, and refusal with advice.

use insta::assert_snapshot;
use pushplan::asset::{PlanFile, TrajectoryFile};
use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::{
    scene::{Joint, JointKind, Part, Span, Tool},
    task::Task,
};

use super::saved::{plan_file, trajectory_file};

/// Four boxes in a row, 1 cm apart, and a wall.
const TASK: &str = "\
scene:
  objects:
    - {name: a, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.5, 0.0]}
    - {name: b, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.5, 0.09]}
    - {name: c, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.5, 0.18]}
    - {name: d, shape: {cuboid: {size: [0.08, 0.08, 0.06]}}, mass: 0.4, friction: 0.4, position: [0.5, 0.27]}
  joints:
    - {between: [a, b], kind: fixed}
    - {between: [b, c], kind: revolute, at: [0.5, 0.135], limits_deg: [-30, 45]}
    - {between: [c, d], kind: prismatic, axis: [3, 4], limits: [-0.05, 0.10]}
  obstacles:
    - {name: wall, size: [0.02, 0.3, 0.1], position: [0.9, 0]}
robot: {reach: {max: 0.9}}
tools: [finger]
goal: {object: a, position: [0.35, 0.1], tolerance: 0.05}
";

fn spoiled(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(TASK.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    })
}

/// Returns the message for the task with these changes.
fn faults(changes: &[(&str, &str)]) -> String {
    Task::parse(&spoiled(changes), "t.yaml").unwrap_err().to_string()
}

fn joints() -> Vec<Joint> {
    let turns = Span::new((-30f64).to_radians(), 45f64.to_radians());
    let at = Vector::new(0.5, 0.135);
    let axis = Vector::new(3.0, 4.0).normalize();
    vec![
        Joint::new([0, 1], JointKind::Fixed),
        Joint::new([1, 2], JointKind::Revolute { at, limits: Some(turns) }),
        Joint::new([2, 3], JointKind::Prismatic { axis, limits: Some(Span::new(-0.05, 0.10)) }),
    ]
}

#[test]
fn joints_are_read_as_they_are_written() {
    let task = Task::parse(TASK, "t.yaml").unwrap();
    assert_eq!(task.scene.joints, joints());
    let free = spoiled(&[(", limits_deg: [-30, 45]", ""), (", limits: [-0.05, 0.10]", "")]);
    let task = Task::parse(&free, "t.yaml").unwrap();
    for joint in &task.scene.joints[1..] {
        match joint.kind {
            JointKind::Revolute { limits, .. } | JointKind::Prismatic { limits, .. } => {
                assert_eq!(limits, None);
            }
            JointKind::Fixed => panic!("{joint:?}"),
        }
    }
    let guessed = spoiled(&[("kind: fixed}", "kind: fixed, guessed: true}")]);
    assert!(Task::parse(&guessed, "t.yaml").unwrap().scene.joints[0].guessed);
}

#[test]
fn joints_and_round_parts_survive_plan_and_trajectory_files() {
    let task = Task::parse(TASK, "t.yaml").unwrap();
    let hand = Part::new("hand", Shape::Cylinder { radius: 0.05, height: 0.1 }, Pose::default());
    let arm = Part::cuboid("arm", [0.1, 0.02, 0.05], Pose::new(0.1, 0.0, 0.1));
    for k in 0..40 {
        let mut file = plan_file("cluster-neighbour.yaml");
        let turn = 0.1 * f64::from(k);
        file.task = task.clone();
        // Axes and angles that did not come from a file.
        file.task.scene.joints[1].guessed = true;
        if let JointKind::Prismatic { axis, .. } = &mut file.task.scene.joints[2].kind {
            *axis = Vector::new(turn.cos(), turn.sin());
        }
        let parts = vec![hand.clone(), arm.clone()];
        file.tools = vec![Tool::new(file.tools[0].name.clone(), parts).unwrap().into()];
        file.predicted = None;
        file.verdict = None;
        let text = serde_json::to_string(&file).unwrap();
        assert_eq!(PlanFile::parse(&text, "p.json").unwrap(), file);

        let mut motion = trajectory_file("cluster-neighbour.yaml");
        motion.task = file.task;
        motion.tools = file.tools;
        motion.trajectory.frames.iter_mut().for_each(|f| f.state = motion.task.scene.start());
        let text = serde_json::to_string(&motion).unwrap();
        assert_eq!(TrajectoryFile::parse(&text, "m.json").unwrap(), motion);
    }
}

#[test]
fn joints_of_what_is_not_there() {
    assert_snapshot!(faults(&[("[a, b]", "[aa, wall]"), ("[b, c]", "[b, b]"), ("[c, d]", "[c]"), ("kind: prismatic", "kind: sliding")]), @r#"
    t.yaml:8:7: error: an object fixed to the world cannot move
      help: make it an obstacle
    t.yaml:8:18: error: no object is called `aa`
      help: did you mean `a`?
    t.yaml:9:17: error: a joint of an object with itself
      help: name two different objects
    t.yaml:10:17: error: expected a list of 2 object names, found a list of 1 item
    t.yaml:10:28: error: expected `fixed`, `revolute` or `prismatic`, found `sliding`
      help: use `fixed`, `revolute` or `prismatic`
    "#);
}

#[test]
fn keys_of_another_kind() {
    assert_snapshot!(faults(&[("kind: fixed", "kind: fixed, at: [0, 0]"), ("at: [0.5, 0.135], limits_deg", "axis: [1, 0], limits"), ("axis: [3, 4], limits:", "at: [0.5, 0.2], limits_deg:")]), @r#"
    t.yaml:8:42: error: a fixed joint has no `at`
      help: remove it; only a revolute joint has this key
    t.yaml:9:7: error: a revolute joint needs `at`
      help: add `at: [x, y]`, the position of the axis
    t.yaml:9:47: error: a revolute joint has no `axis`
      help: remove it; only a prismatic joint has this key
    t.yaml:9:63: error: a revolute joint has no `limits`
      help: limits of rotation are `limits_deg`, in degrees
    t.yaml:9:64: error: expected a limit in metres from -10 to 10, found the number -30
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:9:69: error: expected a limit in metres from -10 to 10, found the number 45
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:10:7: error: a prismatic joint needs `axis`
      help: add `axis: [x, y]`, the direction of displacement
    t.yaml:10:46: error: a prismatic joint has no `at`
      help: remove it; only a revolute joint has this key
    t.yaml:10:70: error: a prismatic joint has no `limits_deg`
      help: limits of displacement are `limits`, in metres
    "#);
}

#[test]
fn missing_and_empty_geometry() {
    assert_snapshot!(faults(&[("at: [0.5, 0.135], ", ""), ("axis: [3, 4]", "axis: [0, 0]")]), @r#"
    t.yaml:9:7: error: a revolute joint needs `at`
      help: add `at: [x, y]`, the position of the axis
    t.yaml:10:48: error: an axis of length zero has no direction
      help: write a direction, such as [1, 0] for +x
    "#);
    assert_snapshot!(faults(&[("at: [0.5", "att: [0.5"), ("axis: [3, 4]", "axis: [1, up]")]), @r#"
    t.yaml:9:41: error: unknown key `att`
      help: did you mean `at`?
    t.yaml:10:52: error: expected a component of a direction from -1000 to 1000, found the text "up"
      help: write the bare number, without a unit; only the direction counts: [1, 0] is +x
    "#);
}

#[test]
fn limits_that_are_violated_or_empty() {
    assert_snapshot!(faults(&[("[-30, 45]", "[10, 45]"), ("[-0.05, 0.10]", "[0.05, -0.05]")]), @r#"
    t.yaml:9:71: error: the start, a turn of 0, violates the limits 10 to 45
      help: limits are relative to the poses at the start: widen them to contain 0, or move the objects
    t.yaml:10:64: error: the lower limit, 0.05, is not below the upper, -0.05
      help: write [low, high]; a joint that cannot move is `kind: fixed`
    "#);
    assert_snapshot!(faults(&[("[-30, 45]", "[-400, 45]"), ("[-0.05, 0.10]", "[-50]")]), @r#"
    t.yaml:9:72: error: expected a limit in degrees from -340 to 340, found the number -400
      help: limits are in degrees from the start; leave them out if the joint rotates freely
    t.yaml:10:64: error: expected a list of 2 numbers, found a list of 1 item
    t.yaml:10:65: error: expected a limit in metres from -10 to 10, found the number -50
      help: lengths are in metres: 50 mm is 0.05
    "#);
}

#[test]
fn two_joints_and_a_loop() {
    assert_snapshot!(faults(&[("  obstacles:", "    - {between: [b, a], kind: fixed}\n    - {between: [a, d], kind: fixed}\n  obstacles:")]), @r#"
    t.yaml:11:7: error: `b` and `a` already have a joint
      help: keep one of the two; two objects can have only one joint
    t.yaml:12:7: error: this joint of `a` and `d` closes a loop, which is not supported
      help: remove one joint of the loop; joined objects must form trees
    "#);
}

#[test]
fn joints_over_the_whole_room() {
    assert_snapshot!(faults(&[("[0.5, 0.0]", "[0.5, -1.0]"), ("at: [0.5, 0.135]", "at: [50, 13.5]"), ("axis: [3, 4]", "axis: [3000, 400]")]), @r#"
    t.yaml:8:17: error: `a` and `b` are 1.01 m apart; a joint spans at most 0.5 m
      help: move them closer together; lengths are in metres
    t.yaml:9:46: error: expected a coordinate in metres from -10 to 10, found the number 50
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:9:50: error: expected a coordinate in metres from -10 to 10, found the number 13.5
      help: lengths are in metres: 50 mm is 0.05
    t.yaml:10:49: error: expected a component of a direction from -1000 to 1000, found the number 3000
      help: only the direction counts: [1, 0] is +x
    "#);
    assert_snapshot!(faults(&[("at: [0.5, 0.135]", "at: [1.5, 0.135]")]), @r#"
    t.yaml:9:45: error: the axis is 0.96 m away from `b` and `c`; the limit is 0.5 m
      help: `at` is in the world frame, in metres
    "#);
}

#[test]
fn masses_too_far_apart_to_be_joined() {
    assert_snapshot!(faults(&[("mass: 0.4", "mass: 5")]), @r#"
    t.yaml:3:68: error: this object has 12.5 times the mass of the lightest object joined to it (0.4 kg); at most 10 times can be simulated
      help: bring the masses of joined objects closer together
    "#);
}

/// Returns a row of `count` cans, each joined to the next.
fn row(count: usize) -> String {
    let mut text = String::from("scene:\n  objects:\n");
    for k in 0..count {
        let y = 0.06 * k as f64;
        text.push_str(&format!(
            "    - {{name: o{k}, shape: {{cylinder: {{radius: 0.025, height: 0.1}}}}, mass: 0.2, friction: 0.4, position: [0.5, {y}]}}\n"
        ));
    }
    text.push_str("  joints:\n");
    for k in 1..count {
        text.push_str(&format!("    - {{between: [o{}, o{k}], kind: fixed}}\n", k - 1));
    }
    text.push_str("robot: {reach: {max: 0.9}}\ntools: all\n");
    text.push_str("goal: {object: o0, position: [0.6, 0], tolerance: 0.05}\n");
    text
}

#[test]
fn more_than_twelve_in_one_piece() {
    assert_eq!(Task::parse(&row(12), "t.yaml").unwrap().scene.joints.len(), 11);
    assert_snapshot!(Task::parse(&row(20), "t.yaml").unwrap_err(), @r#"
    t.yaml:35:7: error: this joint connects 13 objects; at most 12 joined objects can be simulated
      help: remove a joint, or write objects with fixed joints as one cuboid
    "#);
}
