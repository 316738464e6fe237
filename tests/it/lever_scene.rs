//! Levering tasks in scenes with joints, pair frictions, regions, table edges and several goals.

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::outcome::{LeverFault, Warning};
use pushplan::scene::{Engine, Situation};
use pushplan::solve::{PlanStatus, Solution};
use pushplan::task::Task;
use pushplan::verify::rule_violations;
use pushplan_export::mjcf;

use crate::judged::{file, is_reached_in_mujoco, solved};

/// Returns a task with a small plate that one lever-up tips over, extended by objects, scene keys,
/// and task keys with the goals.
fn task(objects: &str, scene: &str, rest: &str) -> Task {
    let pushers = if rest.contains("pushes:") { ", stick, t-head" } else { "" };
    let text = format!(
        "scene:
  objects:
    - {{name: plate, shape: {{cuboid: {{size: [0.12, 0.08, 0.008]}}}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0]}}
{objects}{scene}robot: {{reach: {{min: 0.1, max: 0.9}}}}
tools: [screwdriver{pushers}]
levers: {{pivot: auto}}
{rest}"
    );
    let task = Task::parse(&text, "scene.yaml").unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    let again = task.to_yaml().expect("numbers");
    assert_eq!(Task::parse(&again, "scene.yaml").expect("sound"), task, "{again}");
    task
}

/// Returns the plan of a task that is solved, verified, written and exported.
fn plan(task: &Task) -> (Solution, PlanFile) {
    let solution = solved(task);
    assert_eq!(
        solution.status,
        PlanStatus::Solved,
        "{:?}",
        solution.best().map(|best| &best.verdict)
    );
    let file = file(task, &solution);
    let verdict = file.verdict.as_ref().expect("a verdict");
    let nominal = verdict.nominal(Engine::Spatial).expect("a replay");
    assert!(verdict.passed && nominal.outcome.goals.iter().all(|goal| goal.score <= 1.0));
    let text = serde_json::to_string(&file).expect("numbers");
    let again = PlanFile::parse(&text, "again.json").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((&again.task, &again.plan), (&file.task, &file.plan));
    // MuJoCo shares none of the code for contacts, joints and regions.
    assert_ne!(is_reached_in_mujoco(&file), Some(false), "{text}");
    (solution, file)
}

const FLIPPED: &str = "{object: plate, flipped: true}";

#[test]
fn a_drawer_is_pushed_shut_and_a_plate_turned_over() {
    let drawer = "    - {name: drawer, shape: {cuboid: {size: [0.10, 0.12, 0.06]}}, mass: 0.5, friction: 0.2, \
position: [0.6, 0.3]}\n";
    let joint = "  joints: [{between: [drawer, world], kind: prismatic, axis: [1, 0], limits: [0, 0.10]}]\n";
    let goals = format!(
        "pushes: {{max_count: 2}}
goal:
  - {FLIPPED}
  - {{object: drawer, joint: 0.05, tolerance: 0.012}}\n"
    );
    let (_, file) = plan(&task(drawer, joint, &goals));
    assert!(file.plan.levers() && file.plan.push_steps().count() > 0);
    let xml = mjcf(&file).expect("a scene");
    assert!(xml.contains("type=\"slide\""), "the drawer slides in MuJoCo, too");
    assert!(!xml.contains("plate/drawer/slab-1\" geom2=\"plate/drawer"));
}

#[test]
fn a_hinge_and_a_heading_hold_beside_a_lever_up() {
    let door = "    - {name: door, shape: {cuboid: {size: [0.02, 0.20, 0.10]}}, mass: 0.8, friction: 0.2, \
position: [0.6, -0.35]}\n";
    let joint = "  joints: [{between: [door, world], kind: revolute, at: [0.6, -0.25], limits_deg: [-90, 90]}]\n";
    let goals = "pushes: {max_count: 2}
goal:
  - {object: plate, flipped: true, heading_deg: 180, heading_tolerance_deg: 15}
  - {object: door, joint_deg: 30, heading_tolerance_deg: 8}\n";
    plan(&task(door, joint, goals));
}

