//! Verdicts on hand-made plans.

use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::geometry::{Pose, Vector};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{
    outcome::{Evidence, Perturbation, Reason, Verdict, Warning},
    scene::{Engine, Obstacle, Part, Physics, Situation, Support, TableTop, Tool},
    task::{Plan, Push, PushForm, Task, ToolChoice},
};

const TASK: &str = "
description: Push a can ahead.
scene:
  table: {friction: 0.5}
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.4, friction: 0.4, position: [0.5, 0.0]}
robot: {home: [0.3, 0.0], reach: {max: 0.9}}
tools: all
pushes: {max_count: 2}
goal: {object: can, position: [0.65, 0.0], tolerance: 0.02}
";

fn paddle() -> Arc<Tool> {
    let text = "name: paddle
description: A handle with a wide face.
friction: 0.4
parts:
  - {name: handle, size: [0.20, 0.04, 0.06], position: [0.10, 0, 0]}
  - {name: face, size: [0.02, 0.16, 0.06], position: [0.21, 0, 0]}
";
    Arc::new(Tool::parse(text, "paddle.yaml").unwrap())
}

fn push(start: [f64; 2], direction: f64, length: f64) -> Push {
    Push { start: Vector::new(start[0], start[1]), direction, length, speed: 0.1 }
}

fn plan(pushes: Vec<Push>) -> Plan {
    let form = PushForm::Placed;
    Plan::pushing("paddle", 0.0, form, 0.002, pushes)
}

fn task() -> Task {
    Task::parse(TASK, "ahead.yaml").unwrap()
}

#[test]
fn a_plan_that_works_passes_with_evidence_from_both_engines() {
    let verifier = Verifier::new(VerifySettings { replays: 3, seed: 1 });
    // The face's front is 0.22 ahead of the grip: from 0.235 it travels 5 mm to the can.
    let good = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let verdict = verifier.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &good);
    assert!(verdict.passed);
    assert_eq!(verdict.evidence.len(), 2 + 2 * 3);
    assert_eq!(verdict.evidence[0].engine, Engine::Planar);
    assert_eq!(verdict.evidence[1].engine, Engine::Spatial);
    assert!(verdict.evidence[..2].iter().all(|e| e.perturbation == Perturbation::Nominal));
    assert!(verdict.evidence[..2].iter().all(|e| e.outcome.error() < 5e-3));
    assert_eq!(verdict.robustness, Some(1.0));
    // Draws differ, and equal seeds give equal draws.
    let outcome = |k: usize| &verdict.evidence[k].outcome;
    assert!(outcome(2).error() != outcome(3).error());
    assert_eq!(
        verdict,
        verifier.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &good)
    );
    let other = Verifier::new(VerifySettings { replays: 3, seed: 2 });
    assert_ne!(
        verdict,
        other.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &good)
    );
}

#[test]
fn a_plan_that_stops_short_fails() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let short = plan(vec![push([0.235, 0.0], 0.0, 0.05)]);
    let verdict = verifier.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &short);
    assert!(!verdict.passed && verdict.robustness.is_none());
    assert!((verdict.evidence[1].outcome.error() - 0.105).abs() < 5e-3);
}

#[test]
fn a_tool_set_down_on_an_object_is_no_pass() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    // The second push ignores that the first has moved the can to 0.65.
    let blind = plan(vec![push([0.235, 0.0], 0.0, 0.155), push([0.42, 0.0], 0.0, 0.01)]);
    let verdict = verifier.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &blind);
    assert!(!verdict.passed);
    for evidence in &verdict.evidence {
        let landed = Warning::SetDownOn { object: "can".into(), stroke: 1 };
        assert_eq!(evidence.warnings, [landed], "one warning");
    }
}

#[test]
fn a_toppled_object_is_no_pass() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let mut task = task();
    // A tall thin bottle, pushed fast and at a large height.
    let text = TASK.replace("radius: 0.04, height: 0.10", "radius: 0.015, height: 0.30");
    task.scene = Task::parse(&text, "bottle.yaml").unwrap().scene;
    let high = [push([0.26, 0.0], 0.0, 0.155)];
    let high = Plan::pushing("paddle", 0.0, PushForm::Placed, 0.2, high);
    let verdict = verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &high);
    assert!(!verdict.passed);
    let spatial = &verdict.evidence[1];
    assert!(spatial.warnings.iter().any(|w| matches!(w, Warning::Toppled { .. })));
}

