//! The loop: draw steps, differentiate on two replicas, step, score, save.

use std::{
    fs,
    path::{Path, PathBuf},
    time::Instant,
};

use candle_core::{Device, Result as CandleResult, Tensor};
use rayon::prelude::*;

use crate::dataset::LeverEpisode;
use crate::network::{Inputs, Predictor};
use crate::train::gradients::gradients_of;
use crate::train::log::Log;
use crate::train::{AdamW, TrainError, learning_rate};
use pushplan::internals::asset::write_atomic;
use pushplan::internals::effect::LeverParts;
use pushplan::internals::network::{
    Forward, Normaliser, PARTS, Parameters, PartsCard, PartsWeights,
};
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;

use super::super::replicas::{REPLICAS, mean_gradient};
use super::super::settings::LeverLine;
use super::super::trainer::{CHECKPOINT, LOOK, score};
use super::checkpoint::Checkpoint;
use super::examples::{Drawn, Examples};
use super::settings::PartsSettings;

/// Graphs on which the feature scales are measured.
const MEASURED: usize = 4096;

/// Distances below this, in units of what the network says, count less: 0.1 mm.
const NEAR: f64 = 0.02;

/// Trains in `folder` until the schedule ends or `watch` says to stop; goes on from the folder's
/// checkpoint if there is one. Returns the best weights, or `None` if stopped before the first
/// evaluation.
///
/// # Errors
/// [`TrainError`]; whatever was saved before stays.
pub fn train_parts(
    settings: &PartsSettings,
    episodes: &[LeverEpisode],
    held_out: &[LeverEpisode],
    folder: &FolderLock,
    watch: &dyn Watch,
) -> Result<Option<PathBuf>, TrainError> {
    gemm::set_threading_threshold(usize::MAX);
    let folder = folder.path();
    let mut examples = Examples::new(episodes, settings.prior);
    if examples.count() == 0 {
        return Err(TrainError::NoExamples);
    }
    let held_out: Vec<LeverEpisode> = held_out.iter().filter(|e| e.is_sound()).cloned().collect();
    let path = folder.join(CHECKPOINT);
    let mut run = open(settings, &examples, &path)?;
    if run.optimiser.step >= settings.evaluate_every {
        examples.visit(&forward(&run, &run.lead));
    }
    let mut log = Log::open(folder, run.optimiser.step)?;
    let started = Instant::now();
    let (mut count, mut losses, mut norms) = (0.0, 0.0, 0.0);
    let steps = settings.descent.steps;
    while run.optimiser.step < steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(LOOK) && watch.cancelled() {
            break;
        }
        let (loss, gradient) = gradients(&run, &examples)?;
        let norm = run.optimiser.update(&settings.descent, &gradient);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        (count, losses, norms) = (count + 1.0, losses + loss, norms + norm);
        let step = run.optimiser.step;
        watch.progress(step, steps);
        if step.is_multiple_of(settings.evaluate_every) || step == steps {
            let weights = weights(&run, examples.count());
            let score = score(&LeverParts::new(&weights), &held_out);
            let bytes = weights.to_bytes()?;
            write_atomic(folder.join("last.safetensors"), &bytes)?;
            if run.best.is_none_or(|best| score.lift < best.lift) {
                run.best = Some(score);
                write_atomic(folder.join("best.safetensors"), &bytes)?;
            }
            run.lead = run.optimiser.average.clone();
            examples.visit(&forward(&run, &run.lead));
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
    settings: &PartsSettings,
    examples: &Examples,
    path: &Path,
) -> Result<Checkpoint, TrainError> {
    match fs::read(path) {
        Ok(bytes) => Checkpoint::from_bytes(&bytes, settings)
            .map_err(|error| TrainError::Checkpoint(path.to_owned(), error)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let sample = examples.draw((settings.seed, u64::MAX / 2, 0), MEASURED);
            let first = Parameters::fresh_of(&PARTS, &settings.config, settings.seed);
            Ok(Checkpoint {
                settings: settings.clone(),
                normaliser: Normaliser::measure(&PARTS, sample.graphs.rows()),
                optimiser: AdamW::new(first.clone()),
                lead: first,
                best: None,
            })
        }
        Err(error) => Err(TrainError::File(path.to_owned(), error)),
    }
}

fn save(run: &Checkpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}

fn forward(run: &Checkpoint, parameters: &Parameters) -> Forward {
    Forward::of(&run.settings.config, &run.normaliser, parameters)
}

/// Loss and gradient of the next step.
fn gradients(run: &Checkpoint, examples: &Examples) -> Result<(f64, Parameters), TrainError> {
    let Checkpoint { settings, optimiser, .. } = run;
    let count = settings.batch.div_ceil(REPLICAS);
    let replica = |part: usize| {
        let drawn = examples.draw((settings.seed, optimiser.step, part as u64), count);
        let network = Predictor::of(&PARTS, settings.config, &optimiser.weights)?;
        gradients_of(&loss(run, &network, &drawn)?, network.variables())
    };
    let parts = (0..REPLICAS).into_par_iter().map(replica).collect::<CandleResult<Vec<_>>>()?;
    Ok(mean_gradient(parts))
}

/// Mean distance of what is said from what is wanted.
fn loss(run: &Checkpoint, network: &Predictor, drawn: &Drawn) -> CandleResult<Tensor> {
    let said = network.forward(&Inputs::new(drawn.graphs.rows(), &run.normaliser)?)?;
    let firsts = drawn.graphs.firsts();
    let said = said.index_select(&Tensor::new(firsts, &Device::Cpu)?, 0)?;
    let wanted = Tensor::from_slice(&drawn.wanted, (firsts.len(), 6), &Device::Cpu)?;
    ((said - wanted)?.sqr()?.sum(1)? + NEAR * NEAR)?.sqrt()?.mean_all()
}

/// The averaged weights with their card.
fn weights(run: &Checkpoint, episodes: usize) -> PartsWeights {
    PartsWeights {
        card: PartsCard {
            config: run.settings.config,
            prior: run.settings.prior,
            normaliser: run.normaliser.clone(),
            episodes: episodes as u64,
            steps: run.optimiser.step,
        },
        parameters: run.optimiser.average.clone(),
    }
}
