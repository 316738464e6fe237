//! An autoencoder that codes images without data of lever-ups, trained before the network itself.

use std::fmt;

use candle_core::{Result as CandleResult, Tensor};
use pushplan::internals::network::{Card, Layout, Parameters, Weights, WeightsError, check_widths};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::DatasetError;
use pushplan_learn::train::{Descent, TrainError, Trainable, Trainer, drawn, gradients_of};
use serde::{Deserialize, Serialize};

use super::example::{Seen, images};
use super::{Autoencoder, ImageSettings, ImageSizes, autoencoder_layout, fresh_autoencoder};

/// Seed offset, so that images are drawn differently from lever-ups.
const IMAGES: u64 = 0x494d_4147;

/// Number of images evaluated at once.
const AT_ONCE: usize = 64;

/// Trains an autoencoder of the images of `settings` in the folder `code` of a run, and returns its
/// weights. It trains on the first and is evaluated on the second images, in as many steps as the
/// network itself, and resumes from its own checkpoint there. Returns `None` if `progress`
/// cancelled the training.
///
/// # Errors
/// Returns a [`TrainError`]; files saved before remain.
pub(super) fn code(
    settings: &ImageSettings,
    (examples, held_out): (&[Seen], &[Seen]),
    folder: &FolderLock,
    progress: &dyn Progress,
) -> Result<Option<Parameters>, TrainError> {
    let path = folder.path().join("code");
    let folder = FolderLock::take(&path, progress).map_err(DatasetError::from)?;
    Trainer::open(Task { settings, examples, held_out }, &folder)?.run(progress)?;
    let last = match Weights::<CodeCard>::load(path.join("last.safetensors")) {
        Err(WeightsError::Unreadable(_)) => return Ok(None),
        last => last?,
    };
    let whole = last.card.steps == settings.memory.descent.steps;
    Ok(whole.then_some(last.parameters))
}

/// Metadata of the weights of an autoencoder.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct CodeCard {
    image: ImageSizes,
    steps: u64,
}

impl Card for CodeCard {
    const KEY: &'static str = "pushplan-lever-code";
    const FORMAT: u32 = 1;

    fn check(&self) -> Result<(), WeightsError> {
        let ImageSizes { rows, columns, code } = self.image;
        check_widths(code, &[rows, columns])
    }

    fn layout(&self) -> Layout {
        autoencoder_layout(&self.image)
    }
}

/// Cross entropy of a pixel.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct CodeScore {
    entropy: f64,
}

impl fmt::Display for CodeScore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "autoencoder, cross entropy {:.4}", self.entropy)
    }
}

struct Task<'a> {
    settings: &'a ImageSettings,
    examples: &'a [Seen],
    held_out: &'a [Seen],
}

impl Trainable for Task<'_> {
    const KEY: &'static str = "pushplan-lever-code-checkpoint";
    type Settings = ImageSettings;
    /// Pixels are shares and need no scales.
    type Scales = ();
    type Score = CodeScore;
    type Card = CodeCard;

    fn settings(&self) -> ImageSettings {
        self.settings.clone()
    }

    fn descent(&self) -> Descent {
        self.settings.memory.descent
    }

    fn is_empty(&self) -> bool {
        self.examples.is_empty()
    }

    fn scales(&self) {}

    fn fresh(&self, (): &()) -> Parameters {
        fresh_autoencoder(&self.settings.image(), self.settings.memory.seed)
    }

    fn gradient(
        &self,
        weights: &Parameters,
        (): &(),
        (step, replica): (u64, usize),
    ) -> CandleResult<(f64, Parameters)> {
        let (memory, image) = (&self.settings.memory, self.settings.image());
        let drawn =
            drawn(self.examples, memory.descent.batch, (memory.seed ^ IMAGES, step, replica));
        let network = Autoencoder::new(&image, weights)?;
        gradients_of(&loss(&network, &images(&drawn, &image)?)?, network.variables())
    }

    fn score(&self, weights: &Weights<CodeCard>) -> CodeScore {
        let image = self.settings.image();
        let of = |some: &[Seen]| -> CandleResult<f64> {
            let network = Autoencoder::new(&image, &weights.parameters)?;
            let some: Vec<&Seen> = some.iter().collect();
            let mean = loss(&network, &images(&some, &image)?)?.to_scalar::<f32>()?;
            Ok(some.len() as f64 * f64::from(mean))
        };
        let sum: CandleResult<f64> = self.held_out.chunks(AT_ONCE).map(of).sum();
        CodeScore { entropy: sum.unwrap_or(f64::MAX) / self.held_out.len().max(1) as f64 }
    }

    fn is_better(score: &CodeScore, than: &CodeScore) -> bool {
        score.entropy < than.entropy
    }

    fn card(&self, (): &(), steps: u64, _: Option<&CodeScore>) -> CodeCard {
        CodeCard { image: self.settings.image(), steps }
    }
}

/// Returns the mean cross entropy of a pixel: log(1 + exp x) - x y, without overflow.
fn loss(network: &Autoencoder, seen: &Tensor) -> CandleResult<Tensor> {
    let x = network.forward(seen)?;
    let wanted = seen.reshape(x.shape())?;
    let soft = (x.relu()? + (x.abs()?.neg()?.exp()? + 1.0)?.log()?)?;
    (soft - (x * wanted)?)?.mean_all()
}