#[test]
fn a_can_does_not_pass_through_a_gap_narrower_than_itself() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let mut task = task();
    // The can is 8 cm wide, the gap before its goal 7.5 cm.
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let wall = Obstacle::cuboid(name, [0.05, 0.3, 0.1]);
        task.scene.obstacles.push(wall.at(0.575, side * (0.0375 + 0.15), 0.0));
    }
    // The pushing finger itself fits through the gap.
    let finger = Part::cuboid("finger", [0.02, 0.02, 0.05], Pose::new(0.22, 0.0, 0.0));
    let tool = Arc::new(Tool::new("finger", [finger]).expect("one part"));
    let through = push([0.225, 0.0], 0.0, 0.155);
    let through = Plan::pushing("finger", 0.0, PushForm::Placed, 0.002, [through]);
    let verdict = verifier.verify(
        &task,
        &Situation::stated(&task.scene),
        std::slice::from_ref(&tool),
        &through,
    );
    assert!(!verdict.passed);
    for evidence in &verdict.evidence {
        let fault = evidence.fault().expect("a fault");
        let Warning::Jammed { object, depth, .. } = fault else { panic!("{fault}") };
        // The replay ends at the jam, not at the planned end of the tool.
        assert!(object == "can" && *depth < 4e-3, "{depth}");
    }
}

#[test]
fn violations_of_the_task_are_reported_for_any_plan() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let mut task = task();
    task.tools = ToolChoice::Named(vec!["stick".into()]);
    task.robot.reach_max = 0.3;
    task.scene.obstacles.push(Obstacle::cuboid("post", [0.02, 0.02, 0.1]).at(0.3, 0.0, 0.0));
    let askew = [push([0.235, 0.0], 0.0, 0.155)];
    let askew = Plan::pushing("paddle", 0.3, PushForm::Placed, 0.002, askew);
    let verdict = verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &askew);
    let forbids = |wanted: fn(&Warning) -> bool| verdict.forbidden.iter().any(wanted);
    assert!(forbids(|w| matches!(w, Warning::ForbiddenTool { .. })));
    assert!(forbids(|w| matches!(w, Warning::ForbiddenYaw { .. })));
    assert!(forbids(|w| matches!(w, Warning::OutOfReach { push: 0 })));
    assert!(forbids(|w| matches!(w, Warning::ThroughObstacle { push: 0, .. })));
    assert!(matches!(verdict.reason, Some(Reason::Forbidden(_))) && !verdict.passed);
}

#[test]
fn a_safe_is_not_moved_by_an_arm_that_has_a_limit() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let text = TASK.replace("mass: 0.4", "mass: 200");
    let mut task = Task::parse(&text, "safe.yaml").unwrap();
    assert_eq!(task.scene.objects[0].mass, 200.0);
    task.robot.max_force = Some(100.0);
    let moved = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let verdict = verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &moved);
    assert!(!verdict.passed);
    for evidence in &verdict.evidence {
        assert!(evidence.warnings.iter().any(|w| matches!(w, Warning::TooMuchForce { .. })));
    }
}

/// The sustained force is friction, coefficient times weight, for every solid of the can; forces of
/// other objects on it do not count as the tool's.
#[test]
fn fragile_objects_are_pressed_within_their_limit() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let handle = "parts: [{name: handle, shape: {cuboid: {size: [0.02, 0.01, 0.1]}}, position: [-0.045, 0]}], mass";
    let weight = 0.45 * 0.4 * 9.81;
    let moved = plan(vec![push([0.21, 0.0], 0.0, 0.155)]);
    let verdict = |text: &str, limit: f64| {
        let text = text.replace("mass: 0.4", &format!("max_force: {limit}, mass: 0.4"));
        let task = Task::parse(&text, "fragile.yaml").unwrap();
        assert_eq!(Task::parse(&task.to_yaml().unwrap(), "fragile.yaml").unwrap(), task);
        verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &moved)
    };
    for text in [TASK.to_owned(), TASK.replace("mass", handle)] {
        let text = text.replace("tolerance: 0.02", "tolerance: 0.05");
        assert!(verdict(&text, 3.0 * weight).passed);
        let harmed = verdict(&text, 0.5 * weight);
        assert!(!harmed.passed);
        for evidence in &harmed.evidence {
            let [Warning::TooMuchForce { object, needed, limit }] = &evidence.warnings[..] else {
                panic!("{:?}", evidence.warnings)
            };
            assert_eq!((object.as_deref(), *limit), (Some("can"), 0.5 * weight));
            assert!((0.5..2.0).contains(&(needed / weight)), "{needed} N of {weight} N");
        }
        let reason = harmed.reason.map(|reason| format!("{reason:?}")).unwrap_or_default();
        assert!(reason.contains("TooMuchForce") && reason.contains("can"), "{reason}");
    }
    let ahead = "{name: box, shape: {cuboid: {size: [0.04, 0.08, 0.08]}}, mass: 0.3, friction: 0.4, position: [0.42, 0]}";
    let behind = TASK
        .replace("objects:\n", &format!("objects:\n    - {ahead}\n"))
        .replace("[0.65, 0.0]", "[0.6, 0.0]")
        .replace("tolerance: 0.02", "tolerance: 0.1");
    let pushed = verdict(&behind, 0.5 * weight);
    assert!(pushed.evidence.iter().all(|evidence| {
        let moved = evidence.outcome.state.poses[1].position.x > 0.51;
        moved && !evidence.warnings.iter().any(|w| matches!(w, Warning::TooMuchForce { .. }))
    }));
}

