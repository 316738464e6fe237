//! Belief regulator: equality of the candle graph and the cell, and learning from lessons.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use candle_core::{Device, Tensor};
use pushplan::effect::{EffectModels, Network};
use pushplan::progress::{NoProgress, Progress};
use pushplan_act::regulator::{Memory, Regulator, RegulatorWeights};
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::{Lesson, lessons};
use pushplan_learn::network::{RegulatorGraph, Unrolled};
use pushplan_learn::train::{RegulatorSettings, score, train_regulator};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::random_regulator::random_weights;
use crate::until::Until;

fn network() -> Arc<Network> {
    Arc::new(Network::new(EffectModels::weights().expect("shipped weights")))
}

fn settings() -> RegulatorSettings {
    let mut settings = RegulatorSettings { width: 8, lessons: 16, ..RegulatorSettings::default() };
    settings.descent.steps = 60;
    settings.descent.batch = 4;
    settings.descent.evaluate_every = 20;
    settings.descent.warm_up = 5;
    settings
}

#[test]
fn the_cell_equals_the_forward_pass_of_training() {
    let (features, width, objects, windows) = (7, 5, 4, 6);
    let pairs = [[0, 1], [1, 2], [0, 3]];
    let weights = random_weights(features, width);
    let cell = Regulator::new(&weights);
    let mut rng = Pcg64::seed_from_u64(5);
    let (mut rows, mut informative) = (Vec::new(), Vec::new());
    for _ in 0..windows {
        rows.push((0..3 * features).map(|_| rng.random_range(-2.0f32..2.0)).collect::<Vec<f32>>());
        informative.push((0..3).map(|_| rng.random_bool(0.7)).collect::<Vec<bool>>());
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
        informative: informative
            .iter()
            .map(|informative| {
                tensor(informative.iter().map(|yes| f32::from(u8::from(*yes))).collect(), 1)
            })
            .collect(),
        ends,
        objects,
    };
    let graph = RegulatorGraph::new(features, width, &weights.parameters).expect("a graph");
    let (logits, _) = graph.forward(&unrolled).expect("logits");
    let mut memory = Memory::default();
    let mut compared = 0;
    for ((row, informative), logits) in rows.iter().zip(&informative).zip(&logits) {
        let wanted: Vec<Vec<f32>> = logits.to_vec2().expect("rows");
        let answers = cell.step(row, informative, (&pairs, objects), &mut memory);
        for (answer, wanted) in answers.iter().zip(&wanted) {
            let Some(answer) = answer else { continue };
            for (a, b) in answer.logits.iter().zip(wanted) {
                assert!((a - f64::from(*b)).abs() < 1e-4, "{a} {b}");
            }
            let trust = 2.0 / (1.0 + f64::from(-wanted[4]).exp());
            assert!((answer.trust - trust).abs() < 1e-4, "{} {trust}", answer.trust);
            compared += 1;
        }
    }
    assert!(compared > 6);
}

fn train(folder: &Path, lessons: &[Lesson], held_out: &[Lesson], progress: &dyn Progress) {
    let lock = FolderLock::take(folder, &NoProgress).expect("a lock");
    train_regulator(&settings(), lessons, held_out, &lock, progress).expect("training");
}

#[test]
fn training_learns_and_resumes_to_the_same_bits_from_lessons_that_are_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let network = network();
    let draw = |name: &str, seed, count, progress: &dyn Progress| {
        let path = folder.path().join(name);
        lessons((seed, count), (&network, "digest".to_owned()), &path, progress)
    };
    let data = draw("data", 1, 40, &NoProgress).expect("lessons");
    // Stopped in the middle and resumed.
    assert!(draw("parts", 1, 40, &Until::new(5)).is_err());
    assert!(data == draw("parts", 1, 40, &NoProgress).expect("lessons"));
    assert!(data.iter().any(|lesson| !lesson.windows.is_empty()));
    let held_out = draw("held-out", 2, 16, &NoProgress).expect("lessons");

    let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    train(whole.path(), &data, &held_out, &NoProgress);
    train(parts.path(), &data, &held_out, &Until::new(20));
    let step =
        |folder: &Path| fs::read(folder.join("checkpoint.safetensors")).expect("a checkpoint");
    assert_ne!(step(whole.path()), step(parts.path()));
    train(parts.path(), &data, &held_out, &NoProgress);
    assert!(step(whole.path()) == step(parts.path()));

    let bytes = fs::read(whole.path().join("last.safetensors")).expect("weights");
    let weights = RegulatorWeights::from_bytes(&bytes).expect("sound weights");
    let learnt = score(&Regulator::new(&weights), &data);
    // Even this few steps correct the overconfidence of the filter.
    assert!(learnt.nll[1] < learnt.nll[0], "{learnt:?}");
}
