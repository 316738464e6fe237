//! Behaviour outside the network's validity range: simulation, warning or refusal.

use std::path::Path;
use std::sync::Arc;

use pushplan::{
    asset::{ToolLibrary, load_task},
    effect::{EffectModel, EffectModels, Fallback, Network, OutOfRange, Prior, Simulated},
    outcome::{Record, Trajectory, Warning},
    scene::{Joint, JointKind, ModelKind, Object, Obstacle, Quantity, Scene},
    sim::Simulator,
    solve::{Effort, Planner, SolveError},
    task::{Job, Push, Task},
};

use super::random_network::{object, stroke, tool};
use crate::ROOT;
use pushplan::geometry::{Pose, Shape};
use pushplan::task::ToolMotion;

fn network() -> Network {
    Network::new(EffectModels::weights().expect("the shipped weights"))
}

fn routed(out_of_range: OutOfRange) -> Fallback {
    Fallback::new(Arc::new(network())).out_of_range(out_of_range)
}

/// Returns a box of this mass in front of the tool.
fn scene(mass: f64) -> Scene {
    let mut body = object(Shape::Cuboid { size: [0.06, 0.06, 0.1] }, 0.06, 0.01, 0.0);
    body.mass = mass;
    Scene::new([body]).on_table(0.4)
}

fn job(scene: &Scene) -> Job {
    let motion = ToolMotion { tool: tool(), lift: 0.002, strokes: vec![stroke()] };
    Job::stated(scene, motion)
}

fn run(out_of_range: OutOfRange, scene: &Scene) -> Trajectory {
    routed(out_of_range).rollout(scene, &[job(scene)], Record::Frames).remove(0)
}

#[test]
fn inside_its_range_the_network_predicts_whatever_is_asked_for() {
    let scene = scene(0.5);
    let plain = network().rollout(&scene, &[job(&scene)], Record::Frames).remove(0);
    assert!(plain.warnings.is_empty(), "{:?}", plain.warnings);
    for out_of_range in [OutOfRange::Simulate, OutOfRange::Warn, OutOfRange::Refuse] {
        assert_eq!(run(out_of_range, &scene), plain, "{out_of_range}");
    }
}

#[test]
fn outside_of_it_simulation_takes_its_place_or_nothing_does() {
    let scene = scene(500.0);
    let motion = job(&scene).motion;
    let planar =
        Simulator::planar().run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);
    assert_eq!(run(OutOfRange::Simulate, &scene).frames, planar.frames);
    let guarded = routed(OutOfRange::Simulate);
    let warnings = guarded.trust(&scene, &job(&scene)).warnings();
    assert!(
        warnings.iter().all(|w| matches!(w, Warning::Simulated { .. })) && !warnings.is_empty()
    );
    assert!(
        warnings[0].to_string().contains("the 2-D simulation was used instead"),
        "{}",
        warnings[0]
    );

    let refused = run(OutOfRange::Refuse, &scene);
    assert_eq!(refused.outcome(), &scene.start());
    assert!(refused.warnings.contains(&Warning::Refused));
    assert!(refused.warnings.iter().any(Warning::forbids_success));

    let plain = network().rollout(&scene, &[job(&scene)], Record::Frames).remove(0);
    assert_eq!(run(OutOfRange::Warn, &scene), plain);
}

#[test]
fn objects_out_of_reach_of_a_motion_raise_no_warning() {
    let mut scene = scene(0.5);
    for k in 0..30 {
        let mut far = object(Shape::Cylinder { radius: 0.4, height: 0.1 }, 3.0, f64::from(k), 0.0);
        far.mass = 500.0;
        scene.objects.push(far);
    }
    assert_eq!(network().trust(&scene, &job(&scene)).warnings(), []);
    // An object joined to the pushed one becomes relevant, and with it only the others near it.
    let kind = JointKind::Fixed;
    scene.joints.push(Joint::new([0, 1], kind));
    let found = network().trust(&scene, &job(&scene)).warnings();
    assert!(found.iter().any(|w| w.to_string().contains("mass")), "{found:?}");
}

#[test]
fn jobs_keep_their_order_when_some_are_simulated() {
    let scene = scene(0.5);
    let fast = |k: usize| if k.is_multiple_of(2) { 1.0 } else { 0.05 };
    let jobs: Vec<Job> = (0..6)
        .map(|k| {
            let mut job = job(&scene);
            job.motion.slide_mut().strokes[0].duration = fast(k);
            job
        })
        .collect();
    let rolled = routed(OutOfRange::Simulate).rollout(&scene, &jobs, Record::Frames);
    for (k, (job, trajectory)) in jobs.iter().zip(&rolled).enumerate() {
        let duration = trajectory.frames[job.motion.slide().strokes[0].frames()].time;
        assert!((duration - fast(k)).abs() < 1e-9, "{k}: {duration}");
        let planar = Simulator::planar().run(&scene, job, Record::Frames);
        assert_eq!(trajectory.frames == planar.frames, k % 2 == 1, "{k}");
    }
}

