//! Joints are inferred from the motion of objects in simulated pushes with known ground truth.

use std::sync::Arc;

use pushplan::effect::Prior;
use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Engine, Joint, JointKind, Object, Part, Rate, Scene, Span, Tool},
    task::{Job, Noise, Push, ToolMotion},
};
use pushplan_act::belief::{Belief, BeliefSettings, JointType};

use crate::believing::{EXACT, believed};
use crate::program::{run, stderr};

/// Returns two boxes side by side, 4 mm apart, that a finger pushes off-centre.
pub fn pair(joint: Option<JointKind>) -> (Scene, ToolMotion) {
    let cuboid = |name: &str, y| Object::cuboid(name, [0.08, 0.06, 0.05]).at(0.5, y, 0.0);
    let mut scene = Scene::new([cuboid("first", 0.0), cuboid("second", 0.064)]);
    scene.joints.extend(joint.map(|kind| Joint::new([0, 1], kind)));
    let finger =
        Part::new("finger", Shape::Cylinder { radius: 0.01, height: 0.05 }, Pose::default());
    let tool = Tool::new("finger", [finger]).expect("one piece");
    let push = Push { start: Vector::new(0.44, -0.015), direction: 0.1, length: 0.25, speed: 0.1 };
    (scene, ToolMotion::pushes(Arc::new(tool), 0.0, 0.0, &[push], false))
}

/// Returns two cylinders side by side, 4 mm apart, pushed in the same way.
pub fn cylinders(joint: Option<JointKind>) -> (Scene, ToolMotion) {
    let cylinder = |name: &str, y| Object::cylinder(name, 0.035, 0.05).at(0.5, y, 0.0);
    let mut scene = Scene::new([cylinder("first", 0.0), cylinder("second", 0.074)]);
    scene.joints.extend(joint.map(|kind| Joint::new([0, 1], kind)));
    let (_, motion) = pair(None);
    let push = Push { start: Vector::new(0.44, -0.01), direction: 0.3, length: 0.25, speed: 0.1 };
    (scene, ToolMotion::pushes(motion.tool, 0.0, 0.0, &[push], false))
}

pub fn recorded(scene: &Scene, motion: &ToolMotion, engine: Engine) -> Recording {
    let simulator = Simulator::new(engine, Rate::DEFAULT);
    let job = Job::stated(scene, motion.clone());
    let frames = simulator.run(scene, &job, Record::Frames).frames;
    Recording::of_frames("pushed", scene, motion, &frames)
}

fn hinge() -> JointKind {
    JointKind::Revolute { at: Vector::new(0.5, 0.032), limits: None }
}

fn slide() -> JointKind {
    // An axis along the push would let one of the two move alone, as if they were free.
    JointKind::Prismatic { axis: Vector::new(0.6, 0.8), limits: None }
}

#[test]
fn every_type_of_joint_is_found_in_both_engines_with_and_without_noise() {
    let slight = Noise { position: 1e-3, heading: 0.5f64.to_radians() };
    for engine in Engine::ALL {
        for joint in [None, Some(JointKind::Fixed), Some(hinge()), Some(slide())] {
            let (scene, motion) = pair(joint);
            let recording = recorded(&scene, &motion, engine);
            for noise in [EXACT, slight] {
                let belief = believed(&recording, noise, 3);
                let truth = JointType::of(scene.joints.first());
                let shares = belief.probabilities()[0];
                assert!(shares[truth as usize] > 0.5, "{engine:?} {truth:?} {noise:?}: {shares:?}");
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
                let map = belief.map();
                assert_eq!(JointType::of(map.joints.first()), truth);
            }
        }
    }
}

