//! The belief regulator: the shipped weights, and its symmetries.

use pushplan::effect::Prior;
use pushplan::geometry::{Pose, Vector};
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Joint, JointKind, Object, Scene},
    task::{Job, Noise, Push, ToolMotion},
};
use pushplan_act::belief::{Belief, BeliefRegulator, BeliefSettings, EVIDENCE};
use pushplan_act::regulator::RegulatorWeights;

use crate::fixtures::hand;
use crate::random_regulator::random_weights;

#[test]
fn the_shipped_regulator_loads_and_damaged_or_unfitting_weights_are_refused() {
    BeliefRegulator::shipped().expect("the shipped regulator");
    let weights = BeliefRegulator::shipped_weights().expect("shipped weights");
    let bytes = weights.to_bytes().expect("bytes");
    assert_eq!(RegulatorWeights::from_bytes(&bytes).expect("the same"), weights);
    let mut damaged = bytes.clone();
    let last = damaged.len() - 3;
    damaged[last] ^= 0x10;
    assert!(RegulatorWeights::from_bytes(&damaged).is_err());
    assert!(RegulatorWeights::from_bytes(&bytes[..100]).is_err());
    let other = random_weights(EVIDENCE, 4);
    assert!(BeliefRegulator::on_shipped_network(&other).is_err());
}

/// Returns a recording of three cylinders in a row, the first two hinged, that a hand pushes
/// off-centre.
fn pushed_row() -> Recording {
    let can = |name: &str, y| Object::cylinder(name, 0.04, 0.08).at(0.5, y, 0.3);
    let mut scene = Scene::new([can("first", -0.082), can("second", 0.0), can("third", 0.085)]);
    let hinge = JointKind::Revolute { at: Vector::new(0.5, -0.041), limits: None };
    scene.joints.push(Joint::new([0, 1], hinge));
    let push = Push { start: Vector::new(0.4, -0.02), direction: 0.2, length: 0.25, speed: 0.2 };
    let motion = ToolMotion::pushes(hand(), 0.0, 0.0, &[push], true);
    let job = Job::stated(&scene, motion.clone());
    let frames = Simulator::planar().run(&scene, &job, Record::Frames).frames;
    Recording::of_frames("row", &scene, &motion, &frames)
}

/// Returns the beliefs of the shipped regulator on a recording or its mirror image, with or without
/// headings.
fn believed(recording: &Recording, mirrored: bool, headings: bool) -> Vec<[f64; 4]> {
    let mut recording = recording.clone();
    let turn = |pose: &mut Pose| {
        if mirrored {
            *pose = Pose::new(pose.position.x, -pose.position.y, -pose.heading);
        }
    };
    recording.scene.objects.iter_mut().for_each(|object| turn(&mut object.pose));
    for frame in &mut recording.frames {
        turn(&mut frame.tool);
        frame.poses.iter_mut().for_each(turn);
    }
    let settings = BeliefSettings::new(Noise { position: 1e-3, heading: 0.01 });
    let mut belief = Belief::new(&recording.scene, recording.tool.clone(), 0.0, settings)
        .regulated(BeliefRegulator::shipped().expect("the shipped regulator"));
    let model = Prior::default();
    for mut observation in recording.observations() {
        for sight in observation.seen.iter_mut().flatten() {
            sight.heading = sight.heading.filter(|_| headings);
        }
        belief.update(&model, observation);
    }
    belief.settle(&model);
    belief.probabilities()
}

#[test]
fn mirrored_observations_give_mirrored_beliefs() {
    let recording = pushed_row();
    let settings = BeliefSettings::new(Noise::default());
    for headings in [true, false] {
        let one = believed(&recording, false, headings);
        let other = believed(&recording, true, headings);
        assert_eq!(one.len(), 2);
        let untouched = Belief::new(&recording.scene, recording.tool.clone(), 0.0, settings);
        assert_ne!(one, untouched.probabilities());
        for (a, b) in one.iter().flatten().zip(other.iter().flatten()) {
            // The filter weighs hypotheses by rollouts, whose rounding the regulator amplifies.
            assert!((a - b).abs() < 5e-3, "{headings}: {one:?} {other:?}");
        }
    }
}
