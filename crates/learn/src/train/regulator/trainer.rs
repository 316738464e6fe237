//! The loop: draw lessons, differentiate on two replicas, step, score, save.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pushplan::internals::asset::write_atomic;
use pushplan::internals::network::{
    Parameters, Regulator, RegulatorCard, RegulatorWeights, Statistics, fresh_regulator,
};
use pushplan::internals::seeded::generator;
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;
use rand::Rng;
use rayon::prelude::*;

use crate::dataset::Lesson;
use crate::network::RegulatorGraph;
use crate::train::gradients::gradients_of;
use crate::train::log::Log;
use crate::train::{AdamW, TrainError, learning_rate};

use super::batch::{Examples, Heard};
use super::{RegulatorCheckpoint, RegulatorLine, RegulatorSettings, score};

/// A step's lessons are split into this many parts, differentiated in parallel and added in order, so
/// that the bits do not depend on the number of threads.
const REPLICAS: usize = 2;

/// How often a lesson is learned as it was heard until some push was taken again, and not to its end:
/// beliefs are asked at such moments, too.
const DRAFTS: f64 = 0.4;

/// Steps after which a run looks whether it is to stop.
const LOOK: u64 = 20;

/// Trains in `folder` until the schedule ends or `watch` says to stop; goes on from the folder's
/// checkpoint if there is one. Returns the best weights, or `None` if stopped before the first
/// evaluation.
///
/// # Errors
/// [`TrainError`]; whatever was saved before stays.
pub fn train_regulator(
    settings: &RegulatorSettings,
    lessons: &[Lesson],
    held_out: &[Lesson],
    folder: &FolderLock,
    watch: &dyn Watch,
) -> Result<Option<PathBuf>, TrainError> {
    gemm::set_threading_threshold(usize::MAX);
    let folder = folder.path();
    // Those in which nothing was told teach nothing.
    let lessons: Vec<&Lesson> =
        lessons.iter().filter(|lesson| !lesson.windows.is_empty()).collect();
    if lessons.is_empty() {
        return Err(TrainError::NoExamples);
    }
    let path = folder.join("checkpoint.safetensors");
    let mut run = open(settings, &lessons, &path)?;
    let mut log = Log::open(folder, run.optimiser.step)?;
    let started = Instant::now();
    let (mut count, mut losses, mut norms) = (0.0, 0.0, 0.0);
    let steps = settings.descent.steps;
    while run.optimiser.step < steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(LOOK) && watch.cancelled() {
            break;
        }
        let (loss, gradients) = gradients(&run, &lessons)?;
        let norm = run.optimiser.update(&settings.descent, &gradients);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        (count, losses, norms) = (count + 1.0, losses + loss, norms + norm);
        let step = run.optimiser.step;
        watch.progress(step, steps);
        if step.is_multiple_of(settings.evaluate_every) || step == steps {
            let weights = weights(&run);
            let score = score(&Regulator::new(&weights), held_out);
            let bytes = weights.to_bytes()?;
            write_atomic(folder.join("last.safetensors"), &bytes)?;
            if run.best.is_none_or(|best| score.nll[1] < best.nll[1]) {
                run.best = Some(score);
                write_atomic(folder.join("best.safetensors"), &bytes)?;
            }
            let line = RegulatorLine {
                step,
                loss: losses / count,
                gradient: norms / count,
                learning_rate: learning_rate(&settings.descent, step),
                seconds: started.elapsed().as_secs_f64(),
                held_out: score,
            };
            log.write(&line)?;
            save(&run, &path)?;
            watch.line(&line.to_string());
            (count, losses, norms) = (0.0, 0.0, 0.0);
        }
    }
    save(&run, &path)?;
    Ok(run.best.is_some().then(|| folder.join("best.safetensors")))
}

/// Starts from scratch, or from the checkpoint at `path`.
fn open(
    settings: &RegulatorSettings,
    lessons: &[&Lesson],
    path: &Path,
) -> Result<RegulatorCheckpoint, TrainError> {
    match fs::read(path) {
        Ok(bytes) => RegulatorCheckpoint::from_bytes(&bytes, settings)
            .map_err(|error| TrainError::Checkpoint(path.to_owned(), error)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let mut table = Vec::new();
            let mut columns = 1;
            let drafts = lessons.iter().flat_map(|lesson| &lesson.drafts);
            let first = drafts.flat_map(|draft| &draft.windows);
            for window in first.chain(lessons.iter().flat_map(|lesson| &lesson.windows)) {
                columns = window.features.len() / window.told.len().max(1);
                let rows = window.features.chunks_exact(columns.max(1)).zip(&window.told);
                rows.filter(|(_, told)| **told).for_each(|(row, _)| table.extend_from_slice(row));
            }
            Ok(RegulatorCheckpoint {
                settings: settings.clone(),
                scales: Statistics::measure(&table, columns, true),
                optimiser: AdamW::new(fresh_regulator(columns, settings.width, settings.seed)),
                best: None,
            })
        }
        Err(error) => Err(TrainError::File(path.to_owned(), error)),
    }
}

fn save(run: &RegulatorCheckpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}

/// Loss and gradient of the next step.
fn gradients(
    run: &RegulatorCheckpoint,
    lessons: &[&Lesson],
) -> Result<(f64, Parameters), TrainError> {
    let settings = &run.settings;
    let mut rng = generator(settings.seed, run.optimiser.step);
    let drawn: Vec<Heard> = (0..settings.batch)
        .map(|_| {
            let lesson = lessons[rng.random_range(0..lessons.len())];
            let drafts = lesson.drafts.len();
            let draft =
                (drafts > 0 && rng.random_bool(DRAFTS)).then(|| rng.random_range(0..drafts));
            (lesson, lesson.windows(draft))
        })
        .collect();
    let parts = drawn
        .par_chunks(settings.batch.div_ceil(REPLICAS).max(1))
        .map(|part| replica(run, part))
        .collect::<Result<Vec<_>, candle_core::Error>>()?;
    let share = 1.0 / parts.len() as f32;
    let mut total = 0.0;
    let mut sum = Parameters::default();
    for (loss, gradient) in parts {
        total += loss * f64::from(share);
        for (name, values) in gradient.values {
            let sum = sum.values.entry(name).or_insert_with(|| vec![0.0; values.len()]);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value);
        }
    }
    Ok((total, sum))
}

/// One replica's loss and gradient.
fn replica(
    run: &RegulatorCheckpoint,
    lessons: &[Heard],
) -> Result<(f64, Parameters), candle_core::Error> {
    let (features, width) = (run.scales.mean.len(), run.settings.width);
    let network = RegulatorGraph::new(features, width, &run.optimiser.weights)?;
    let loss = Examples::new(lessons, &run.scales)?.loss(&network)?;
    gradients_of(&loss, network.variables())
}

/// The averaged weights with their card.
fn weights(run: &RegulatorCheckpoint) -> RegulatorWeights {
    RegulatorWeights {
        card: RegulatorCard {
            features: run.scales.mean.len(),
            width: run.settings.width,
            scales: run.scales.clone(),
            data_seed: run.settings.data_seed,
            episodes: run.settings.lessons,
            steps: run.optimiser.step,
        },
        parameters: run.optimiser.average.clone(),
    }
}
