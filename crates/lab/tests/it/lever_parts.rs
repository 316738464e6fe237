//! The network of parts: symmetry, threads, and validation of its file.

use pushplan::network::{
    Config, LeverWeights, Normaliser, Parameters, PredictorWeights, WeightsError,
};
use pushplan::progress::NoProgress;
use pushplan::task::LeverJob;
use pushplan_lab::bench::load_lever;
use pushplan_lab::parts::{LeverCourse, LeverParts, PARTS, PartGraphs, PartsCard, PartsWeights};
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPreset};
use pushplan_learn::lever_model::LeverModel;

use super::lever_models::is_symmetric;

fn jobs(preset: LeverPreset, count: u64) -> Vec<LeverJob> {
    let config = LeverConfig { seed: 4, episodes: count, preset };
    let set = LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups");
    set.episodes().iter().map(LeverEpisode::job).collect()
}

/// Returns random weights that move boards by millimetres in a step.
fn random(prior: bool) -> PartsWeights {
    let config = Config { width: 16, steps: 2 };
    let mut parameters = Parameters::fresh_of(&PARTS, &config, 3);
    let like = parameters.values["motion.hidden"].clone();
    for name in ["motion.even", "motion.odd"] {
        let values = parameters.values.get_mut(name).expect("a parameter");
        let count = values.len();
        values.iter_mut().zip(&like[..count]).for_each(|(value, x)| *value = 0.1 * x);
    }
    let mut graphs = PartGraphs::default();
    for job in jobs(LeverPreset::Drive, 8) {
        let course = LeverCourse::new(&job, None).expect("cuboids");
        course.describe(&course.start(), 0, &mut graphs);
    }
    let normaliser = Normaliser::measure(&PARTS, graphs.rows());
    let card = PartsCard { config, prior, normaliser, episodes: 7, steps: 8 };
    PartsWeights { card, parameters }
}

#[test]
fn mirrored_and_moved_drives_have_mirrored_and_moved_predictions() {
    for prior in [false, true] {
        is_symmetric(&LeverParts::new(&random(prior)), LeverPreset::Drive, 1e-4);
    }
}

#[test]
fn predictions_in_batches_or_on_more_threads_have_the_same_bits() {
    let model = LeverParts::new(&random(false));
    let jobs = jobs(LeverPreset::Drive, 40);
    let pool = |count| rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("a pool");
    let [one, two] = [1, 2].map(|count| pool(count).install(|| model.rollout(&jobs)));
    assert!(one == two && one.len() == 40);
    for (job, wanted) in jobs.iter().zip(&one) {
        assert_eq!(model.rollout(std::slice::from_ref(job)), std::slice::from_ref(wanted));
        assert!(wanted.lift.iter().chain([&wanted.rest]).all(|pose| pose.is_finite()));
    }
}

#[test]
fn plates_that_are_no_cuboids_are_left_to_others() {
    let model = LeverParts::new(&random(false));
    let plates = jobs(LeverPreset::Varied, 9);
    assert!(plates.iter().all(|job| !model.takes(job)));
    assert!(jobs(LeverPreset::Drive, 4).iter().all(|job| model.takes(job)));
    // Still answered, by the analytic model.
    assert_eq!(model.rollout(&plates), LeverParts::PRIOR.rollout(&plates));
}

#[test]
fn its_file_is_read_back_and_a_damaged_or_another_one_refused() {
    let weights = random(true);
    let bytes = weights.to_bytes().expect("bytes");
    assert_eq!(PartsWeights::from_bytes(&bytes).expect("weights"), weights);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("parts.safetensors");
    for at in [0, 40, bytes.len() / 2, bytes.len() - 2] {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        std::fs::write(&path, &damaged).expect("written");
        let error = load_lever(&path).err().expect("damaged").to_string();
        assert!(error.contains("parts.safetensors"), "{error}");
    }
    std::fs::write(&path, &bytes).expect("written");
    assert_eq!(load_lever(&path).expect("a model").name(), "prior + propagation network, parts");
    assert!(matches!(LeverWeights::from_bytes(&bytes), Err(WeightsError::Foreign { .. })));
    assert!(matches!(PredictorWeights::from_bytes(&bytes), Err(WeightsError::Foreign { .. })));
    let other = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../models/lever.safetensors"));
    let other = other.expect("the shipped memory");
    assert!(matches!(PartsWeights::from_bytes(&other), Err(WeightsError::Foreign { .. })));
    std::fs::write(&path, &other).expect("written");
    assert!(load_lever(&path).expect("a model").name().contains("LSTM"));
}
