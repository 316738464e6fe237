//! Training: resumable bit-exactly, independent of the number of threads, and effective.

use std::{
    fs,
    path::Path,
    sync::atomic::{AtomicU64, Ordering},
};

use pushplan::network::{Config, PredictorWeights, file_metadata};
use pushplan::progress::{NoProgress, Progress};
use pushplan_bench::store::{FolderLock, StoreError};
use pushplan_learn::dataset::{Dataset, DatasetConfig, Preset};
use pushplan_learn::train::{
    CheckpointError, Descent, HeldOutError, Line, PredictorSettings, TrainError, train_predictor,
};

fn settings(steps: u64) -> PredictorSettings {
    let default = PredictorSettings::default();
    PredictorSettings {
        config: Config { width: 16, steps: 2 },
        descent: Descent {
            batch: 32,
            evaluate_every: 50.min(steps),
            learning_rate: 5e-3,
            ..default.descent.in_steps(steps)
        },
        ..default
    }
}

/// Returns pushes with tools, and a crowd.
fn data(seed: u64, episodes: u64) -> Vec<Dataset> {
    let tools = DatasetConfig { seed, episodes, ..DatasetConfig::default() };
    let crowd = DatasetConfig { preset: Preset::Dense, episodes: 1, ..tools.clone() };
    [tools, crowd].map(|set| Dataset::in_memory(&set, &NoProgress).expect("data")).into()
}

/// Counts the lines, and cancels at a step.
#[derive(Default)]
struct Listener {
    stop_at: Option<u64>,
    step: AtomicU64,
    lines: AtomicU64,
}

impl Progress for Listener {
    fn line(&self, text: &str) {
        // The lines after the last step report the share of the correction.
        let step = text.starts_with("step ");
        assert!(step || text.contains("share") || text.contains("scaled by"), "{text}");
        self.lines.fetch_add(u64::from(step), Ordering::SeqCst);
    }

    fn update(&self, step: u64, _: u64) {
        self.step.store(step, Ordering::SeqCst);
    }

    fn cancelled(&self) -> bool {
        self.stop_at.is_some_and(|stop| self.step.load(Ordering::SeqCst) >= stop)
    }
}

fn lock(folder: &Path) -> FolderLock {
    FolderLock::take(folder, &NoProgress).expect("the folder is free")
}

/// Trains until a step and returns the number of progress lines.
fn run(folder: &Path, data: &[Dataset], held_out: &[Dataset], stop_at: Option<u64>) -> u64 {
    let listener = Listener { stop_at, ..Listener::default() };
    train_predictor(&settings(200), data, held_out, &lock(folder), &listener).expect("training");
    listener.lines.into_inner()
}

/// Returns the lines of a run's `metrics.jsonl`.
fn metrics(folder: &Path) -> Vec<Line<HeldOutError>> {
    let written = fs::read_to_string(folder.join("metrics.jsonl")).expect("metrics");
    written.lines().map(|line| serde_json::from_str(line).expect("a metric line")).collect()
}

fn files(folder: &Path) -> (Vec<u8>, Vec<u8>) {
    let read = |name| fs::read(folder.join(name)).expect(name);
    (read("checkpoint.safetensors"), read("best.safetensors"))
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits_on_any_number_of_threads() {
    let (data, held_out) = (data(1, 40), data(2, 10));
    let folder = tempfile::tempdir().expect("folder");
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let pool =
        |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
    assert_eq!(pool(2).install(|| run(&whole, &data, &held_out, None)), 4);
    pool(1).install(|| run(&parts, &data, &held_out, Some(70)));
    let stopped = fs::read(parts.join("checkpoint.safetensors")).expect("checkpoint");
    // The stop is between two updates of the preceding network, which is saved too.
    let header =
        file_metadata(&stopped, "pushplan-checkpoint").expect("readable").expect("a header");
    let header: serde_json::Value = serde_json::from_str(&header).expect("JSON");
    assert_eq!(header["step"], 80);
    pool(1).install(|| run(&parts, &data, &held_out, None));
    assert!(files(&whole) == files(&parts), "the resumed run ended with other bits");

    for folder in [&whole, &parts] {
        let lines = metrics(folder);
        assert_eq!(lines.iter().map(|line| line.step).collect::<Vec<_>>(), [50, 100, 150, 200]);
        assert!(lines[3].loss < lines[0].loss, "{} {}", lines[0].loss, lines[3].loss);
    }

    let best = PredictorWeights::from_bytes(&files(&whole).1).expect("weights");
    assert_eq!(best.card.sources[0].seed, 1);
    let errors = best.card.errors.expect("held-out pushes were measured");
    assert!(errors.pushes > 0 && errors.p95 > 0.0);
}

#[test]
fn a_checkpoint_of_another_run_or_a_damaged_one_is_refused_and_kept() {
    let (data, held_out) = (data(1, 5), data(2, 2));
    let folder = tempfile::tempdir().expect("folder");
    let short = settings(1);
    let lock = lock(folder.path());
    assert!(matches!(FolderLock::take(folder.path(), &NoProgress), Err(StoreError::Busy { .. })));
    train_predictor(&short, &data, &held_out, &lock, &NoProgress).expect("training");
    let path = folder.path().join("checkpoint.safetensors");
    let before = fs::read(&path).expect("checkpoint");

    let other = PredictorSettings { seed: 9, ..short.clone() };
    let error = train_predictor(&other, &data, &held_out, &lock, &NoProgress);
    assert!(matches!(error, Err(TrainError::Checkpoint(_, CheckpointError::Other))));
    assert_eq!(fs::read(&path).expect("checkpoint"), before);

    fs::write(&path, &before[..100]).expect("damage");
    let error = train_predictor(&short, &data, &held_out, &lock, &NoProgress);
    assert!(matches!(error, Err(TrainError::Checkpoint(_, CheckpointError::Format(_)))));
    assert_eq!(fs::read(&path).expect("checkpoint").len(), 100, "nothing was overwritten");
}
