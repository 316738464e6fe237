//! Training loop: gradients on two replicas, step, evaluation, checkpoint.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Instant;

use pushplan::internals::asset::{Faults, write_atomic};
use pushplan::internals::network::{Parameters, Weights, WeightsError};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;
use rayon::prelude::*;
use thiserror::Error;

use crate::dataset::DatasetError;

use super::log::Log;
use super::{Checkpoint, CheckpointError, Line, Trainable};

/// Number of parts of a step's examples, which are differentiated in parallel and added in order.
///
/// The number is fixed so that results do not depend on the number of threads. It is two because
/// the target machines have two cores.
pub const REPLICAS: usize = 2;

/// Number of steps between checks for cancellation.
const LOOK: u64 = 20;

/// File in a run's folder from which the run resumes.
const CHECKPOINT: &str = "checkpoint.safetensors";

/// File of the weights with the best held-out score.
pub const BEST: &str = "best.safetensors";

/// File of the weights of the last evaluation.
pub const LAST: &str = "last.safetensors";

/// Error that ends training.
#[derive(Debug, Error)]
pub enum TrainError {
    /// A file could not be read or written.
    #[error("{0}: {1}")]
    File(PathBuf, std::io::Error),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] Faults),
    /// The folder's checkpoint is unusable.
    #[error("{0}: {1}")]
    Checkpoint(PathBuf, CheckpointError),
    /// The weights could not be encoded.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// The data could not be made or read.
    #[error(transparent)]
    Data(#[from] DatasetError),
    /// An operation of candle failed.
    #[error("the network failed: {0}")]
    Candle(#[from] candle_core::Error),
    /// The data contain no examples.
    #[error("the episodes contain no training example")]
    NoExamples,
    /// Loss or gradient is no longer finite.
    #[error(
        "loss or gradient is infinite or undefined at step {0}; the previous checkpoint is kept"
    )]
    NotFinite(u64),
}

/// Training run in its folder.
///
/// The folder contains `checkpoint.safetensors` (the state for bit-exact resumption),
/// `metrics.jsonl`, `best.safetensors` (the weights with the best held-out score) and
/// `last.safetensors` (the weights of the last evaluation).
pub struct Trainer<'a, T: Trainable> {
    task: T,
    folder: &'a Path,
    run: Checkpoint<T>,
    log: Log,
    started: Instant,
    since: Since,
}

/// Sums since the last line.
struct Since {
    at: Instant,
    steps: f64,
    loss: f64,
    norm: f64,
}

impl<'a, T: Trainable> Trainer<'a, T> {
    /// Starts a new run, or resumes from the folder's checkpoint if there is one.
    ///
    /// # Errors
    /// Returns [`TrainError`] if there are no examples, or if the checkpoint is damaged or belongs
    /// to another run.
    pub fn open(task: T, folder: &'a FolderLock) -> Result<Self, TrainError> {
        if task.is_empty() {
            return Err(TrainError::NoExamples);
        }
        // Parallel matrix products inside parallel replicas would wait for each other.
        gemm::set_threading_threshold(usize::MAX);
        let folder = folder.path();
        let path = folder.join(CHECKPOINT);
        let run = match fs::read(&path) {
            Ok(bytes) => Checkpoint::from_bytes(&task, &bytes)
                .map_err(|error| TrainError::Checkpoint(path, error))?,
            Err(error) if error.kind() == ErrorKind::NotFound => Checkpoint::fresh(&task),
            Err(error) => return Err(TrainError::File(path, error)),
        };
        let log = Log::open(folder, run.optimiser.step)?;
        Ok(Self { task, folder, run, log, started: Instant::now(), since: Since::now() })
    }

