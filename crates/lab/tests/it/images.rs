//! Networks with image input: the candle graph agrees with the deployed network, mirrored lever-ups
//! have mirrored predictions, files are read back, and training resumes exactly.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use candle_core::{Device, Tensor};
use pushplan::effect::LeverInputs;
use pushplan::network::{
    Card, LEVER_ENDS, LeverCard, LeverOutput, LeverSizes, Parameters, Statistics, WeightsError,
};
use pushplan::progress::{NoProgress, Progress};
use pushplan::{
    outcome::LEVER_FRAMES,
    scene::{LeverFeatures, LeverScene},
    task::LeverJob,
};
use pushplan_bench::store::FolderLock;
use pushplan_lab::bench::load_lever;
use pushplan_lab::image::{
    CODE, ImageCard, ImageFeatures, ImageGraph, ImageNetwork, ImageSettings, ImageSizes,
    ImageWeights, image_inputs, train_image,
};
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPreset};
use pushplan_learn::lever_model::LeverModel;
use pushplan_learn::network::LeverTensors;
use pushplan_learn::train::{Descent, LeverSettings};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::lever_models::is_symmetric;

use crate::until::Until;

fn episodes(preset: LeverPreset, seed: u64, count: u64) -> Vec<LeverEpisode> {
    let config = LeverConfig { seed, episodes: count, preset };
    LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups").episodes().to_vec()
}

/// Returns random weights, large enough to matter.
fn random(features: ImageFeatures, prior: bool) -> ImageWeights {
    let sizes = LeverInputs::sizes(LeverFeatures::Nothing, prior, 12);
    let scales =
        |columns: usize| Statistics { mean: vec![0.1; columns], deviation: vec![1.5; columns] };
    let [rows, columns] = features.extents();
    let memory = LeverCard {
        features: LeverFeatures::Nothing,
        prior,
        sizes,
        still: scales(sizes.still),
        moving: scales(sizes.moving),
        episodes: 7,
        steps: 8,
    };
    let card = ImageCard { features, image: ImageSizes { rows, columns, code: CODE }, memory };
    let mut rng = Pcg64::seed_from_u64(9);
    let values = card.layout().into_iter().map(|(name, shape)| {
        let count: usize = shape.iter().product();
        (name.to_owned(), (0..count).map(|_| rng.random_range(-0.2f32..0.2)).collect())
    });
    ImageWeights { parameters: Parameters { values: values.collect() }, card }
}

#[test]
fn prediction_equals_the_forward_pass_of_training() {
    let tensor = |values: &[f32], shape: &[usize]| {
        Tensor::from_slice(values, shape, &Device::Cpu).expect("a tensor")
    };
    for features in [ImageFeatures::Depth, ImageFeatures::ContextImage] {
        let weights = random(features, false);
        let ImageCard { image: sizes, memory, .. } = &weights.card;
        let graph = ImageGraph::new((&memory.sizes, sizes), &weights.parameters, false);
        let graph = graph.expect("a graph");
        let network = ImageNetwork::new(&weights).expect("a network");
        for episode in episodes(LeverPreset::Varied, 5, 4) {
            let job = episode.job();
            let (inputs, image) = image_inputs(features, &job, None);
            let moving = memory.moving.apply(&inputs.moving);
            let moving = moving.chunks_exact(memory.sizes.moving);
            let tensors = LeverTensors {
                still: tensor(&memory.still.apply(&inputs.still), &[1, memory.sizes.still]),
                moving: moving.map(|row| tensor(row, &[1, memory.sizes.moving])).collect(),
                before: Vec::new(),
            };
            let image = tensor(&image, &[1, sizes.rows, sizes.columns, 1]);
            let beside = graph.contribution(&image).expect("a code");
            let (poses, end) =
                graph.memory().forward(&tensors, Some(&beside)).expect("predictions");
            assert_eq!(poses.len(), LEVER_FRAMES);
            let row = |output: &Tensor| output.to_vec2::<f32>().expect("a row").concat();
            let end: [f32; LEVER_ENDS] = row(&end).try_into().expect("an end");
            let output = LeverOutput { poses: poses.iter().flat_map(row).collect(), end };
            let wanted = inputs.answer(&output, &job, None);
            let predicted = network.rollout(&[job]).remove(0);
            for (a, b) in predicted.lift.iter().zip(&wanted.lift) {
                assert!((a.position - b.position).norm() < 1e-5 && a.angle_to(b) < 1e-3);
            }
            assert_eq!(predicted.ending, wanted.ending);
        }
    }
}

