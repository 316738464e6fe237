//! Lever-ups with their images.

use candle_core::{Device, Result, Tensor};
use pushplan::internals::effect::{LeverInputs, LeverView, lever_inputs};
use pushplan::internals::{outcome::LeverTrajectory, scene::LeverFeatures, task::LeverJob};
use pushplan_learn::dataset::LeverEpisode;
use pushplan_learn::train::LeverExample;
use rayon::prelude::*;

use super::{ImageFeatures, ImageSettings, ImageSizes, lever_image};

/// A lever-up with its answer, and what is seen of it.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub example: LeverExample,
    /// Row by row.
    pub image: Vec<f32>,
}

impl Seen {
    /// Those of `episodes` that came to rest without a jam, and have frames that count.
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

/// What a network that sees images is told of a job, with what the prior says of it if that is
/// corrected: what stands beside the image, and the image, row by row.
pub fn image_inputs(
    features: ImageFeatures,
    job: &LeverJob,
    prior: Option<&LeverTrajectory>,
) -> (LeverInputs, Vec<f32>) {
    let mut inputs = lever_inputs(LeverFeatures::Nothing, job, prior);
    hide_thickness(&mut inputs);
    (inputs, lever_image(features, job, &LeverView::new(job)))
}

/// How thick a plate is belongs to what is seen of it, or is not.
fn hide_thickness(inputs: &mut LeverInputs) {
    inputs.still[LeverFeatures::THICKNESS] = 0.0;
}

/// Images side by side: [B, rows, columns, 1].
pub(super) fn images(seen: &[&Seen], sizes: &ImageSizes) -> Result<Tensor> {
    let all: Vec<f32> = seen.iter().flat_map(|seen| seen.image.iter().copied()).collect();
    Tensor::from_vec(all, (seen.len(), sizes.rows, sizes.columns, 1), &Device::Cpu)
}
