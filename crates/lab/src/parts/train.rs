//! Training of the network of parts.

use std::path::PathBuf;

use candle_core::{Device, Result, Tensor};
use pushplan::internals::network::{Forward, Normaliser, Parameters};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::LeverEpisode;
use pushplan_learn::network::{Inputs, Predictor};
use pushplan_learn::train::{
    Descent, LeverScore, REPLICAS, TrainError, Trainable, Trainer, gradients_of, lever_score,
};

use super::examples::{Drawn, Examples};
use super::{LeverParts, PARTS, PartsCard, PartsSettings, PartsWeights};

/// Number of graphs on which the feature scales are measured.
const MEASURED: usize = 4096;

/// Distance below which errors have less weight, in units of the network's output: 0.1 mm.
const NEAR: f64 = 0.02;

/// Trains in `folder`, see [`Trainer::run`].
///
/// # Errors
/// Returns a [`TrainError`]; files saved before remain.
pub fn train_parts(
    settings: &PartsSettings,
    episodes: &[LeverEpisode],
    held_out: &[LeverEpisode],
    folder: &FolderLock,
    progress: &dyn Progress,
) -> std::result::Result<Option<PathBuf>, TrainError> {
    let examples = Examples::new(episodes, settings.prior);
    let held_out = held_out.iter().filter(|episode| episode.is_sound()).cloned().collect();
    Trainer::open(Task { settings, examples, held_out }, folder)?.run(progress)
}

struct Task<'a> {
    settings: &'a PartsSettings,
    examples: Examples,
    held_out: Vec<LeverEpisode>,
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-parts-checkpoint";
    type Settings = PartsSettings;
    type Scales = Normaliser;
    type Score = LeverScore;
    type Card = PartsCard;

    fn settings(&self) -> PartsSettings {
        self.settings.clone()
    }

    fn descent(&self) -> Descent {
        self.settings.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.count() == 0
    }

    fn scales(&self) -> Normaliser {
        let sample = self.examples.draw((self.settings.seed, u64::MAX / 2, 0), MEASURED);
        Normaliser::measure(&PARTS, sample.graphs.rows())
    }

    fn fresh(&self, _: &Normaliser) -> Parameters {
        Parameters::fresh_of(&PARTS, &self.settings.config, self.settings.seed)
    }

    fn gradient(
        &self,
        weights: &Parameters,
        scales: &Normaliser,
        (step, replica): (u64, usize),
    ) -> Result<(f64, Parameters)> {
        let PartsSettings { config, seed, descent, .. } = *self.settings;
        let drawn = self.examples.draw((seed, step, replica as u64), descent.batch / REPLICAS);
        let network = Predictor::of(&PARTS, config, weights)?;
        gradients_of(&loss(scales, &network, &drawn)?, network.variables())
    }

    fn score(&self, weights: &PartsWeights) -> LeverScore {
        lever_score(&LeverParts::new(weights), &self.held_out)
    }

    fn is_better(score: &LeverScore, than: &LeverScore) -> bool {
        score.lift < than.lift
    }

    fn card(&self, scales: &Normaliser, step: u64, _: Option<&LeverScore>) -> PartsCard {
        PartsCard {
            config: self.settings.config,
            prior: self.settings.prior,
            normaliser: scales.clone(),
            episodes: self.examples.count() as u64,
            steps: step,
        }
    }

    /// Before the first evaluation all examples begin at the ground truth.
    fn refreshes(&self, step: u64) -> bool {
        step > 0 && step.is_multiple_of(self.settings.descent.evaluate_every)
    }

    fn follow(&mut self, lead: &Parameters, scales: &Normaliser) {
        self.examples.visit(&Forward::of(&self.settings.config, scales, lead));
    }
}

/// Returns the mean distance between outputs and targets.
fn loss(scales: &Normaliser, network: &Predictor, drawn: &Drawn) -> Result<Tensor> {
    let predicted = network.forward(&Inputs::new(drawn.graphs.rows(), scales)?)?;
    let firsts = drawn.graphs.firsts();
    let predicted = predicted.index_select(&Tensor::new(firsts, &Device::Cpu)?, 0)?;
    let wanted = Tensor::from_slice(&drawn.wanted, (firsts.len(), 6), &Device::Cpu)?;
    ((predicted - wanted)?.sqr()?.sum(1)? + NEAR * NEAR)?.sqrt()?.mean_all()
}