/// Three boxes of equal width in a row before a wall, exactly behind each other or slightly offset:
/// the corners of a box are nearer to the flanks of the next than to its face.
#[test]
fn boxes_of_one_width_do_not_pass_through_each_other() {
    for aside in [0.0, 8e-4] {
        let cube = |k: usize| {
            let cube = Object::cuboid(format!("cube-{k}"), [0.064, 0.064, 0.05]);
            cube.mass(0.1).friction(0.3).at(0.5 + 0.08 * k as f64, aside * (k % 2) as f64, 0.0)
        };
        let mut scene = Scene::new((0..3).map(cube));
        scene.obstacles.push(Obstacle {
            name: "wall".into(),
            size: [0.08, 0.4, 0.1],
            pose: Pose::new(0.78, 0.0, 0.0),
            z: 0.0,
            friction: 0.5,
        });
        let push = Push { start: [0.4, 0.0].into(), direction: 0.0, length: 0.25, speed: 0.1 };
        let library = ToolLibrary::embedded().expect("the shipped tools");
        let finger = library.get("finger").expect("a finger").clone();
        let motion = ToolMotion::pushes(finger, 0.002, 0.0, &[push], true);
        let trajectory = Prior::default()
            .rollout(&scene, &[Job::stated(&scene, motion)], Record::Frames)
            .remove(0);
        assert!(trajectory.warnings.iter().any(Warning::blocks), "{:?}", trajectory.warnings);
        // Until then they stay behind each other.
        for frame in &trajectory.frames[..trajectory.frames.len() - 1] {
            let x = |k: usize| frame.state.poses[k].position.x;
            assert!(x(1) - x(0) > 0.055 && x(2) - x(1) > 0.055, "{} {} {}", x(0), x(1), x(2));
        }
    }
}

#[test]
fn a_box_crushed_against_a_wall_is_reported_as_jammed_and_simulated_on_request() {
    let mut scene = scene(0.5);
    scene.obstacles.push(Obstacle {
        name: "wall".into(),
        size: [0.1, 0.4, 0.1],
        pose: Pose::new(0.16, 0.0, 0.0),
        z: 0.0,
        friction: 0.4,
    });
    let found = run(OutOfRange::Warn, &scene).warnings;
    let depth = found.iter().find_map(|warning| match warning {
        Warning::Jammed { depth, .. } => Some(*depth),
        _ => None,
    });
    // The tool ends 10 cm further; box and wall leave it 2 cm.
    assert!(depth.is_some_and(|depth| depth > 0.01 && depth < 0.1), "{found:?}");
    let instead = run(OutOfRange::Simulate, &scene);
    assert!(instead.warnings.iter().any(|w| matches!(w, Warning::Simulated { .. })));
    let refused = run(OutOfRange::Refuse, &scene);
    assert!(refused.warnings.contains(&Warning::Refused));
}

#[test]
fn a_tool_set_down_on_an_object_is_reported() {
    let mut scene = scene(0.5);
    scene.objects[0].pose = Pose::new(0.02, 0.0, 0.0);
    let name = scene.objects[0].name.clone();
    let found = run(OutOfRange::Warn, &scene).warnings;
    assert!(found.contains(&Warning::SetDownOn { object: name, stroke: 0 }), "{found:?}");
}

#[test]
fn a_planner_refuses_warns_with_a_number_or_simulates() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let path = Path::new(ROOT).join("tasks/pull-back.yaml");
    let mut task: Task = load_task(&path, &library).expect("a shipped task");
    task.scene.objects[0].mass = 500.0;
    let planner = |out_of_range| {
        let model = EffectModels::build(&ModelKind::NETWORK.into()).expect("the shipped weights");
        Planner::builder(model).effort(Effort::Draft).out_of_range(out_of_range).build()
    };
    match planner(OutOfRange::Refuse).solve(&task, &library) {
        Err(SolveError::Refused { warnings, .. }) => {
            assert_eq!(warnings.len(), 1, "one warning, not one for every tool: {warnings:?}");
        }
        other => panic!("{other:?}"),
    }
    let warned = planner(OutOfRange::Warn).solve(&task, &library).expect("a sound task");
    assert!(warned.warnings.iter().any(|w| matches!(w, Warning::OutsideRange { .. })));
    // If the prediction agrees with the simulation, there is no further warning.
    assert!(!warned.warnings.iter().any(|w| matches!(w, Warning::Differs { .. })));
    let path = Path::new(ROOT).join("tasks/crowd.yaml");
    let mut crowd = load_task(&path, &library).expect("a shipped task");
    crowd.pushes.speed = 0.9;
    let fast = planner(OutOfRange::Warn).solve(&crowd, &library).expect("a sound task");
    assert!(fast.warnings.iter().any(|w| matches!(w, Warning::Differs { .. })), "{fast:?}");
    let simulated = planner(OutOfRange::Simulate).solve(&task, &library).expect("a sound task");
    assert!(simulated.warnings.iter().any(|w| matches!(w, Warning::Simulated { .. })));
    let planar =
        Planner::builder(Simulated::new(Simulator::planar())).effort(Effort::Draft).build();
    let planar = planar.solve(&task, &library).expect("a sound task");
    let ends = [&simulated, &planar].map(|solution| {
        let best = solution.best().expect("a plan");
        (best.plan.clone(), best.outcome.clone())
    });
    assert_eq!(ends[0].0.tool(), ends[1].0.tool());
}

#[test]
fn a_can_of_twenty_kilograms_is_warned_of_whatever_the_effort() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let path = Path::new(ROOT).join("tasks/pull-back.yaml");
    let mut task = load_task(&path, &library).expect("a shipped task");
    let draft = |task: &Task| {
        let planner = Planner::for_effort(Effort::Draft).expect("a sound library").build();
        let solution = planner.solve(task, &library).expect("a sound task");
        let found = solution.warnings.into_iter().filter_map(|warning| match warning {
            Warning::OutsideRange { quantity, value, .. } => Some((quantity, value)),
            _ => None,
        });
        found.collect::<Vec<_>>()
    };
    assert_eq!(draft(&task), []);
    task.scene.objects[0].mass = 20.0;
    assert_eq!(draft(&task), [(Quantity::Mass, 20.0)]);
}