#[test]
fn a_can_is_pushed_into_a_region_and_a_plate_turned_over() {
    let can = "    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.3, friction: 0.4, \
position: [0.5, 0.26]}\n";
    let goals = format!(
        "pushes: {{max_count: 2}}
goal:
  - {{object: can, region: {{area: {{rectangle: {{size: [0.10, 0.10]}}}}, position: [0.6, 0.25]}}}}
  - {FLIPPED}\n"
    );
    plan(&task(can, "", &goals));
}

/// The blade slips below a plate with low friction, and holds with a rough blade.
#[test]
fn the_friction_of_a_pair_counts() {
    let friction = |with: &str, coefficient: f64| {
        let pair =
            format!("  frictions: [{{between: [plate, {with}], coefficient: {coefficient}}}]\n");
        task("", &pair, &format!("goal: {FLIPPED}\n"))
    };
    let solution = solved(&friction("table", 0.4));
    let best = solution.best().expect("a plan");
    let end = |task: &Task| {
        let situation = Situation::stated(&task.scene);
        let settings = pushplan::verify::VerifySettings { replays: 0, seed: 0 };
        let verifier = pushplan::verify::Verifier::new(settings);
        let verdict = verifier.verify(task, &situation, &best.tools, &best.plan);
        verdict.evidence[0].outcome.state.space.clone().expect("in space")[0]
    };
    let same = end(&friction("table", 0.4));
    let slippery = end(&friction("tool", 0.02));
    let on_ice = end(&friction("table", 0.05));
    assert!((same.position - slippery.position).norm() > 1e-3, "{same:?} {slippery:?}");
    assert!((same.position - on_ice.position).norm() > 1e-3, "{same:?} {on_ice:?}");
    plan(&friction("tool", 0.6));
}

#[test]
fn nothing_lands_in_a_region_that_is_kept_out_of() {
    // The plate falls to one of its four sides; only one side is free.
    let region = |name: &str, at: [f64; 2], whom: &str| {
        let [x, y] = at;
        format!(
            "  - {{name: {name}, area: {{rectangle: {{size: [0.14, 0.10]}}}}, position: [{x}, {y}], for: [{whom}]}}\n"
        )
    };
    let left = region("left", [0.5, 0.11], "objects");
    let right = region("right", [0.5, -0.11], "objects");
    let task = task("", "", &format!("keep_out:\n{left}{right}goal: {FLIPPED}\n"));
    let (_, found) = plan(&task);
    let rest = &found.verdict.as_ref().expect("a verdict").evidence[0].outcome.state.poses[0];
    assert!(rest.position.y.abs() < 0.05 && (rest.position.x - 0.5).abs() > 0.04, "{rest:?}");
    // A plan that enters a region is detected, and also a blade that passes through a region.
    let mut open = task.clone();
    open.scene.keep_out.clear();
    let lever = found.plan.lever_steps().next().expect("a lever-up").lever;
    let mut closed = open.clone();
    closed.scene.keep_out = task.scene.keep_out[..1].to_vec();
    let wall = &mut closed.scene.keep_out[0];
    (wall.tool, wall.pose) = (true, pushplan::Pose::new(0.5, 0.0, 0.0));
    let broken = rule_violations(&closed, &closed.scene, &found.tools, &found.plan);
    let meets = LeverFault::Meets { body: "left".to_owned() };
    assert_eq!(broken, [Warning::CannotLever { step: 0, fault: meets }], "{lever:?}");
}

