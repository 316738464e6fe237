//! Training task of lever-up networks.

use std::path::PathBuf;

use crate::lever_model::LeverModel;
use pushplan::internals::effect::LeverNetwork;
use pushplan::internals::network::{LeverCard, LeverWeights, Parameters, Statistics, fresh_lever};
use pushplan::internals::progress::Progress;
use pushplan::internals::seeded::generator;
use pushplan::internals::task::LeverJob;
use pushplan_bench::store::FolderLock;
use rand::Rng;

use crate::dataset::LeverEpisode;
use crate::judge::lever_error;
use crate::network::LeverGraph;
use crate::train::{Descent, REPLICAS, TrainError, Trainable, Trainer, gradients_of};

use super::{LeverBatch, LeverExample, LeverScore, LeverSettings};

/// Trains a network in `folder`, see [`Trainer::run`].
///
/// # Errors
/// Returns [`TrainError`]; files saved before are kept.
pub fn train_lever(
    settings: &LeverSettings,
    episodes: &[LeverEpisode],
    held_out: &[LeverEpisode],
    folder: &FolderLock,
    progress: &dyn Progress,
) -> Result<Option<PathBuf>, TrainError> {
    let examples = LeverExample::all(settings, episodes);
    let held_out = settings.judged_on(held_out);
    Trainer::open(Task { settings, examples, held_out }, folder)?.run(progress)
}

struct Task<'a> {
    settings: &'a LeverSettings,
    examples: Vec<LeverExample>,
    held_out: Vec<LeverEpisode>,
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-lever-checkpoint";
    type Settings = LeverSettings;
    /// Feature scales per lever-up and per frame.
    type Scales = [Statistics; 2];
    type Score = LeverScore;
    type Card = LeverCard;

    fn settings(&self) -> LeverSettings {
        self.settings.clone()
    }

    fn descent(&self) -> Descent {
        self.settings.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.is_empty()
    }

    fn scales(&self) -> [Statistics; 2] {
        LeverExample::scales(self.examples.iter(), &self.settings.sizes())
    }

    fn fresh(&self, _: &[Statistics; 2]) -> Parameters {
        fresh_lever(&self.settings.sizes(), self.settings.seed)
    }

    fn gradient(
        &self,
        weights: &Parameters,
        scales: &[Statistics; 2],
        (step, replica): (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)> {
        let LeverSettings { seed, descent, .. } = *self.settings;
        let drawn = drawn(&self.examples, descent.batch, (seed, step, replica));
        let sizes = self.settings.sizes();
        let network = LeverGraph::new(&sizes, weights)?;
        let loss = LeverBatch::new(&drawn, scales, &sizes)?.loss(&network, None)?;
        gradients_of(&loss, network.variables())
    }

    fn score(&self, weights: &LeverWeights) -> LeverScore {
        // Unusable weights have zero error.
        let network = LeverNetwork::new(weights);
        network.map_or_else(|_| LeverScore::default(), |network| score(&network, &self.held_out))
    }

    fn is_better(score: &LeverScore, than: &LeverScore) -> bool {
        score.lift < than.lift
    }

    fn card(&self, scales: &[Statistics; 2], step: u64, _: Option<&LeverScore>) -> LeverCard {
        self.settings.card(scales.clone(), self.examples.len(), step)
    }
}

/// Returns one replica's share of `batch` examples, which depends only on seed, step and replica.
pub fn drawn<T>(examples: &[T], batch: usize, (seed, step, replica): (u64, u64, usize)) -> Vec<&T> {
    let mut rng = generator(seed, step);
    let all = (0..batch).map(|_| &examples[rng.random_range(0..examples.len())]);
    let (from, to) = (replica * batch / REPLICAS, (replica + 1) * batch / REPLICAS);
    all.take(to).skip(from).collect()
}

/// Computes the errors of a network on held-out lever-ups.
pub fn score(network: &dyn LeverModel, held_out: &[LeverEpisode]) -> LeverScore {
    let jobs: Vec<LeverJob> = held_out.iter().map(|episode| episode.job()).collect();
    let share = 1.0 / jobs.len().max(1) as f64;
    let mut score = LeverScore::default();
    for ((episode, job), predicted) in held_out.iter().zip(&jobs).zip(network.rollout(&jobs)) {
        let error = lever_error(job, &episode.trajectory, &predicted);
        score.lift += share * error.lift;
        score.last += share * error.last;
        score.slips += share * f64::from(u8::from(error.same_slip));
        score.endings += share * f64::from(u8::from(error.same_ending));
    }
    score
}