/// Images are drawn from the lever point, so their pixels have no effect here.
#[test]
fn mirrored_and_moved_lever_ups_have_mirrored_and_moved_predictions() {
    let network = |features, prior| {
        ImageNetwork::new(&random(features, prior)).expect("weights that fit their card")
    };
    is_symmetric(&network(ImageFeatures::Image, false), LeverPreset::Varied, 1e-5);
    is_symmetric(&network(ImageFeatures::ContextImage, true), LeverPreset::Varied, 1e-5);
    is_symmetric(&network(ImageFeatures::Depth, false), LeverPreset::Varied, 1e-5);
    is_symmetric(&network(ImageFeatures::Depth, false), LeverPreset::Lying, 1e-5);
}

#[test]
fn only_a_depth_image_distinguishes_boxes_from_lying_cylinders() {
    let drawn = episodes(LeverPreset::Lying, 4, 32);
    let jobs: Vec<LeverJob> = drawn.iter().map(LeverEpisode::job).collect();
    let round = |job: &LeverJob| job.scene.plates[0].slabs.len() > 1;
    // Each cylinder is compared with a box of its extents.
    for cylinder in jobs.iter().filter(|job| round(job)) {
        let mut scene = LeverScene::clone(&cylinder.scene);
        let plate = &mut scene.plates[0];
        plate.slabs.truncate(1);
        plate.slabs[0].bottom = 0.0;
        plate.slabs[0].height = cylinder.lever.pivot - plate.clearance;
        let like = LeverJob { scene: Arc::new(scene), lever: cylinder.lever };
        let seen = |features, job| image_inputs(features, job, None);
        for features in
            [ImageFeatures::Image, ImageFeatures::ImageCode, ImageFeatures::ContextImage]
        {
            assert_eq!(seen(features, cylinder), seen(features, &like));
        }
        let depth = |job| seen(ImageFeatures::Depth, job).1;
        let pixels = depth(cylinder).into_iter().zip(depth(&like));
        let apart = pixels.filter(|(a, b)| (a - b).abs() > 0.1);
        assert!(apart.count() > 100);
    }
    assert!(jobs.iter().any(round) && !jobs.iter().all(round));
}

#[test]
fn a_networks_file_is_read_back_and_another_one_refused() {
    let weights = random(ImageFeatures::Image, false);
    let bytes = weights.to_bytes().expect("bytes");
    assert_eq!(ImageWeights::from_bytes(&bytes).expect("weights"), weights);
    // Valid weights whose card names other features.
    let card = ImageCard { features: ImageFeatures::ContextImage, ..weights.card.clone() };
    assert!(ImageNetwork::new(&ImageWeights { card, ..weights.clone() }).is_err());
    let mut other = weights.clone();
    other.card.memory.sizes = LeverSizes { still: 7, ..other.card.memory.sizes };
    assert!(ImageNetwork::new(&other).is_err());
    // Images without matching convolutions.
    let (from, to) = (br#"rows\":64"#, br#"rows\":99"#);
    let at = bytes.windows(from.len()).position(|window| window == from).expect("a card");
    let mut larger = bytes;
    larger[at..][..to.len()].copy_from_slice(to);
    assert!(matches!(ImageWeights::from_bytes(&larger), Err(WeightsError::Size { .. })));
}

/// Stops before and after an autoencoder is done, and covers feedback of predictions.
#[test]
fn training_resumes_to_the_same_bits() {
    let episodes = |seed, count| episodes(LeverPreset::Varied, seed, count);
    let (data, held_out) = (episodes(1, 48), episodes(2, 12));
    let with = |features, feedback| {
        let default = LeverSettings::default();
        let memory = LeverSettings {
            features: LeverFeatures::Nothing,
            prior: false,
            width: 8,
            descent: Descent { batch: 16, evaluate_every: 20, ..default.descent.in_steps(60) },
            feedback,
            cut: feedback,
            ..default
        };
        ImageSettings { features, memory }
    };
    let of = [
        (with(ImageFeatures::ImageCode, false), "LSTM, image autoencoder"),
        (with(ImageFeatures::ContextImage, true), "LSTM, shape context CNN, fed back"),
    ];
    for (settings, name) in of {
        let train = |folder: &Path, progress: &dyn Progress| {
            let lock = FolderLock::take(folder, &NoProgress).expect("a lock");
            train_image(&settings, &data, &held_out, &lock, progress).expect("training")
        };
        let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().expect("a folder"));
        let best = train(whole.path(), &NoProgress).expect("weights");
        // The autoencoder counts its own steps.
        train(parts.path(), &Until::new(40));
        train(parts.path(), &Until::new(20));
        train(parts.path(), &NoProgress);
        let checkpoint = |folder: &tempfile::TempDir| {
            fs::read(folder.path().join("checkpoint.safetensors")).expect("a checkpoint")
        };
        assert!(checkpoint(&whole) == checkpoint(&parts), "{name}");
        assert_eq!(load_lever(&best).expect("weights").name(), name);
    }
}
