//! The network of parts: the candle graph agrees with the deployed network, and training resumes
//! exactly.

use std::fs;
use std::path::Path;

use pushplan::effect::LeverPrior;
use pushplan::network::{Buffers, Config, Forward, Normaliser, Parameters};
use pushplan::progress::{NoProgress, Progress};
use pushplan::task::LeverJob;
use pushplan_bench::store::FolderLock;
use pushplan_lab::bench::load_lever;
use pushplan_lab::parts::{
    LeverCourse, LeverParts, PARTS, PartGraphs, PartState, PartsCard, PartsSettings, PartsWeights,
    train_parts,
};
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPreset};
use pushplan_learn::judge::lever_error;
use pushplan_learn::lever_model::LeverModel;
use pushplan_learn::network::{Inputs, Predictor};

use crate::until::Until;

const CONFIG: Config = Config { width: 32, steps: 2 };

fn episodes(seed: u64, count: u64) -> Vec<LeverEpisode> {
    let config = LeverConfig { seed, episodes: count, preset: LeverPreset::Drive };
    LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups").episodes().to_vec()
}

/// Returns the graphs of first steps.
fn graphs(episodes: &[LeverEpisode]) -> PartGraphs {
    let mut graphs = PartGraphs::default();
    for episode in episodes {
        let course = LeverCourse::new(&episode.job(), None).expect("cuboids");
        course.describe(&course.start(), 0, &mut graphs);
    }
    graphs
}

#[test]
fn prediction_equals_the_forward_pass_of_training() {
    let graphs = graphs(&episodes(5, 6));
    let normaliser = Normaliser::measure(&PARTS, graphs.rows());
    let mut parameters = Parameters::fresh_of(&PARTS, &CONFIG, 2);
    for (k, values) in parameters.values.values_mut().enumerate() {
        values.iter_mut().enumerate().for_each(|(i, x)| *x += 0.01 * ((i + k) % 7) as f32);
    }
    let forward = Forward::of(&CONFIG, &normaliser, &parameters);
    let mut buffers = Buffers::default();
    let (even, odd) = forward.read(graphs.rows(), &mut buffers);
    let network = Predictor::of(&PARTS, CONFIG, &parameters).expect("a network");
    let inputs = Inputs::new(graphs.rows(), &normaliser).expect("tables");
    let wanted = network.forward(&inputs).expect("numbers").to_vec2::<f32>().expect("rows");
    assert_eq!((even.len(), odd.len()), (3 * wanted.len(), 3 * wanted.len()));
    for (k, wanted) in wanted.iter().enumerate() {
        let found = [&even[3 * k..3 * k + 3], &odd[3 * k..3 * k + 3]].concat();
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-4 * wanted.abs().max(1.0), "{found} {wanted}");
        }
    }
}

#[test]
fn the_target_of_a_step_leads_to_the_true_state() {
    let [a, b] = &episodes(6, 2)[..] else { panic!("two lever-ups") };
    for prior in [None, Some(&LeverPrior::default())] {
        let course = LeverCourse::new(&a.job(), prior).expect("cuboids");
        let (from, to) = (course.see(&a.trajectory.lift[4]), course.see(&b.trajectory.lift[9]));
        let state = PartState::at(from);
        let predicted = course.wanted(&state, 4, to);
        let found = course.moved(&state, 4, (&predicted[..3], &predicted[3..]));
        assert!(found.apart(to) < 1e-6, "{} m", found.apart(to));
    }
}

fn settings(prior: bool) -> PartsSettings {
    let mut settings = PartsSettings { config: CONFIG, prior, ..PartsSettings::default() };
    settings.descent.steps = 300;
    settings.descent.batch = 64;
    settings.descent.evaluate_every = 100;
    settings.descent.warm_up = 10;
    settings.descent.average = 0.9;
    settings
}

/// Returns the mean error over the rotation, metres.
fn error(model: &dyn LeverModel, episodes: &[LeverEpisode]) -> f64 {
    let jobs: Vec<LeverJob> = episodes.iter().map(LeverEpisode::job).collect();
    let predicted = model.rollout(&jobs);
    let off = episodes.iter().zip(&jobs).zip(&predicted);
    let sum: f64 = off
        .map(|((episode, job), predicted)| lever_error(job, &episode.trajectory, predicted).lift)
        .sum();
    sum / episodes.len() as f64
}

fn fresh(prior: bool, data: &[LeverEpisode]) -> LeverParts {
    let normaliser = Normaliser::measure(&PARTS, graphs(data).rows());
    let card = PartsCard { config: CONFIG, prior, normaliser, episodes: 0, steps: 0 };
    LeverParts::new(&PartsWeights { card, parameters: Parameters::fresh_of(&PARTS, &CONFIG, 1) })
}

#[test]
fn training_learns_resumes_to_the_same_bits_and_predicts() {
    let (data, held_out) = (episodes(1, 32), episodes(2, 12));
    let train = |folder: &Path, settings: &PartsSettings, progress: &dyn Progress| {
        let lock = FolderLock::take(folder, &NoProgress).expect("a lock");
        train_parts(settings, &data, &held_out, &lock, progress).expect("training");
        fs::read(folder.join("checkpoint.safetensors")).expect("a checkpoint")
    };
    let settings = settings(false);
    let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let wanted = single.install(|| train(whole.path(), &settings, &NoProgress));
    // Stopped before examples come from rollouts, then between two evaluations.
    for steps in [40, 240] {
        assert!(train(parts.path(), &settings, &Until::new(steps)) != wanted);
    }
    assert!(train(parts.path(), &settings, &NoProgress) == wanted);

    let network = load_lever(&whole.path().join("best.safetensors")).expect("weights");
    assert_eq!(network.name(), "propagation network, parts");
    // An untrained network moves nothing.
    let (learned, still) = (error(&network, &held_out), error(&fresh(false, &data), &held_out));
    assert!(learned < 0.3 * still, "{learned} {still}");

    let other = PartsSettings { seed: 2, ..settings };
    let lock = FolderLock::take(whole.path(), &NoProgress).expect("a lock");
    assert!(train_parts(&other, &data, &held_out, &lock, &NoProgress).is_err());
}

#[test]
fn a_correction_begins_as_its_prior_and_is_saved_with_it() {
    let (data, held_out) = (episodes(1, 16), episodes(2, 12));
    let untrained = error(&fresh(true, &data), &held_out);
    let prior = error(&LeverParts::PRIOR, &held_out);
    // Its steps differ, because it is evaluated at other times.
    assert!(untrained < 2.0 * prior + 1e-4, "{untrained} {prior}");
    let folder = tempfile::tempdir().expect("a folder");
    let lock = FolderLock::take(folder.path(), &NoProgress).expect("a lock");
    let best =
        train_parts(&settings(true), &data, &held_out, &lock, &NoProgress).expect("training");
    let network = load_lever(&best.expect("weights")).expect("weights");
    assert_eq!(network.name(), "prior + propagation network, parts");
}
