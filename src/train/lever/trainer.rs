//! The loop: draw lever-ups, differentiate on two replicas, step, score, save.

use std::{
    fs,
    path::{Path, PathBuf},
    time::Instant,
};

use rand::Rng;
use rayon::prelude::*;

use crate::{
    asset::write_atomic,
    dataset::{LeverEpisode, generator},
    effect::{LeverInputs, LeverModel, LeverNetwork},
    judge::lever_error,
    network::{LeverCard, LeverGraph, LeverWeights, Parameters, Statistics, fresh_lever},
    scene::LeverJob,
    store::FolderLock,
    train::{AdamW, TrainError, gradients::gradients_of, learning_rate, log::Log},
    watch::Watch,
};

use super::{
    LeverCheckpoint, LeverLine, LeverSettings,
    batch::{Batch, Example, examples},
    settings::LeverScore,
};

/// A step's lever-ups are split into this many parts, differentiated in parallel and added in order,
/// so that the bits do not depend on the number of threads.
const REPLICAS: usize = 2;

/// Steps after which a run looks whether it is to stop.
const LOOK: u64 = 20;

/// Trains in `folder` until the schedule ends or `watch` says to stop; goes on from the folder's
/// checkpoint if there is one. Returns the best weights, or `None` if stopped before the first
/// evaluation.
///
/// # Errors
/// [`TrainError`]; whatever was saved before stays.
pub fn train_lever(
    settings: &LeverSettings,
    episodes: &[LeverEpisode],
    held_out: &[LeverEpisode],
    folder: &FolderLock,
    watch: &dyn Watch,
) -> Result<Option<PathBuf>, TrainError> {
    gemm::set_threading_threshold(usize::MAX);
    let folder = folder.path();
    let examples = examples(settings, episodes);
    if examples.is_empty() {
        return Err(TrainError::NoExamples);
    }
    let held_out: Vec<&LeverEpisode> =
        held_out.iter().filter(|episode| episode.is_sound()).collect();
    let path = folder.join("checkpoint.safetensors");
    let mut run = open(settings, &examples, &path)?;
    let mut log = Log::open(folder, run.optimiser.step)?;
    let started = Instant::now();
    let (mut count, mut losses, mut norms) = (0.0, 0.0, 0.0);
    let steps = settings.descent.steps;
    while run.optimiser.step < steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(LOOK) && watch.cancelled() {
            break;
        }
        let (loss, gradients) = gradients(&run, &examples)?;
        let norm = run.optimiser.update(&settings.descent, &gradients);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        (count, losses, norms) = (count + 1.0, losses + loss, norms + norm);
        let step = run.optimiser.step;
        watch.progress(step, steps);
        if step.is_multiple_of(settings.evaluate_every) || step == steps {
            let weights = weights(&run, examples.len());
            let score = score(&weights, &held_out);
            let bytes = weights.to_bytes()?;
            write_atomic(folder.join("last.safetensors"), &bytes)?;
            if run.best.is_none_or(|best| score.lift < best.lift) {
                run.best = Some(score);
                write_atomic(folder.join("best.safetensors"), &bytes)?;
            }
            let line = LeverLine {
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
    settings: &LeverSettings,
    examples: &[Example],
    path: &Path,
) -> Result<LeverCheckpoint, TrainError> {
    match fs::read(path) {
        Ok(bytes) => LeverCheckpoint::from_bytes(&bytes, settings)
            .map_err(|error| TrainError::Checkpoint(path.to_owned(), error)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let sizes = LeverInputs::sizes(settings.features, settings.prior, settings.width);
            let table = |of: &dyn Fn(&Example) -> &[f32]| -> Vec<f32> {
                examples.iter().flat_map(of).copied().collect()
            };
            let still = Statistics::measure(&table(&|e| &e.inputs.still), sizes.still, true);
            let moving = Statistics::measure(&table(&|e| &e.inputs.moving), sizes.moving, true);
            Ok(LeverCheckpoint {
                settings: settings.clone(),
                sizes,
                scales: [still, moving],
                optimiser: AdamW::new(fresh_lever(&sizes, settings.seed)),
                best: None,
            })
        }
        Err(error) => Err(TrainError::File(path.to_owned(), error)),
    }
}

fn save(run: &LeverCheckpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}

/// Loss and gradient of the next step.
fn gradients(run: &LeverCheckpoint, examples: &[Example]) -> Result<(f64, Parameters), TrainError> {
    let settings = &run.settings;
    let mut rng = generator(settings.seed, run.optimiser.step);
    let drawn: Vec<&Example> =
        (0..settings.batch).map(|_| &examples[rng.random_range(0..examples.len())]).collect();
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
    run: &LeverCheckpoint,
    examples: &[&Example],
) -> Result<(f64, Parameters), candle_core::Error> {
    let network = LeverGraph::new(&run.sizes, &run.optimiser.weights)?;
    let loss = Batch::new(examples, &run.scales)?.loss(&network)?;
    gradients_of(&loss, network.variables())
}

/// The averaged weights with their card.
fn weights(run: &LeverCheckpoint, episodes: usize) -> LeverWeights {
    let [still, moving] = run.scales.clone();
    LeverWeights {
        card: LeverCard {
            features: run.settings.features,
            prior: run.settings.prior,
            sizes: run.sizes,
            still,
            moving,
            episodes: episodes as u64,
            steps: run.optimiser.step,
        },
        parameters: run.optimiser.average.clone(),
    }
}

/// Errors of `weights` on held-out lever-ups; none where they cannot be used.
fn score(weights: &LeverWeights, held_out: &[&LeverEpisode]) -> LeverScore {
    let Ok(network) = LeverNetwork::new(weights) else { return LeverScore::default() };
    let jobs: Vec<LeverJob> = held_out.iter().map(|episode| episode.job()).collect();
    let share = 1.0 / jobs.len().max(1) as f64;
    let mut score = LeverScore::default();
    for ((episode, job), said) in held_out.iter().zip(&jobs).zip(network.rollout(&jobs)) {
        let error = lever_error(job, &episode.trajectory, &said);
        score.lift += share * error.lift;
        score.last += share * error.last;
        score.slips += share * f64::from(u8::from(error.same_slip));
        score.endings += share * f64::from(u8::from(error.same_ending));
    }
    score
}
