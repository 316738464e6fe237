//! The training loop: draw, differentiate on two replicas, step, evaluate, save.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pushplan::internals::asset::{Faults, write_atomic};
use pushplan::internals::effect::Network;
use pushplan::internals::network::{
    Card, ErrorCard, Forward, Normaliser, Parameters, Tables, Weights, WeightsError,
};
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;
use rayon::prelude::*;
use thiserror::Error;

use crate::dataset::{Dataset, DatasetError};
use crate::network::{Inputs, Predictor};

use super::example::Supervised;
use super::gradients::gradients_of;
use super::log::Log;
use super::loss::loss;
use super::{
    AdamW, Checkpoint, CheckpointError, Examples, HeldOutError, MetricLine, Settings,
    learning_rate, rollout_error,
};

/// A step's graphs are split into this many parts, differentiated in parallel and added in
/// order. Fixed, so that the bits do not depend on the number of threads; two, because the
/// machines this is made for have two cores.
const REPLICAS: usize = 2;

/// Graphs on which the feature scales are measured.
const NORMALISER_GRAPHS: usize = 4096;

/// Steps between refreshes of the network that leads up to examples (see `Noise::lead`), and
/// the steps at which a run can stop: there, going on needs nothing but the checkpoint.
const REFRESH: u64 = 50;

/// Why training stopped short.
#[derive(Debug, Error)]
pub enum TrainError {
    /// A file could not be read or written.
    #[error("{0}: {1}")]
    File(PathBuf, std::io::Error),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] Faults),
    /// The folder's checkpoint is no use.
    #[error("{0}: {1}")]
    Checkpoint(PathBuf, CheckpointError),
    /// The weights could not be encoded.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// The data could not be made or read.
    #[error(transparent)]
    Data(#[from] DatasetError),
    /// candle failed.
    #[error("the network failed: {0}")]
    Candle(#[from] candle_core::Error),
    /// The data contain no contact at all.
    #[error("no example: in none of the episodes does the tool come near an object")]
    NoExamples,
    /// Loss or gradient left the finite numbers.
    #[error(
        "loss or gradient became infinite or undefined at step {0}; the checkpoint before it is kept"
    )]
    NotFinite(u64),
}

/// Trains in `folder` until the schedule ends or `watch` says to stop; goes on from the folder's
/// checkpoint if there is one. Returns the best weights, or `None` if cancelled before the first evaluation.
///
/// # Errors
/// [`TrainError`]; whatever was saved before stays.
pub fn train(
    settings: &Settings,
    data: &Dataset,
    held_out: &Dataset,
    folder: &FolderLock,
    watch: &dyn Watch,
) -> Result<Option<PathBuf>, TrainError> {
    // Parallel matrix products inside parallel replicas only wait for each other.
    gemm::set_threading_threshold(usize::MAX);
    let folder = folder.path();
    let examples = Examples::new(data.episodes());
    if examples.count() == 0 {
        return Err(TrainError::NoExamples);
    }
    let mut run = open(settings, data, &examples, folder)?;
    let path = folder.join("checkpoint.safetensors");
    let mut log = Log::open(folder, run.optimiser.step)?;
    let started = Instant::now();
    let mut since = (Instant::now(), 0u64, 0.0f64, 0.0f64);
    let mut lead: Option<Forward> = None;
    while run.optimiser.step < settings.steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(REFRESH) {
            if watch.cancelled() {
                break;
            }
            lead = (settings.noise.lead > 0).then(|| Forward::new(&weights(&run, data, None)));
        }
        let (loss, gradients) = gradients(&run, &examples, lead.as_ref())?;
        let norm = run.optimiser.update(&settings.descent(), &gradients);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        since = (since.0, since.1 + 1, since.2 + loss, since.3 + norm);
        let step = run.optimiser.step;
        watch.progress(step, settings.steps);
        if step.is_multiple_of(settings.evaluate_every) || step == settings.steps {
            let model = Network::new(weights(&run, data, None));
            let error = rollout_error(&model, held_out.episodes(), step);
            let count = since.1 as f64;
            let line = MetricLine {
                step,
                loss: since.2 / count,
                gradient: since.3 / count,
                learning_rate: learning_rate(&settings.descent(), step),
                graphs_per_second: count * settings.batch as f64 / since.0.elapsed().as_secs_f64(),
                seconds: started.elapsed().as_secs_f64(),
                held_out: error.clone(),
            };
            let bytes = weights(&run, data, Some(&error)).to_bytes()?;
            write_atomic(folder.join("last.safetensors"), &bytes)?;
            if run.best.as_ref().is_none_or(|best| error.capped < best.capped) {
                run.best = Some(error);
                write_atomic(folder.join("best.safetensors"), &bytes)?;
            }
            log.write(&line)?;
            save(&run, &path)?;
            watch.line(&line.to_string());
            since = (Instant::now(), 0, 0.0, 0.0);
        }
    }
    save(&run, &path)?;
    Ok(run.best.is_some().then(|| folder.join("best.safetensors")))
}