#[test]
fn a_plate_must_not_fall_off_the_table_and_a_can_may() {
    let table = |size: f64| format!("  table: {{size: [{size}, 0.6], position: [0.5, 0]}}\n");
    let goal = format!("goal: {FLIPPED}\n");
    let (_, found) = plan(&task("", &table(0.9), &goal));
    // The table ends right beside the plate, where the plate would land.
    let mut narrow = task("", &table(0.9), &goal);
    let rest = found.verdict.as_ref().expect("a verdict").evidence[0].outcome.state.poses[0];
    let top = narrow.scene.table_top.as_mut().expect("it ends");
    let out = rest.position - narrow.scene.objects[0].pose.position;
    top.size = [0.2, 0.16];
    top.middle = narrow.scene.objects[0].pose.position - 0.6 * out;
    let verdict =
        pushplan::verify::Verifier::new(pushplan::verify::VerifySettings { replays: 0, seed: 0 })
            .verify(&narrow, &Situation::stated(&narrow.scene), &found.tools, &found.plan);
    let off = Warning::OffTable { object: "plate".to_owned() };
    assert!(
        !verdict.passed && verdict.evidence[0].warnings.contains(&off),
        "{:?}",
        verdict.evidence[0].warnings
    );
    let can = "    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.08}}, mass: 0.3, friction: 0.4, \
position: [0.5, 0.26]}\n";
    let goals = format!(
        "pushes: {{max_count: 2}}
goal:
  - {FLIPPED}
  - {{object: can, off_table: left}}\n"
    );
    plan(&task(can, &table(0.9), &goals));
}

#[test]
fn two_plates_are_turned_over() {
    let second = "    - {name: tile, shape: {cuboid: {size: [0.10, 0.08, 0.008]}}, mass: 0.09, friction: 0.4, \
clearance: 0.006, position: [0.5, 0.3]}\n";
    let goals = format!(
        "goal:
  - {FLIPPED}
  - {{object: tile, flipped: true}}\n"
    );
    let (_, found) = plan(&task(second, "", &goals));
    assert_eq!(found.plan.lever_steps().count(), 2);
}

#[test]
fn only_an_arm_and_what_has_no_edge_are_refused() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let round = "    - {name: disc, shape: {cylinder: {radius: 0.05, height: 0.01}}, mass: 0.1, friction: 0.4, \
clearance: 0.006, position: [0.5, 0.3]}\n";
    let text = task("", "", &format!("goal: {FLIPPED}\n")).to_yaml().expect("numbers");
    assert!(library.get("screwdriver").is_some() && !text.is_empty());
    let text = format!(
        "scene:
  objects:
{round}robot: {{reach: {{min: 0.1, max: 0.9}}}}
tools: [screwdriver]
goal: {{object: disc, flipped: true}}\n"
    );
    let faults = Task::parse(&text, "scene.yaml").expect_err("no edge").to_string();
    assert!(faults.contains("`cylinder` cannot be combined with lever-ups"), "{faults}");
}

#[test]
fn a_robot_without_a_reach_and_a_plate_off_its_centre_of_mass_are_refused_where_they_stand() {
    let refused = |text: &str| {
        let faults = Task::parse(text, "scene.yaml").expect_err("it cannot be planned");
        assert!(faults.0.iter().all(|fault| fault.place.is_some()), "{faults}");
        faults.to_string()
    };
    let off_centre = "
scene:
  objects:
    - name: board
      shape: {cuboid: {size: [0.002, 0.06, 0.08]}}
      parts: [{shape: {cuboid: {size: [0.02, 0.06, 0.08]}}, position: [0.015, 0]}]
      mass: 0.1
      friction: 0.4
      clearance: 0.006
      position: [0.5, 0]
robot: {reach: {min: 0.1, max: 0.9}}
tools: [screwdriver]
levers: {}
goal: {object: board, flipped: true}
";
    let none = refused(&off_centre.replace("{reach: {min: 0.1, max: 0.9}}", "{}"));
    assert!(none.contains("missing key `reach`"), "{none}");
    let off = refused(off_centre);
    assert!(off.starts_with("scene.yaml:5:14") && off.contains("centre of mass"), "{off}");
}
