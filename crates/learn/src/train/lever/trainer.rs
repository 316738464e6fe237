//! The loop: draw lever-ups, differentiate on two replicas, step, score, save.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pushplan::internals::asset::write_atomic;
use pushplan::internals::effect::{LeverModel, LeverNetwork};
use pushplan::internals::network::{LeverCard, LeverWeights, Parameters, Statistics, fresh_lever};
use pushplan::internals::scene::{LeverFeatures, LeverJob};
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;

use crate::dataset::LeverEpisode;
use crate::judge::lever_error;
use crate::network::LeverGraph;
use crate::train::gradients::gradients_of;
use crate::train::log::Log;
use crate::train::{AdamW, TrainError, learning_rate};

use super::autoencoder::code;
use super::batch::{Batch, Example, examples};
use super::replicas::gradients;
use super::settings::LeverScore;
use super::{LeverCheckpoint, LeverLine, LeverSettings};

/// The file in a run's folder from which it goes on.
pub(super) const CHECKPOINT: &str = "checkpoint.safetensors";

/// Steps after which a run looks whether it is to stop.
pub(super) const LOOK: u64 = 20;

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
    let held_out: Vec<LeverEpisode> = held_out
        .iter()
        .filter(|episode| episode.is_sound())
        .filter_map(|held| if settings.cut { held.before_slip() } else { Some(held.clone()) })
        .collect();
    let path = folder.join(CHECKPOINT);
    let Some(mut run) = open(settings, &examples, folder, watch)? else { return Ok(None) };
    let mut log = Log::open(folder, run.optimiser.step)?;
    let started = Instant::now();
    let (mut count, mut losses, mut norms) = (0.0, 0.0, 0.0);
    let steps = settings.descent.steps;
    while run.optimiser.step < steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(LOOK) && watch.cancelled() {
            break;
        }
        let (loss, gradient) = next(&run, &examples)?;
        let norm = run.optimiser.update(&settings.descent, &gradient);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        (count, losses, norms) = (count + 1.0, losses + loss, norms + norm);
        let step = run.optimiser.step;
        watch.progress(step, steps);
        if step.is_multiple_of(settings.evaluate_every) || step == steps {
            let weights = weights(&run, examples.len());
            // Weights that cannot be used have no error.
            let network = LeverNetwork::new(&weights);
            let score = network.map_or_else(|_| LeverScore::default(), |n| score(&n, &held_out));
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

/// Starts from scratch, or from the checkpoint in `folder`; `None` if `watch` said to stop before
/// there was anything to start from.
fn open(
    settings: &LeverSettings,
    examples: &[Example],
    folder: &Path,
    watch: &dyn Watch,
) -> Result<Option<LeverCheckpoint>, TrainError> {
    let path = folder.join(CHECKPOINT);
    match fs::read(&path) {
        Ok(bytes) => match LeverCheckpoint::from_bytes(&bytes, settings) {
            Ok(run) => Ok(Some(run)),
            Err(error) => Err(TrainError::Checkpoint(path, error)),
        },
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let sizes = settings.sizes();
            let mut weights = fresh_lever(&sizes, settings.seed);
            if let (LeverFeatures::ImageCode, Some(image)) = (settings.features, &sizes.image) {
                match code(settings, image, examples, folder, watch)? {
                    Some(code) => weights.values.iter_mut().for_each(|(name, values)| {
                        if let Some(learned) = code.values.get(name) {
                            values.clone_from(learned);
                        }
                    }),
                    None => return Ok(None),
                }
            }
            let table = |of: &dyn Fn(&Example) -> &[f32]| -> Vec<f32> {
                examples.iter().flat_map(of).copied().collect()
            };
            let still = Statistics::measure(&table(&|e| &e.inputs.still), sizes.still, true);
            let moving = Statistics::measure(&table(&|e| &e.inputs.moving), sizes.moving, true);
            Ok(Some(LeverCheckpoint {
                settings: settings.clone(),
                sizes,
                scales: [still, moving],
                optimiser: AdamW::new(weights),
                best: None,
            }))
        }
        Err(error) => Err(TrainError::File(path, error)),
    }
}

fn save(run: &LeverCheckpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}

/// Loss and gradient of the next step.
fn next(run: &LeverCheckpoint, examples: &[Example]) -> Result<(f64, Parameters), TrainError> {
    let LeverCheckpoint { settings, sizes, scales, optimiser, .. } = run;
    gradients((settings.seed, optimiser.step), examples, settings.batch, |part| {
        let network = if settings.features == LeverFeatures::ImageCode {
            LeverGraph::with_image_as_it_is(sizes, &optimiser.weights)?
        } else {
            LeverGraph::new(sizes, &optimiser.weights)?
        };
        let loss = Batch::new(part, scales, sizes)?.loss(&network)?;
        gradients_of(&loss, network.variables())
    })
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

/// Errors of a network on held-out lever-ups.
pub(super) fn score(network: &dyn LeverModel, held_out: &[LeverEpisode]) -> LeverScore {
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
