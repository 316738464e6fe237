//! Training task of the physics predictor.

use std::path::{Path, PathBuf};

use pushplan::internals::asset::write_atomic;
use pushplan::internals::effect::{Network, PRIOR_RANGES};
use pushplan::internals::network::{
    ErrorCard, Normaliser, Parameters, PredictorCard, PredictorWeights, Source, Tables,
};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;

use crate::dataset::{Dataset, DatasetConfig, Truth};
use crate::network::{Inputs, Predictor};
use crate::train::{BEST, Descent, LAST, REPLICAS, TrainError, Trainable, Trainer, gradients_of};

use super::doubt::fit_doubt;
use super::loss::loss;
use super::share::shared;
use super::{Examples, HeldOutError, PredictorSettings, rollout_error};

/// Number of pushes on which the feature scales are measured.
const NORMALISER_PUSHES: usize = 1024;

/// Relative frequencies of crowds, of which there are few, and of MuJoCo's pushes.
const CROWDS: f64 = 0.3;
const MUJOCO: f64 = 0.5;

/// Trains a network in `folder`, see [`Trainer::run`].
///
/// # Errors
/// Returns [`TrainError`]; files saved before are kept.
pub fn train_predictor(
    settings: &PredictorSettings,
    data: &[Dataset],
    held_out: &[Dataset],
    folder: &FolderLock,
    progress: &dyn Progress,
) -> Result<Option<PathBuf>, TrainError> {
    let examples = Examples::new(data.iter().map(|set| (set, weight(set))));
    let task = Task { settings, data, held_out, examples };
    let best = Trainer::open(task, folder)?.run(progress)?;
    for name in [BEST, LAST] {
        finish(&folder.path().join(name), settings.descent.steps, (data, held_out), progress)?;
    }
    Ok(best)
}

/// Completes the weights in a file after the schedule: scales their correction and adds their
/// predicted error.
fn finish(
    path: &Path,
    steps: u64,
    (data, held_out): (&[Dataset], &[Dataset]),
    progress: &dyn Progress,
) -> Result<(), TrainError> {
    let Ok(weights) = PredictorWeights::load(path) else { return Ok(()) };
    let last = path.with_file_name(LAST);
    let done = PredictorWeights::load(last).is_ok_and(|last| last.card.steps >= steps);
    if done && weights.card.doubt.is_none() {
        let (mut weights, share) = shared(&weights, held_out, progress);
        weights.card.share = share;
        fit_doubt(&mut weights, data);
        write_atomic(path, &weights.to_bytes()?)?;
        progress.line(&format!("{}: the correction is scaled by {share}", path.display()));
    }
    Ok(())
}

/// Returns the relative frequency of examples from this set.
fn weight(set: &Dataset) -> f64 {
    match set.config() {
        config if config.preset.is_crowd() => CROWDS,
        config if config.truth == Truth::Mujoco => MUJOCO,
        _ => 1.0,
    }
}

fn source(set: &Dataset) -> Source {
    let DatasetConfig { seed, episodes, .. } = *set.config();
    Source { truth: set.config().played_by(), seed, episodes, digest: set.digest() }
}

struct Task<'a> {
    settings: &'a PredictorSettings,
    data: &'a [Dataset],
    held_out: &'a [Dataset],
    examples: Examples,
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-checkpoint";
    type Settings = (PredictorSettings, Vec<DatasetConfig>);
    type Scales = Normaliser;
    type Score = HeldOutError;
    type Card = PredictorCard;

    fn settings(&self) -> Self::Settings {
        (self.settings.clone(), self.data.iter().map(|set| set.config().clone()).collect())
    }

    fn descent(&self) -> Descent {
        self.settings.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.count() == 0
    }

    fn scales(&self) -> Normaliser {
        let Self { settings, examples, .. } = self;
        let sample = examples.draw((settings.seed, u64::MAX, 0), NORMALISER_PUSHES);
        Normaliser::measure(&Tables::PUSHES, &sample.batch)
    }

    fn fresh(&self, _: &Normaliser) -> Parameters {
        Parameters::fresh(&self.settings.config, self.settings.seed)
    }

    fn gradient(
        &self,
        weights: &Parameters,
        scales: &Normaliser,
        (step, replica): (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)> {
        let PredictorSettings { config, seed, descent } = *self.settings;
        let count = descent.batch / REPLICAS;
        let drawn = self.examples.draw((seed, step, replica as u64), count);
        let network = Predictor::new(config, weights)?;
        let outputs = network.forward(&Inputs::new(&drawn.batch, scales)?)?;
        let loss = loss(&outputs, &drawn, count)?;
        gradients_of(&loss, network.variables())
    }

    fn score(&self, weights: &PredictorWeights) -> HeldOutError {
        rollout_error(&Network::new(weights.clone()), self.held_out)
    }

    fn is_better(score: &HeldOutError, than: &HeldOutError) -> bool {
        score.capped < than.capped
    }

    fn card(&self, scales: &Normaliser, step: u64, score: Option<&HeldOutError>) -> PredictorCard {
        let ranges = self.data.iter().map(|set| set.config().ranges());
        let single = score.and_then(|score| score.single.as_deref());
        PredictorCard {
            config: self.settings.config,
            normaliser: scales.clone(),
            ranges: ranges.reduce(|a, b| a.hull(&b)).unwrap_or(PRIOR_RANGES),
            sources: self.data.iter().map(source).collect(),
            steps: step,
            errors: single.map(|single| ErrorCard {
                pushes: single.objects,
                mean: single.mean,
                median: single.median,
                p95: single.p95,
            }),
            share: 1.0,
            row_scale: 1.0,
            doubt: None,
        }
    }
}