/// The inferred anchor and axis match the positions to which the two objects have moved them.
#[test]
fn anchors_and_axes_are_found() {
    for joint in [hinge(), slide()] {
        let (scene, motion) = pair(Some(joint));
        let recording = recorded(&scene, &motion, Engine::Planar);
        let belief = believed(&recording, EXACT, 0);
        let first = recording.frames.last().expect("frames").poses[0];
        let carried = |v: Vector| first.point(scene.objects[0].pose.local_point(v));
        match belief.map().joints[0].kind {
            JointKind::Revolute { at, .. } => {
                let off = (at - carried(Vector::new(0.5, 0.032))).norm();
                assert!(off < 1e-3, "{off}");
            }
            JointKind::Prismatic { axis, .. } => {
                let off = axis.perp(&first.vector(Vector::new(0.6, 0.8))).abs();
                assert!(off < 0.035, "{off}: two degrees");
            }
            JointKind::Fixed => panic!("fixed"),
        }
    }
}

#[test]
fn nothing_is_learnt_where_nothing_moves_and_what_is_not_seen_is_no_error() {
    let (scene, motion) = pair(Some(JointKind::Fixed));
    let mut recording = recorded(&scene, &motion, Engine::Planar);
    let before = Belief::new(&scene, motion.tool.clone(), 0.0, BeliefSettings::new(EXACT));
    let start = recording.scene.start().poses;
    recording.frames.iter_mut().for_each(|frame| {
        frame.poses.clone_from(&start);
        frame.tool.position.x -= 0.5;
    });
    assert_eq!(believed(&recording, EXACT, 0).probabilities(), before.probabilities());

    let model = Prior::default();
    let mut belief = before.clone();
    for mut observation in recorded(&scene, &motion, Engine::Planar).observations() {
        observation.seen.fill(None);
        belief.update(&model, observation);
    }
    belief.settle(&model);
    assert!(belief.probabilities()[0].iter().all(|share| share.is_finite()));
    assert!(belief.situation().start.is_finite());
}

#[test]
fn every_type_of_joint_of_cylinders_is_found_without_their_headings() {
    let slight = Noise { position: 1e-3, heading: 0.0 };
    let hinge = JointKind::Revolute { at: Vector::new(0.5, 0.037), limits: None };
    for engine in Engine::ALL {
        for joint in [None, Some(JointKind::Fixed), Some(hinge), Some(slide())] {
            let (scene, motion) = cylinders(joint);
            let mut recording = recorded(&scene, &motion, engine);
            recording.headings.fill(false);
            for noise in [EXACT, slight] {
                let belief = believed(&recording, noise, 3);
                let truth = JointType::of(scene.joints.first());
                let shares = belief.probabilities()[0];
                assert!(shares[truth as usize] > 0.5, "{engine:?} {truth:?} {noise:?}: {shares:?}");
            }
        }
    }
}

#[test]
fn beliefs_are_the_same_bits_for_any_number_of_threads() {
    for headings in [true, false] {
        let (scene, motion) = group(1.0);
        let mut recording = recorded(&scene, &motion, Engine::Planar);
        recording.headings.fill(headings);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.expect("a pool");
            pool.install(|| believed(&recording, EXACT, 0).history().to_vec())
        };
        assert_eq!(with(1), with(3));
    }
}

/// Returns three cylinders around each other, two of them joined, that a finger pushes off-centre;
/// `side` is -1 for the mirror image.
fn group(side: f64) -> (Scene, ToolMotion) {
    let can = |name: &str, x, y| Object::cylinder(name, 0.035, 0.05).at(x, side * y, 0.0);
    let mut scene = Scene::new([
        can("first", 0.5, 0.0),
        can("second", 0.503, 0.075),
        can("third", 0.567, 0.04),
    ]);
    let at = Vector::new(0.5015, side * 0.0375);
    scene.joints.push(Joint::new([0, 1], JointKind::Revolute { at, limits: None }));
    let (_, motion) = pair(None);
    let start = Vector::new(0.44, -0.01 * side);
    let push = Push { start, direction: 0.3 * side, length: 0.25, speed: 0.1 };
    (scene, ToolMotion::pushes(motion.tool, 0.0, 0.0, &[push], false))
}

