//! Training of a network with image input.

use std::path::PathBuf;

use pushplan::internals::network::{Parameters, Statistics};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::LeverEpisode;
use pushplan_learn::train::{
    Descent, LeverBatch, LeverExample, LeverScore, LeverSettings, TrainError, Trainable, Trainer,
    drawn, gradients_of, lever_score,
};
use serde::{Deserialize, Serialize};

use super::autoencoder::code;
use super::example::{Seen, images};
use super::{
    CODE, ImageCard, ImageFeatures, ImageGraph, ImageNetwork, ImageSizes, ImageWeights, fresh_image,
};

/// Settings that determine a training run, except its episodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageSettings {
    /// Images that the network sees.
    pub features: ImageFeatures,
    /// Other settings; their `features` must be
    /// [`Nothing`](pushplan::internals::scene::LeverFeatures).
    pub memory: LeverSettings,
}

impl ImageSettings {
    /// Returns the extents of the image.
    pub fn image(&self) -> ImageSizes {
        let [rows, columns] = self.features.extents();
        ImageSizes { rows, columns, code: CODE }
    }
}

/// Trains in `folder`, see [`Trainer::run`]. For [`ImageFeatures::ImageCode`], an autoencoder is
/// trained first, in as many steps.
///
/// # Errors
/// Returns a [`TrainError`]; files saved before remain.
pub fn train_image(
    settings: &ImageSettings,
    episodes: &[LeverEpisode],
    held_out: &[LeverEpisode],
    folder: &FolderLock,
    progress: &dyn Progress,
) -> Result<Option<PathBuf>, TrainError> {
    let examples = Seen::all(settings, episodes);
    let code = if settings.features == ImageFeatures::ImageCode {
        let judged = Seen::all(settings, held_out);
        let Some(code) = code(settings, (&examples, &judged), folder, progress)? else {
            return Ok(None);
        };
        code
    } else {
        Parameters::default()
    };
    let held_out = settings.memory.judged_on(held_out);
    Trainer::open(Task { settings, examples, code, held_out }, folder)?.run(progress)
}

struct Task<'a> {
    settings: &'a ImageSettings,
    examples: Vec<Seen>,
    /// Convolution parameters of a trained autoencoder; empty without one.
    code: Parameters,
    held_out: Vec<LeverEpisode>,
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-lever-image-checkpoint";
    type Settings = ImageSettings;
    /// Scales of the features of a lever-up, and of a frame.
    type Scales = [Statistics; 2];
    type Score = LeverScore;
    type Card = ImageCard;

    fn settings(&self) -> ImageSettings {
        self.settings.clone()
    }

    fn descent(&self) -> Descent {
        self.settings.memory.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.is_empty()
    }

    fn scales(&self) -> [Statistics; 2] {
        let examples = self.examples.iter().map(|seen| &seen.example);
        LeverExample::scales(examples, &self.settings.memory.sizes())
    }

    fn fresh(&self, _: &[Statistics; 2]) -> Parameters {
        let (memory, image) = (&self.settings.memory, self.settings.image());
        let mut fresh = fresh_image(&memory.sizes(), &image, memory.seed);
        for (name, values) in &mut fresh.values {
            if let Some(learned) = self.code.values.get(name) {
                values.clone_from(learned);
            }
        }
        fresh
    }

    fn gradient(
        &self,
        weights: &Parameters,
        scales: &[Statistics; 2],
        (step, replica): (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)> {
        let (memory, image) = (&self.settings.memory, self.settings.image());
        let drawn = drawn(&self.examples, memory.descent.batch, (memory.seed, step, replica));
        let sizes = memory.sizes();
        let as_it_is = self.settings.features == ImageFeatures::ImageCode;
        let graph = ImageGraph::new((&sizes, &image), weights, as_it_is)?;
        let contribution = graph.contribution(&images(&drawn, &image)?)?;
        let examples: Vec<&LeverExample> = drawn.iter().map(|seen| &seen.example).collect();
        let batch = LeverBatch::new(&examples, scales, &sizes)?;
        gradients_of(&batch.loss(graph.memory(), Some(&contribution))?, graph.variables())
    }

    fn score(&self, weights: &ImageWeights) -> LeverScore {
        // Weights that cannot be used have no error.
        let network = ImageNetwork::new(weights);
        network.map_or_else(|_| LeverScore::default(), |one| lever_score(&one, &self.held_out))
    }

    fn is_better(score: &LeverScore, than: &LeverScore) -> bool {
        score.lift < than.lift
    }

    fn card(&self, scales: &[Statistics; 2], step: u64, _: Option<&LeverScore>) -> ImageCard {
        ImageCard {
            features: self.settings.features,
            image: self.settings.image(),
            memory: self.settings.memory.card(scales.clone(), self.examples.len(), step),
        }
    }
}
