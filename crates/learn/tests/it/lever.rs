//! Networks of lever-ups: equality of the candle graph and the cell, and bit-exact resumption.

use std::fs;
use std::path::Path;

use candle_core::{Device, Tensor};
use pushplan::effect::{LeverInputs, LeverNetwork};
use pushplan::network::{
    LEVER_ENDS, LEVER_POSE, LeverCard, LeverCell, LeverSizes, LeverWeights, Parameters, Statistics,
    fresh_lever, lever_layout,
};
use pushplan::progress::{NoProgress, Progress};
use pushplan::{outcome::LEVER_FRAMES, scene::LeverFeatures, task::LeverJob};
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPreset};
use pushplan_learn::judge::lever_error;
use pushplan_learn::lever_model::LeverModel;
use pushplan_learn::network::{LeverGraph, LeverTensors};
use pushplan_learn::train::{LeverSettings, train_lever};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::until::Until;

/// Returns scales without effect.
fn as_is(columns: usize) -> Statistics {
    Statistics { mean: vec![0.0; columns], deviation: vec![1.0; columns] }
}

fn weights(features: LeverFeatures, sizes: LeverSizes, parameters: Parameters) -> LeverWeights {
    let card = LeverCard {
        features,
        prior: true,
        sizes,
        still: as_is(sizes.still),
        moving: as_is(sizes.moving),
        episodes: 0,
        steps: 0,
    };
    LeverWeights { card, parameters }
}

#[test]
fn the_cell_equals_the_forward_pass_of_training() {
    let plain = LeverSizes { still: 7, moving: 4, width: 11, ..LeverSizes::default() };
    for sizes in [plain, LeverSizes { feedback: true, ..plain }] {
        computes_what_training_differentiates(sizes);
    }
}

