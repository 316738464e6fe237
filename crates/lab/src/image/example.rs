//! Lever-ups with their images.

use candle_core::{Device, Result, Tensor};
use pushplan::internals::effect::{LeverInputs, LeverView, lever_inputs};
use pushplan::internals::{outcome::LeverTrajectory, scene::LeverFeatures, task::LeverJob};
use pushplan_learn::dataset::LeverEpisode;
use pushplan_learn::train::LeverExample;
use rayon::prelude::*;

use super::{ImageFeatures, ImageSettings, ImageSizes, lever_image};

/// A lever-up with its target and its image.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub example: LeverExample,
    /// Pixels, row by row.
    pub image: Vec<f32>,
}

impl Seen {
    /// Returns the examples of `episodes` that came to rest without a jam and have usable frames.
    pub fn all(settings: &ImageSettings, episodes: &[LeverEpisode]) -> Vec<Self> {
        let seen = |episode: &LeverEpisode| {
            let mut example = LeverExample::new(&settings.memory, episode)?;
            hide_thickness(&mut example.inputs);
            let job = episode.job();
            let image = lever_image(settings.features, &job, &LeverView::new(&job));
            Some(Self { example, image })
        };
        episodes.par_iter().filter_map(seen).collect()
    }
}

/// Returns the inputs of a network with image input for a job: the features beside the image, and
/// the image, row by row. The features include the prediction of `prior` if it is corrected.
pub fn image_inputs(
    features: ImageFeatures,
    job: &LeverJob,
    prior: Option<&LeverTrajectory>,
) -> (LeverInputs, Vec<f32>) {
    let mut inputs = lever_inputs(LeverFeatures::Nothing, job, prior);
    hide_thickness(&mut inputs);
    (inputs, lever_image(features, job, &LeverView::new(job)))
}

/// Hides the thickness of a plate, which only the image may show.
fn hide_thickness(inputs: &mut LeverInputs) {
    inputs.still[LeverFeatures::THICKNESS] = 0.0;
}

/// Returns images side by side: [B, rows, columns, 1].
pub(super) fn images(seen: &[&Seen], sizes: &ImageSizes) -> Result<Tensor> {
    let all: Vec<f32> = seen.iter().flat_map(|seen| seen.image.iter().copied()).collect();
    Tensor::from_vec(all, (seen.len(), sizes.rows, sizes.columns, 1), &Device::Cpu)
}
