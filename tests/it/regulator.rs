//! The belief regulator: two implementations, its training, what ships, and its symmetries.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use candle_core::{Device, Tensor};
use pushplan::belief::{Belief, BeliefRegulator, BeliefSettings, EVIDENCE};
use pushplan::dataset::{Lesson, lessons};
use pushplan::effect::{EffectModels, Network, Prior};
use pushplan::geometry::{Pose, Vector};
use pushplan::network::{
    Memory, Regulator, RegulatorCard, RegulatorGraph, RegulatorWeights, Statistics, Unrolled,
    fresh_regulator,
};
use pushplan::recording::Recording;
use pushplan::scene::{Job, Joint, JointKind, Noise, Object, Push, Record, Scene, ToolMotion};
use pushplan::sim::Simulator;
use pushplan::store::FolderLock;
use pushplan::train::{RegulatorSettings, score, train_regulator};
use pushplan::watch::{Unwatched, Watch};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::fixtures::hand;

fn network() -> Arc<Network> {
    Arc::new(Network::new(EffectModels::weights().expect("shipped weights")))
}

fn settings() -> RegulatorSettings {
    let mut settings = RegulatorSettings {
        width: 8,
        batch: 4,
        evaluate_every: 20,
        lessons: 16,
        ..RegulatorSettings::default()
    };
    settings.descent.steps = 60;
    settings.descent.warm_up = 5;
    settings
}

/// Random weights, none of them zero, with features of random scales.
fn random_weights(features: usize, width: usize) -> RegulatorWeights {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut parameters = fresh_regulator(features, width, 3);
    for value in parameters.values.values_mut().flatten() {
        *value += rng.random_range(-0.3..0.3);
    }
    let scales = Statistics {
        mean: (0..features).map(|_| rng.random_range(-1.0..1.0)).collect(),
        deviation: (0..features).map(|_| rng.random_range(0.5..2.0)).collect(),
    };
    let card = RegulatorCard { features, width, scales, data_seed: 1, episodes: 1, steps: 0 };
    RegulatorWeights { card, parameters }
}

#[test]
fn the_cell_computes_what_training_differentiates() {
    let (features, width, objects, windows) = (7, 5, 4, 6);
    let pairs = [[0, 1], [1, 2], [0, 3]];
    let weights = random_weights(features, width);
    let cell = Regulator::new(&weights);
    let mut rng = Pcg64::seed_from_u64(5);
    let (mut rows, mut told) = (Vec::new(), Vec::new());
    for _ in 0..windows {
        rows.push((0..3 * features).map(|_| rng.random_range(-2.0f32..2.0)).collect::<Vec<f32>>());
        told.push((0..3).map(|_| rng.random_bool(0.7)).collect::<Vec<bool>>());
    }
    let tensor = |values: Vec<f32>, columns: usize| {
        Tensor::from_vec(values, (3, columns), &Device::Cpu).expect("a tensor")
    };
    let ends = [0, 1].map(|end| {
        let ends: Vec<u32> = pairs.iter().map(|pair| pair[end] as u32).collect();
        Tensor::from_vec(ends, 3, &Device::Cpu).expect("indices")
    });
    let unrolled = Unrolled {
        features: rows.iter().map(|row| tensor(weights.card.scales.apply(row), features)).collect(),
        told: told
            .iter()
            .map(|told| tensor(told.iter().map(|yes| f32::from(u8::from(*yes))).collect(), 1))
            .collect(),
        ends,
        objects,
    };
    let graph = RegulatorGraph::new(features, width, &weights.parameters).expect("a graph");
    let (logits, _) = graph.forward(&unrolled).expect("logits");
    let mut memory = Memory::default();
    let mut compared = 0;
    for ((row, told), logits) in rows.iter().zip(&told).zip(&logits) {
        let wanted: Vec<Vec<f32>> = logits.to_vec2().expect("rows");
        let answers = cell.step(row, told, (&pairs, objects), &mut memory);
        for (answer, wanted) in answers.iter().zip(&wanted) {
            let Some(answer) = answer else { continue };
            for (a, b) in answer.iter().zip(wanted) {
                assert!((a - f64::from(*b)).abs() < 1e-4, "{a} {b}");
            }
            compared += 1;
        }
    }
    assert!(compared > 6);
}

/// Stops at a step.
struct Until(u64, AtomicU64);

impl Watch for Until {
    fn progress(&self, step: u64, _: u64) {
        self.1.store(step, Ordering::SeqCst);
    }

    fn cancelled(&self) -> bool {
        self.1.load(Ordering::SeqCst) >= self.0
    }
}

fn train(folder: &Path, lessons: &[Lesson], held_out: &[Lesson], watch: &dyn Watch) {
    let lock = FolderLock::take(folder, &Unwatched).expect("a lock");
    train_regulator(&settings(), lessons, held_out, &lock, watch).expect("training");
}

#[test]
fn training_learns_and_resumes_to_the_same_bits_from_lessons_that_are_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let network = network();
    let draw = |name: &str, seed, count, watch: &dyn Watch| {
        let path = folder.path().join(name);
        lessons((seed, count), (&network, "digest".to_owned()), &path, watch)
    };
    let data = draw("data", 1, 40, &Unwatched).expect("lessons");
    // Stopped in the middle and gone on with.
    assert!(draw("parts", 1, 40, &Until(5, AtomicU64::new(0))).is_err());
    assert!(data == draw("parts", 1, 40, &Unwatched).expect("lessons"));
    assert!(data.iter().any(|lesson| !lesson.windows.is_empty()));
    let held_out = draw("held-out", 2, 16, &Unwatched).expect("lessons");

    let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    train(whole.path(), &data, &held_out, &Unwatched);
    train(parts.path(), &data, &held_out, &Until(20, AtomicU64::new(0)));
    let step =
        |folder: &Path| fs::read(folder.join("checkpoint.safetensors")).expect("a checkpoint");
    assert_ne!(step(whole.path()), step(parts.path()));
    train(parts.path(), &data, &held_out, &Unwatched);
    assert!(step(whole.path()) == step(parts.path()));

    let bytes = fs::read(whole.path().join("last.safetensors")).expect("weights");
    let weights = RegulatorWeights::from_bytes(&bytes).expect("sound weights");
    let learnt = score(&Regulator::new(&weights), &data);
    // Even so few steps find that the filter is too sure.
    assert!(learnt.nll[1] < learnt.nll[0], "{learnt:?}");
}

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

/// Three cylinders in a row, the first two hinged, that a hand pushes off their middle.
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

/// What the shipped regulator believes of a recording, or of the same seen in a mirror, with headings
/// or without.
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
fn what_is_seen_in_a_mirror_is_believed_alike() {
    let recording = pushed_row();
    let settings = BeliefSettings::new(Noise::default());
    for headings in [true, false] {
        let one = believed(&recording, false, headings);
        let other = believed(&recording, true, headings);
        assert_eq!(one.len(), 2);
        let untouched = Belief::new(&recording.scene, recording.tool.clone(), 0.0, settings);
        assert_ne!(one, untouched.probabilities());
        for (a, b) in one.iter().flatten().zip(other.iter().flatten()) {
            assert!((a - b).abs() < 1e-3, "{headings}: {one:?} {other:?}");
        }
    }
}