#[test]
fn an_object_pushed_beyond_the_table_falls() {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    let mut task = task();
    task.scene.table_top = Some(TableTop { size: [1.2, 1.0], middle: Vector::zeros() });
    let off = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let verdict = verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &off);
    let fell = Warning::OffTable { object: "can".into() };
    assert!(!verdict.passed && verdict.evidence.iter().all(|e| e.warnings.contains(&fell)));
}

#[test]
fn replays_go_on_until_the_answer_is_clear_and_no_longer() {
    let counted = |aside: f64, most: usize| {
        let text = TASK.replace("[0.65, 0.0]", &format!("[0.65, {aside}]"));
        let task = Task::parse(&text, "ahead.yaml").unwrap();
        let verifier = Verifier::new(VerifySettings { replays: 4, seed: 1 }).until_clear();
        let plan = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
        let verdict = verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &plan);
        let draws = |engine| {
            let perturbed = verdict.perturbed(engine).map(|one| one.perturbation);
            perturbed.collect::<Vec<_>>()
        };
        let [planar, spatial] = [Engine::Planar, Engine::Spatial].map(draws);
        // Both engines use the same draws, up to the smaller number.
        let shared = planar.len().min(spatial.len());
        assert_eq!(planar[..shared], spatial[..shared]);
        let replays = planar.len().max(spatial.len());
        assert!(replays <= most, "{replays}");
        (verdict.passed, replays)
    };
    // In the middle of the goal; then at the edge of the tolerance, with perturbed starts.
    assert_eq!(counted(0.0, 8), (true, 8));
    let edge = (0..6).map(|k| counted(0.0185 + 2.5e-4 * f64::from(k), 64));
    let most = edge.map(|(_, replays)| replays).max();
    assert!(most.is_some_and(|most| most > 12), "{most:?}");
}

#[test]
fn plans_that_fail_in_2d_are_not_replayed_in_3d() {
    let good = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let verify = |task: &Task| {
        let verifier = Verifier::new(VerifySettings { replays: 8, seed: 1 }).until_clear();
        verifier.verify(task, &Situation::stated(&task.scene), &[paddle()], &good)
    };
    // The tolerance is the smallest that both engines reach unperturbed, and few perturbed replays
    // reach.
    let ends = Engine::ALL.map(|engine| {
        let verdict = verify(&task());
        verdict.nominal(engine).unwrap().outcome.state.poses[0].position
    });
    let (middle, apart) = ((ends[0] + ends[1]) / 2.0, (ends[0] - ends[1]).norm());
    let mut narrow = task();
    narrow.goals[0].set_position(middle);
    narrow.goals[0].set_tolerance(apart / 2.0 + 2e-5);
    let verdict = verify(&narrow);
    let planar = matches!(verdict.reason, Some(Reason::Fragile { engine: Engine::Planar, .. }));
    assert!(planar, "{:?}", verdict.reason);
    assert_eq!(verdict.perturbed(Engine::Spatial).count(), 0);
}