fn computes_what_training_differentiates(sizes: LeverSizes) {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut draw =
        |count: usize| (0..count).map(|_| rng.random_range(-0.5f32..0.5)).collect::<Vec<f32>>();
    let values = lever_layout(&sizes)
        .into_iter()
        .map(|(name, shape)| (name.to_owned(), draw(shape.iter().product())));
    let parameters = Parameters { values: values.collect() };
    let (still, moving) = (draw(sizes.still), draw(sizes.moving * LEVER_FRAMES));
    let cell = LeverCell::new(&weights(LeverFeatures::Nothing, sizes, parameters.clone()));
    let predicted = cell.predict(&still, &moving);

    let tensor = |values: &[f32]| {
        Tensor::from_slice(values, (1, values.len()), &Device::Cpu).expect("a tensor")
    };
    let tensors = LeverTensors {
        still: tensor(&still),
        moving: moving.chunks_exact(sizes.moving).map(tensor).collect(),
        // Predictions that the cell feeds back to itself.
        before: if sizes.feedback {
            let poses = predicted.poses.chunks_exact(LEVER_POSE);
            std::iter::once(&[0.0; LEVER_POSE][..]).chain(poses).map(tensor).collect()
        } else {
            Vec::new()
        },
    };
    let graph = LeverGraph::new(&sizes, &parameters).expect("a graph");
    let (poses, end) = graph.forward(&tensors, None).expect("predictions");
    let mut wanted: Vec<f32> =
        poses.iter().flat_map(|pose| pose.to_vec2::<f32>().expect("a row").concat()).collect();
    assert_eq!([wanted.len(), predicted.poses.len()], [LEVER_POSE * LEVER_FRAMES; 2]);
    wanted.extend(end.to_vec2::<f32>().expect("a row").concat());
    assert_eq!(wanted.len(), LEVER_POSE * LEVER_FRAMES + LEVER_ENDS);
    for (a, b) in predicted.poses.iter().chain(&predicted.end).zip(&wanted) {
        assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}

fn episodes(seed: u64, count: u64) -> Vec<LeverEpisode> {
    let config = LeverConfig { seed, episodes: count, preset: LeverPreset::Varied };
    LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups").episodes().to_vec()
}

#[test]
fn an_untrained_network_leaves_the_way_of_the_prior_as_it_is() {
    let jobs: Vec<LeverJob> = episodes(5, 6).iter().map(LeverEpisode::job).collect();
    let features = LeverFeatures::Shape;
    let sizes = LeverInputs::sizes(features, true, 8);
    let network = LeverNetwork::new(&weights(features, sizes, fresh_lever(&sizes, 1)));
    let network = network.expect("a network");
    for (a, b) in network.rollout(&jobs).iter().zip(LeverNetwork::PRIOR.rollout(&jobs)) {
        for (a, b) in a.lift.iter().zip(&b.lift) {
            // Tolerance of single precision.
            let apart = (a.position - b.position).norm();
            assert!(apart < 1e-6 && a.angle_to(b) < 1e-3, "{apart} m, {} rad", a.angle_to(b));
        }
    }
    let others = LeverSizes { still: sizes.still + 1, ..sizes };
    assert!(LeverNetwork::new(&weights(features, others, fresh_lever(&others, 1))).is_err());
}

fn settings(prior: bool) -> LeverSettings {
    let mut settings = LeverSettings {
        features: LeverFeatures::Support,
        prior,
        width: 8,
        ..LeverSettings::default()
    };
    settings.descent.steps = 120;
    settings.descent.batch = 16;
    settings.descent.evaluate_every = 40;
    settings.descent.warm_up = 10;
    settings
}

#[test]
fn training_learns_and_resumes_to_the_same_bits() {
    let (data, held_out) = (episodes(1, 96), episodes(2, 24));
    let train = |folder: &Path, settings: &LeverSettings, progress: &dyn Progress| {
        let lock = FolderLock::take(folder, &NoProgress).expect("a lock");
        train_lever(settings, &data, &held_out, &lock, progress).expect("training");
        fs::read(folder.join("checkpoint.safetensors")).expect("a checkpoint")
    };
    let settings = settings(false);
    let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let wanted = single.install(|| train(whole.path(), &settings, &NoProgress));
    // Stopped between two evaluations and resumed.
    assert!(train(parts.path(), &settings, &Until::new(60)) != wanted);
    assert!(train(parts.path(), &settings, &NoProgress) == wanted);

    let network = LeverNetwork::load(&whole.path().join("last.safetensors")).expect("weights");
    let jobs: Vec<LeverJob> = data.iter().map(LeverEpisode::job).collect();
    let error = |model: &dyn LeverModel| -> f64 {
        let predicted = model.rollout(&jobs);
        let off = data.iter().zip(&jobs).zip(&predicted);
        off.map(|((episode, job), predicted)| lever_error(job, &episode.trajectory, predicted).lift)
            .sum()
    };
    let features = LeverFeatures::Support;
    let sizes = LeverInputs::sizes(features, false, 8);
    let mut fresh = weights(features, sizes, fresh_lever(&sizes, 1));
    fresh.card.prior = false;
    let fresh = LeverNetwork::new(&fresh).expect("a network");
    // An untrained network without the analytic model predicts no motion.
    assert!(error(&network) < 0.6 * error(&fresh), "{} {}", error(&network), error(&fresh));

    // A run resumes only under its own settings.
    let other = LeverSettings { seed: 2, ..settings };
    let lock = FolderLock::take(whole.path(), &NoProgress).expect("a lock");
    assert!(train_lever(&other, &data, &held_out, &lock, &NoProgress).is_err());
}

/// Tests feedback of predictions up to the first slip, as in Tekden (2020).
#[test]
fn fed_back_training_resumes_to_the_same_bits() {
    let (data, held_out) = (episodes(1, 48), episodes(2, 12));
    let mut settings = LeverSettings {
        features: LeverFeatures::ShapeContext,
        feedback: true,
        cut: true,
        ..settings(false)
    };
    settings.descent.steps = 60;
    settings.descent.evaluate_every = 20;
    let train = |folder: &Path, progress: &dyn Progress| {
        let lock = FolderLock::take(folder, &NoProgress).expect("a lock");
        let best = train_lever(&settings, &data, &held_out, &lock, progress).expect("training");
        (best, fs::read(folder.join("checkpoint.safetensors")).expect("a checkpoint"))
    };
    let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let (best, wanted) = train(whole.path(), &NoProgress);
    train(parts.path(), &Until::new(40));
    assert!(train(parts.path(), &NoProgress).1 == wanted);
    let network = LeverNetwork::load(&best.expect("weights")).expect("weights");
    assert_eq!(network.name(), "LSTM, shape context, fed back");
}

#[test]
fn a_correction_is_saved_with_its_prior() {
    let (data, held_out) = (episodes(1, 32), episodes(2, 12));
    let folder = tempfile::tempdir().expect("a folder");
    let lock = FolderLock::take(folder.path(), &NoProgress).expect("a lock");
    let best =
        train_lever(&settings(true), &data, &held_out, &lock, &NoProgress).expect("training");
    let network = LeverNetwork::load(&best.expect("weights")).expect("weights");
    assert_eq!(network.name(), "prior + LSTM, support points");
}