/// Starts from scratch, or from the folder's checkpoint.
fn open(
    settings: &Settings,
    data: &Dataset,
    examples: &Examples<'_>,
    folder: &Path,
) -> Result<Checkpoint, TrainError> {
    let path = folder.join("checkpoint.safetensors");
    match fs::read(&path) {
        Ok(bytes) => {
            let run = Checkpoint::from_bytes(&bytes)
                .map_err(|e| TrainError::Checkpoint(path.clone(), e))?;
            run.fits(settings, data.config()).map_err(|e| TrainError::Checkpoint(path, e))?;
            Ok(run)
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let sample = examples.draw(
                &settings.noise,
                (settings.seed, u64::MAX, 0),
                0.0,
                NORMALISER_GRAPHS,
                None,
            );
            Ok(Checkpoint {
                settings: settings.clone(),
                data: data.config().clone(),
                normaliser: Normaliser::measure(&Tables::PUSHES, &sample.batch),
                optimiser: AdamW::new(Parameters::fresh(&settings.config, settings.seed)),
                best: None,
            })
        }
        Err(error) => Err(TrainError::File(path, error)),
    }
}

fn save(run: &Checkpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}

/// Loss and gradient of the next step, both per graph.
fn gradients(
    run: &Checkpoint,
    examples: &Examples<'_>,
    lead: Option<&Forward>,
) -> Result<(f64, Parameters), TrainError> {
    let settings = &run.settings;
    let parts = (0..REPLICAS as u64)
        .into_par_iter()
        .map(|part| {
            let key = (settings.seed, run.optimiser.step, part);
            let count = settings.batch / REPLICAS;
            let progress = run.optimiser.step as f64 / settings.steps as f64;
            let drawn = examples.draw(&settings.noise, key, progress, count, lead);
            replica(run, drawn)
        })
        .collect::<Result<Vec<_>, candle_core::Error>>()?;
    let mut parts = parts.into_iter();
    let Some((mut total, mut sum)) = parts.next() else {
        return Err(TrainError::NoExamples);
    };
    for (loss, gradient) in parts {
        total += loss;
        for (name, values) in &mut sum.values {
            for (s, g) in values.iter_mut().zip(&gradient.values[name]) {
                *s += g;
            }
        }
    }
    Ok((total, sum))
}

/// One replica's share of loss and gradient.
fn replica(run: &Checkpoint, drawn: Supervised) -> Result<(f64, Parameters), candle_core::Error> {
    let network = Predictor::new(run.settings.config, &run.optimiser.weights)?;
    let inputs = Inputs::new(&drawn.batch, &run.normaliser)?;
    let predicted = network.forward(&inputs)?;
    let loss = loss(&predicted, drawn.target, drawn.weight, run.settings.batch)?;
    gradients_of(&loss, network.variables())
}

/// The averaged weights with their card.
fn weights(run: &Checkpoint, data: &Dataset, error: Option<&HeldOutError>) -> Weights {
    let errors = error.and_then(|error| error.single.as_deref()).map(|single| ErrorCard {
        pushes: single.objects,
        mean: single.mean,
        median: single.median,
        p95: single.p95,
    });
    Weights {
        card: Card {
            config: run.settings.config,
            normaliser: run.normaliser.clone(),
            ranges: data.config().ranges(),
            data_seed: run.data.seed,
            episodes: run.data.episodes,
            steps: run.optimiser.step,
            errors,
        },
        parameters: run.optimiser.average.clone(),
    }
}