    /// Trains until the schedule ends or `progress` cancels.
    ///
    /// Returns the file of the best weights, or `None` if stopped before the first evaluation.
    ///
    /// # Errors
    /// Returns [`TrainError`]; files saved before are kept.
    pub fn run(mut self, progress: &dyn Progress) -> Result<Option<PathBuf>, TrainError> {
        let descent = self.task.descent();
        let mut followed = false;
        while self.run.optimiser.step < descent.steps {
            let step = self.run.optimiser.step;
            if step.is_multiple_of(LOOK) && progress.cancelled() {
                break;
            }
            if self.task.refreshes(step) {
                self.run.lead = Some(self.run.optimiser.average.clone());
                followed = false;
            }
            if let (Some(lead), false) = (&self.run.lead, followed) {
                self.task.follow(lead, &self.run.scales);
                followed = true;
            }
            let (loss, gradient) = self.gradient()?;
            let norm = self.run.optimiser.update(&descent, &gradient);
            if !loss.is_finite() || !norm.is_finite() {
                return Err(TrainError::NotFinite(step));
            }
            let Since { at, steps, loss: losses, norm: norms } = self.since;
            self.since = Since { at, steps: steps + 1.0, loss: losses + loss, norm: norms + norm };
            let step = self.run.optimiser.step;
            progress.update(step, descent.steps);
            if step.is_multiple_of(descent.evaluate_every) || step == descent.steps {
                progress.line(&self.evaluate()?);
            }
        }
        self.save()?;
        Ok(self.run.best.is_some().then(|| self.folder.join(BEST)))
    }

    /// Returns the mean loss and gradient of the next step.
    fn gradient(&self) -> Result<(f64, Parameters), TrainError> {
        let (task, Checkpoint { scales, optimiser, .. }) = (&self.task, &self.run);
        let replica = |k| task.gradient(&optimiser.weights, scales, (optimiser.step, k));
        let parts = (0..REPLICAS)
            .into_par_iter()
            .map(replica)
            .collect::<Result<Vec<_>, candle_core::Error>>()?;
        let share = 1.0 / REPLICAS as f32;
        let (mut total, mut sum) = (0.0, Parameters::default());
        for (loss, gradient) in parts {
            total += loss * f64::from(share);
            for (name, values) in gradient.values {
                let sum = sum.values.entry(name).or_insert_with(|| vec![0.0; values.len()]);
                sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += share * value);
            }
        }
        Ok((total, sum))
    }

    /// Evaluates the averaged weights, saves all files and returns the line for the progress
    /// display.
    fn evaluate(&mut self) -> Result<String, TrainError> {
        let (step, descent) = (self.run.optimiser.step, self.task.descent());
        let score = self.task.score(&self.weights(None));
        let bytes = self.weights(Some(&score)).to_bytes()?;
        write_atomic(self.folder.join(LAST), &bytes)?;
        if self.run.best.as_ref().is_none_or(|best| T::is_better(&score, best)) {
            self.run.best = Some(score.clone());
            write_atomic(self.folder.join(BEST), &bytes)?;
        }
        let Since { at, steps, loss, norm } = std::mem::replace(&mut self.since, Since::now());
        let line = Line {
            step,
            loss: loss / steps,
            gradient: norm / steps,
            learning_rate: descent.learning_rate(step),
            examples_per_second: steps * descent.batch as f64 / at.elapsed().as_secs_f64(),
            seconds: self.started.elapsed().as_secs_f64(),
            held_out: score,
        };
        self.log.write(&line)?;
        self.save()?;
        Ok(line.to_string())
    }

    /// Returns the averaged weights with their card.
    fn weights(&self, score: Option<&T::Score>) -> Weights<T::Card> {
        let Checkpoint { scales, optimiser, .. } = &self.run;
        Weights {
            card: self.task.card(scales, optimiser.step, score),
            parameters: optimiser.average.clone(),
        }
    }

    fn save(&self) -> Result<(), TrainError> {
        let path = self.folder.join(CHECKPOINT);
        let bytes = self.run.to_bytes(&self.task);
        let bytes = bytes.map_err(|error| TrainError::Checkpoint(path.clone(), error))?;
        Ok(write_atomic(path, &bytes)?)
    }
}

impl Since {
    fn now() -> Self {
        Self { at: Instant::now(), steps: 0.0, loss: 0.0, norm: 0.0 }
    }
}
