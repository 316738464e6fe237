//! Pushes below overhanging parts of an object: set-down of the tool, its approach, and plans.
//!
//! Distances are closed forms for an object whose cross-section is a T.

use std::f64::consts::PI;
use std::sync::Arc;

use pushplan::effect::Simulated;
use pushplan::geometry::{Pose, Vector};
use pushplan::plan::{
    Candidate, CandidatePush, Infeasible, Placement, Rollouts, STAND_OFF, Start, Workspace,
    evaluate,
};
use pushplan::sim::Simulator;
use pushplan::solve::{Effort, PlanStatus, Planner};
use pushplan::{
    asset::ToolLibrary,
    scene::{Object, Part, Robot, Scene, Situation, Tool},
    task::{Goal, Push, Task},
};

/// Half widths of stem and cap, and height of the cap's underside, metres.
const STEM: f64 = 0.02;
const CAP: f64 = 0.08;
const UNDER: f64 = 0.06;

const AT: Vector = Vector::new(0.6, 0.12);

fn tool(name: &str, parts: Vec<Part>) -> Arc<Tool> {
    Arc::new(Tool::new(name, parts).unwrap())
}

/// Returns a rod of this height whose tip is 0.45 m from the grip.
fn stick(height: f64) -> Arc<Tool> {
    tool("stick", vec![Part::cuboid("rod", [0.4, 0.04, height], Pose::new(0.25, 0.0, 0.0))])
}

/// Returns a handle along +x with a bar to the left at its end, 0.42 m from the grip.
fn hook() -> Arc<Tool> {
    let part = |name: &str, size, x, y| Part::cuboid(name, size, Pose::new(x, y, 0.0));
    let handle = part("handle", [0.44, 0.04, 0.05], 0.22, 0.0);
    tool("hook", vec![handle, part("bar", [0.04, 0.16, 0.05], 0.42, 0.10)])
}

/// Returns a task with a stem (index 0) that carries a cap (index 1).
fn mushroom(goal: [f64; 2]) -> Task {
    let stem = Object::cuboid("mushroom", [2.0 * STEM, 2.0 * STEM, UNDER]).mass(0.3);
    let cap = Object::cuboid("mushroom/cap", [2.0 * CAP, 2.0 * CAP, 0.02]).mass(0.1);
    let scene = Scene::new([stem.at(AT.x, AT.y, 0.0)]);
    let scene = scene.with_part(0, cap.raised(UNDER), Pose::default());
    let robot = Robot { home: Vector::zeros(), ..Robot::reaching(0.05, 0.9).without_body() };
    Task::new("mushroom", scene, robot, Goal::new(0, goal, 0.02))
}

fn push(object: usize, part: usize, offset: f64, direction: f64) -> CandidatePush {
    let start = Start::Placed { part, offset };
    let (tool, grip_yaw, length, room) = (0, 0.0, 0.15, 0.0);
    CandidatePush { tool, grip_yaw, object, start, direction, length, room }
}

fn place(task: &Task, tool: Arc<Tool>, push: &CandidatePush) -> Result<Placement, Infeasible> {
    Workspace { task, tools: &[tool] }.place(&task.scene.start(), push, None)
}

#[test]
fn a_tool_is_set_down_beside_the_cap_and_meets_the_stem() {
    let task = mushroom([0.7, 0.12]);
    let forwards = push(0, 0, 0.0, 0.0);
    for room in [0.0, 0.004] {
        let push = CandidatePush { room, ..forwards };
        let placement = place(&task, stick(0.05), &push).unwrap();
        let tip = placement.start.x + 0.45;
        assert!((tip - (AT.x - CAP - STAND_OFF - room)).abs() < 1e-9, "{placement:?}");
        assert!((tip + placement.approach() - (AT.x - STEM)).abs() < 1e-9, "{placement:?}");
    }
    // The bar of a hook stands behind the cap and is pulled to the stem.
    let placement = place(&task, hook(), &push(0, 1, 0.0, PI)).unwrap();
    let face = placement.start.x + 0.40;
    assert!((face - (AT.x + CAP + STAND_OFF)).abs() < 1e-9, "{placement:?}");
    assert!((placement.back - (CAP - STEM)).abs() < 1e-9, "{placement:?}");
    // A low tool does not reach the cap, and a tall one meets it first.
    assert_eq!(place(&task, stick(0.05), &push(1, 0, 0.0, 0.0)), Err(Infeasible::NoContact));
    let placement = place(&task, stick(0.07), &push(1, 0, 0.0, 0.0)).unwrap();
    assert!((placement.start.x + 0.45 - (AT.x - CAP - STAND_OFF)).abs() < 1e-9);
    assert_eq!(placement.back, 0.0);
}

#[test]
fn a_cap_as_narrow_as_its_stem_changes_no_placement() {
    let with = mushroom([0.7, 0.12]);
    let mut without = with.clone();
    without.scene = Scene::new([with.scene.objects[0].clone()]);
    let mut narrow = with.clone();
    narrow.scene = without.scene.clone().with_part(
        0,
        Object::cuboid("cap", [2.0 * STEM, 2.0 * STEM, 0.02]).raised(UNDER),
        Pose::default(),
    );
    for direction in [0.0, 0.4, PI] {
        let push = push(0, 0, 0.01, direction);
        let [one, two] = [&without, &narrow].map(|task| place(task, stick(0.05), &push));
        assert_eq!(one, two);
    }
}

#[test]
fn a_push_below_a_cap_keeps_all_rules_and_moves_the_object_after_the_approach() {
    let task = mushroom([0.7, 0.12]);
    let tools = [stick(0.05)];
    let space = Workspace { task: &task, tools: &tools };
    let model = Simulated::new(Simulator::planar());
    let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
    let one = Candidate { pushes: vec![push(0, 0, 0.0, 0.0)] };
    let found = evaluate(&space, &mut rollouts, &[one]).remove(0).unwrap();
    assert!(found.is_feasible(), "{:?}", found.margins);
    let moved = found.outcome.poses[0].position.x - AT.x;
    let travel = 0.15 - STAND_OFF - (CAP - STEM);
    // At 0.1 m/s, it then slides on by about a millimetre.
    assert!((0.0..2e-3).contains(&(moved - travel)), "{moved} {travel}");
    // At the stand-off from the stem, the tool would come down on the cap.
    let below = Vector::new(AT.x - STEM - STAND_OFF - 0.45, AT.y);
    let push = Push { start: below, direction: 0.0, length: 0.15, speed: 0.1 };
    let pushed = (&task.scene.start(), 0);
    let margins = space.margins((0, 0.0), pushed, &push, Some(Placement::at(below)));
    assert_eq!(margins.violation(), Some(Infeasible::OnObject));
}

#[test]
fn objects_with_an_overhang_are_pushed_and_pulled_to_their_goals() {
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    for goal in [[0.7, 0.15], [0.48, 0.10]] {
        let mut task = mushroom(goal);
        task.robot = Robot::reaching(0.1, 0.9);
        let solution = planner.solve(&task, &ToolLibrary::embedded().unwrap()).unwrap();
        assert_eq!(solution.status, PlanStatus::Solved, "{goal:?}");
    }
}