#[test]
fn a_mirrored_group_without_headings_is_believed_the_same_of() {
    let [one, other] = [1.0, -1.0].map(|side| {
        let (scene, motion) = group(side);
        let mut recording = recorded(&scene, &motion, Engine::Planar);
        recording.headings.fill(false);
        believed(&recording, EXACT, 0)
    });
    assert_eq!(one.pairs().len(), 3);
    for (one, other) in one.probabilities().iter().zip(other.probabilities()) {
        for (one, other) in one.iter().zip(other) {
            assert!((one - other).abs() < 1e-3, "{one} {other}");
        }
    }
    assert_eq!(one.history().last().map(|step| &step.probabilities), Some(&one.probabilities()));
}

#[test]
fn the_command_infers_from_a_simulated_trajectory() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let dir = folder.path().to_str().expect("UTF-8");
    let push = "start=0.44,0.06 direction_deg=0 length=0.15";
    let action = ["tasks/jointed-pair.yaml", "--tool", "finger", "--push", push];
    let alone = ["--model", "planar", "--alone", "--trajectories", "--out", dir];
    let simulated = run(&[&["predict"], &action[..], &alone].concat());
    assert_eq!(simulated.status.code(), Some(0), "{}", stderr(&simulated));
    let file = std::fs::read_dir(dir)
        .expect("the folder")
        .map(|entry| entry.expect("a file").path())
        .find(|path| path.to_string_lossy().ends_with(".trajectory.json"))
        .expect("a trajectory");
    let file = file.to_str().expect("UTF-8");
    let output =
        run(&["infer", file, "--noise", "0", "--heading-noise", "0", "--json", "--out", dir]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let pairs = json["pairs"].as_array().expect("pairs").len();
    assert!(pairs > 0);
    assert_eq!(json["probabilities"].as_array().map(Vec::len), Some(pairs));
    assert!(
        folder.path().join("belief.json").exists() && folder.path().join("belief.svg").exists()
    );
    let wrong = run(&["infer", file, "--noise", "-1"]);
    assert_eq!(wrong.status.code(), Some(2));
}

#[test]
fn the_heavier_of_two_colliding_objects_moves_less() {
    let ranges = [Span::new(0.2, 0.5), Span::new(1.0, 2.0), Span::new(8.0, 10.0)];
    let log = |masses: [f64; 2]| {
        let (mut scene, motion) = cylinders(None);
        let straight =
            Push { start: Vector::new(0.44, 0.0), direction: 0.0, length: 0.3, speed: 0.1 };
        let motion = ToolMotion::pushes(motion.tool, 0.0, 0.0, &[straight], false);
        // The second object obstructs the first, slightly off-centre.
        scene.objects[1].pose = Pose::new(0.6, 0.02, 0.0);
        scene.objects.iter_mut().zip(masses).for_each(|(object, mass)| object.mass = mass);
        let recording = recorded(&scene, &motion, Engine::Planar);
        let settings = BeliefSettings::new(EXACT);
        let mut belief = Belief::new(&scene, motion.tool, motion.lift, settings);
        assert_eq!(belief.mass_shares(), None);
        belief = belief.with_mass_ranges(&ranges);
        assert!(belief.mass_shares().is_some_and(|shares| shares.objects == [None, None]));
        let prior = Prior::default();
        for observation in recording.observations() {
            belief.update(&prior, observation);
        }
        belief.finish(&prior);
        let shares = belief.mass_shares().expect("asked for");
        for of in shares.objects.iter().flatten() {
            assert!((of.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{of:?}");
        }
        let [ratio] = shares.ratios[..] else { panic!("they met: {shares:?}") };
        assert_eq!(ratio.between, [0, 1]);
        // The scene used for planning changes accordingly.
        let planned = belief.map().masses;
        assert_eq!(planned[0] < planned[1], ratio.log[0] < 0.0, "{planned:?} {ratio:?}");
        ratio.log[0]
    };
    let (lighter, heavier) = (log([0.3, 9.0]), log([9.0, 0.3]));
    assert!(lighter < -1.0 && heavier > 1.0, "{lighter} {heavier}");
}
