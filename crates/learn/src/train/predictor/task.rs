//! What the trainer asks of the physics predictor.

use std::path::PathBuf;

use pushplan::internals::effect::Network;
use pushplan::internals::network::{
    ErrorCard, Forward, Normaliser, Parameters, PredictorCard, PredictorWeights, Tables,
};
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;

use crate::dataset::{Dataset, DatasetConfig};
use crate::network::{Inputs, Predictor};
use crate::train::{Descent, REPLICAS, TrainError, Trainable, Trainer, gradients_of};

use super::loss::loss;
use super::{Examples, HeldOutError, PredictorSettings, rollout_error};

/// Graphs on which the feature scales are measured.
const NORMALISER_GRAPHS: usize = 4096;

/// Steps between refreshes of the network that leads up to examples (see `Noise::lead`).
const REFRESH: u64 = 50;

/// Trains in `folder`, see [`Trainer::run`].
///
/// # Errors
/// [`TrainError`]; whatever was saved before stays.
pub fn train_predictor(
    settings: &PredictorSettings,
    data: &Dataset,
    held_out: &Dataset,
    folder: &FolderLock,
    watch: &dyn Watch,
) -> Result<Option<PathBuf>, TrainError> {
    let examples = Examples::new(data.episodes());
    let task = Task { settings, data, held_out, examples, lead: None };
    Trainer::open(task, folder)?.run(watch)
}

struct Task<'a> {
    settings: &'a PredictorSettings,
    data: &'a Dataset,
    held_out: &'a Dataset,
    examples: Examples<'a>,
    /// What leads up to examples.
    lead: Option<Forward>,
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-checkpoint";
    type Settings = (PredictorSettings, DatasetConfig);
    type Scales = Normaliser;
    type Score = HeldOutError;
    type Card = PredictorCard;

    fn settings(&self) -> Self::Settings {
        (self.settings.clone(), self.data.config().clone())
    }

    fn descent(&self) -> Descent {
        self.settings.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.count() == 0
    }

    fn scales(&self) -> Normaliser {
        let Self { settings, examples, .. } = self;
        let key = (settings.seed, u64::MAX, 0);
        let sample = examples.draw(&settings.noise, key, 0.0, NORMALISER_GRAPHS, None);
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
        let PredictorSettings { config, seed, ref noise, descent, .. } = *self.settings;
        let (key, progress) = ((seed, step, replica as u64), step as f64 / descent.steps as f64);
        let count = descent.batch / REPLICAS;
        let drawn = self.examples.draw(noise, key, progress, count, self.lead.as_ref());
        let network = Predictor::new(config, weights)?;
        let predicted = network.forward(&Inputs::new(&drawn.batch, scales)?)?;
        let loss = loss(&predicted, drawn.target, drawn.weight, count)?;
        gradients_of(&loss, network.variables())
    }

    fn score(&self, weights: &PredictorWeights) -> HeldOutError {
        rollout_error(&Network::new(weights.clone()), self.held_out.episodes())
    }

    fn is_better(score: &HeldOutError, than: &HeldOutError) -> bool {
        score.capped < than.capped
    }

    fn card(&self, scales: &Normaliser, step: u64, score: Option<&HeldOutError>) -> PredictorCard {
        let data = self.data.config();
        let single = score.and_then(|score| score.single.as_deref());
        PredictorCard {
            config: self.settings.config,
            normaliser: scales.clone(),
            ranges: data.ranges(),
            data_seed: data.seed,
            episodes: data.episodes,
            steps: step,
            errors: single.map(|single| ErrorCard {
                pushes: single.objects,
                mean: single.mean,
                median: single.median,
                p95: single.p95,
            }),
        }
    }

    fn refreshes(&self, step: u64) -> bool {
        self.settings.noise.lead > 0 && step.is_multiple_of(REFRESH)
    }

    fn follow(&mut self, lead: &Parameters, scales: &Normaliser) {
        self.lead = Some(Forward::of(&self.settings.config, scales, lead));
    }
}