#[test]
fn a_support_on_which_a_plan_never_works_makes_it_fragile_by_name() {
    let verifier = Verifier::new(VerifySettings { replays: 16, seed: 1 });
    let good = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let verdict = verifier.verify(&task(), &Situation::stated(&task().scene), &[paddle()], &good);
    let fails = |replays: usize| {
        let mut left = replays;
        let failing = |mut evidence: Evidence| {
            if let Perturbation::Perturbed { draw } = evidence.perturbation
                && Physics::doubted(draw - 1) == Some(&Support::Corners)
                && evidence.engine == Engine::Spatial
                && left > 0
            {
                left -= 1;
                evidence.outcome.reached = false;
            }
            evidence
        };
        let evidence = verdict.evidence.iter().cloned().map(failing).collect();
        Verdict::judge(Vec::new(), evidence, 0.75)
    };
    // A quarter of all replays fails, so the requested share is met.
    let never = fails(4);
    assert_eq!(never.robustness, Some(0.75));
    let (engine, support) = (Engine::Spatial, Support::Corners);
    assert_eq!(never.reason, Some(Reason::NeverOn { engine, support, replays: 4 }));
    assert!(never.nominal_ok() && !never.passed);
    assert!(fails(3).passed);
    // The file keeps the reason.
    let file = PlanFile {
        verdict: Some(never.clone()),
        ..PlanFile::new(task(), vec![paddle()], good.clone())
    };
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("ahead.plan.json");
    file.write(&path).unwrap();
    assert_eq!(PlanFile::load(&path).unwrap().verdict.unwrap().reason, never.reason);
}

#[test]
fn a_hand_that_passes_through_a_tall_object_is_rejected() {
    // The grip travels from 0.235 to 0.39; the hand has a radius of 5 cm.
    let good = plan(vec![push([0.235, 0.0], 0.0, 0.155)]);
    let beside = |height: f64, y: f64| {
        let can = "    - {name: can,";
        let bottle = format!(
            "    - {{name: bottle, shape: {{cylinder: {{radius: 0.02, height: {height}}}}}, mass: 0.5, \
             friction: 0.4, position: [0.36, {y}]}}\n{can}"
        );
        let text =
            TASK.replace(can, &bottle).replace("max: 0.9}", "max: 0.9}, hand: {radius: 0.05}");
        let task = Task::parse(&text, "bottle.yaml").unwrap_or_else(|faults| panic!("{faults}"));
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 1 });
        verifier.verify(&task, &Situation::stated(&task.scene), &[paddle()], &good)
    };
    let met = beside(0.30, 0.06);
    let hand = Warning::HandThrough { push: 0, obstacle: "bottle".into() };
    assert_eq!(met.reason, Some(Reason::Forbidden(hand)));
    assert!(beside(0.10, 0.06).passed, "the hand passes above it");
    assert!(beside(0.30, 0.09).passed, "the hand passes beside it");
}

#[test]
fn a_kept_object_is_not_pushed_away_and_back() {
    let vase = "    - {name: vase, shape: {cuboid: {size: [0.06, 0.06, 0.08]}}, mass: 0.3, \
                friction: 0.4, position: [0.5, 0.3]}\nrobot:";
    let text = TASK.replace("robot:", vase);
    let stated = |keep: &str| {
        let text = format!("{}{keep}", text.replace("max_count: 2", "max_count: 3"));
        Task::parse(&text, "vase.yaml").unwrap_or_else(|faults| panic!("{faults}"))
    };
    let verdict = |task: &Task| {
        // The vase goes 5 cm ahead and comes back, pushed from either side; then the can is pushed.
        let away = push([0.245, 0.3], 0.0, 0.055);
        let back = push([0.82, 0.3], std::f64::consts::PI, 0.82 - 0.53 - 0.22);
        let mut made = plan(vec![away, back, push([0.235, 0.0], 0.0, 0.155)]);
        if let pushplan::task::Step::Push(step) = &mut made.steps[1] {
            step.grip_yaw = std::f64::consts::PI;
        }
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 1 });
        verifier.verify(task, &Situation::stated(&task.scene), &[paddle()], &made)
    };
    let free = verdict(&stated(""));
    let nominal = free.nominal(Engine::Planar).expect("a replay");
    let vase = nominal.outcome.state.poses[1].position;
    assert!(nominal.outcome.reached && (vase.x - 0.5).abs() < 4e-3, "it is back: {vase}");
    let kept = verdict(&stated("keep: {objects: [vase]}\n"));
    let nominal = kept.nominal(Engine::Planar).expect("a replay");
    let fault = nominal.fault().expect("a broken rule");
    assert!(matches!(fault, Warning::NotKept { object, .. } if object == "vase"), "{fault}");
    assert!(!kept.passed);
}
