//! Lever-ups as examples and as batched tensors.

use crate::lever_model::LeverModel;
use candle_core::{Device, Result, Tensor};
use pushplan::internals::effect::{LeverInputs, LeverNetwork, LeverView, lever_inputs};
use pushplan::internals::network::{LEVER_POSE, LeverSizes, Statistics};
use pushplan::internals::outcome::{Ending, LEVER_FRAMES};
use rayon::prelude::*;

use crate::dataset::LeverEpisode;
use crate::network::{LeverGraph, LeverTensors};

use super::LeverSettings;

/// Bound of normalised features, equal to the bound in the cell.
const BOUND: f32 = 10.0;

/// Softening of distances in units of 5 cm, squared: errors below 1 mm count less.
const NEAR: f64 = 4e-4;

/// Weights in the loss of axes, pose at rest, slip and ending, relative to positions during the
/// rotation.
///
/// Positions dominate; the other terms help slightly.
const WEIGHTS: [f64; 4] = [0.3, 0.1, 0.1, 0.1];

/// Lever-up with its ground truth.
#[derive(Clone, Debug)]
pub struct LeverExample {
    /// Inputs of the network.
    pub inputs: LeverInputs,
    /// Targets to add to the base: [T, 9] for frames and [9] at rest.
    wanted: Vec<f32>,
    slip: f32,
    ending: usize,
    /// Number of frames that count.
    frames: usize,
}

impl LeverExample {
    /// Creates the example of an episode, if the episode came to rest without a jam and has frames
    /// that count.
    pub fn new(settings: &LeverSettings, episode: &LeverEpisode) -> Option<Self> {
        let example = episode.is_sound().then(|| example(settings, episode));
        example.filter(|example| example.frames > 0)
    }

    /// Creates the examples of `episodes`.
    pub fn all(settings: &LeverSettings, episodes: &[LeverEpisode]) -> Vec<Self> {
        episodes.par_iter().filter_map(|episode| Self::new(settings, episode)).collect()
    }

    /// Returns the scales of the features per lever-up and per frame.
    pub fn scales<'a>(
        examples: impl Iterator<Item = &'a Self> + Clone,
        sizes: &LeverSizes,
    ) -> [Statistics; 2] {
        let table = |of: fn(&Self) -> &[f32]| -> Vec<f32> {
            examples.clone().flat_map(of).copied().collect()
        };
        let still = Statistics::measure(&table(|e| &e.inputs.still), sizes.still, true);
        let moving = Statistics::measure(&table(|e| &e.inputs.moving), sizes.moving, true);
        [still, moving]
    }
}

fn example(settings: &LeverSettings, episode: &LeverEpisode) -> LeverExample {
    let job = episode.job();
    let prior = settings
        .prior
        .then(|| LeverNetwork::PRIOR.rollout(std::slice::from_ref(&job)))
        .and_then(|mut predicted| predicted.pop());
    let inputs = lever_inputs(settings.features, &job, prior.as_ref());
    let view = LeverView::new(&job);
    let truth = &episode.trajectory;
    let poses = truth.lift.iter().chain([&truth.rest]);
    let in_units = poses.flat_map(|pose| LeverInputs::in_units(view.see(pose)));
    let wanted = in_units.zip(&inputs.base).map(|(truth, base)| truth - base).collect();
    let ending = match truth.ending {
        Ending::Back => 0,
        Ending::Flipped => 1,
        Ending::Leaning => 2,
    };
    let slip = f32::from(u8::from(truth.slipped()));
    let frames = if settings.cut { truth.before_slip() } else { LEVER_FRAMES };
    LeverExample { inputs, wanted, slip, ending, frames }
}

/// Batch as tensors.
pub struct LeverBatch {
    tensors: LeverTensors,
    /// Targets of all frames: [B, T, 9].
    wanted: Tensor,
    /// Targets at rest: [B, 1, 9].
    rests: Tensor,
    /// Slips, [B, 1]: 1 or 0.
    slips: Tensor,
    /// Endings, [B, 3]: 1 at the true ending.
    endings: Tensor,
    /// Weight of every frame, [B, T]; the sum per lever-up is 1.
    shares: Tensor,
}

impl LeverBatch {
    /// Creates a batch of examples.
    ///
    /// # Errors
    /// Returns errors of candle; examples of these sizes cause none.
    pub fn new(
        examples: &[&LeverExample],
        scales: &[Statistics; 2],
        sizes: &LeverSizes,
    ) -> Result<Self> {
        let count = examples.len();
        let tensor = |values: Vec<f32>, columns: usize| {
            Tensor::from_vec(values, (count, columns), &Device::Cpu)
        };
        let scaled = |rows: Vec<f32>, scales: &Statistics| -> Vec<f32> {
            scales.apply(&rows).into_iter().map(|x| x.clamp(-BOUND, BOUND)).collect()
        };
        let [still, moving] = scales;
        let columns = moving.mean.len();
        let gather = |of: &dyn Fn(&LeverExample) -> Vec<f32>| -> Vec<f32> {
            examples.iter().flat_map(|example| of(example)).collect()
        };
        let frames = (0..LEVER_FRAMES).map(|t| {
            let rows = gather(&|e| e.inputs.moving[t * columns..][..columns].to_vec());
            tensor(scaled(rows, moving), columns)
        });
        let all = LEVER_FRAMES * LEVER_POSE;
        let poses = |values: Vec<f32>, frames: usize| {
            Tensor::from_vec(values, (count, frames, LEVER_POSE), &Device::Cpu)
        };
        // Pose of a plate in the previous frame; initially it has not moved.
        let before = |e: &LeverExample, t: usize| match t.checked_sub(1) {
            Some(last) => e.wanted[last * LEVER_POSE..][..LEVER_POSE].to_vec(),
            None => vec![0.0; LEVER_POSE],
        };
        let fed_back = if sizes.feedback { LEVER_FRAMES } else { 0 };
        let before = (0..fed_back).map(|t| tensor(gather(&|e| before(e, t)), LEVER_POSE));
        let share = |e: &LeverExample| {
            let share = |t: usize| if t < e.frames { 1.0 / e.frames as f32 } else { 0.0 };
            (0..LEVER_FRAMES).map(share).collect()
        };
        let one_of =
            |e: &LeverExample| (0..3).map(|k| f32::from(u8::from(k == e.ending))).collect();
        Ok(Self {
            tensors: LeverTensors {
                still: tensor(
                    scaled(gather(&|e| e.inputs.still.clone()), still),
                    still.mean.len(),
                )?,
                moving: frames.collect::<Result<_>>()?,
                before: before.collect::<Result<_>>()?,
            },
            wanted: poses(gather(&|e| e.wanted[..all].to_vec()), LEVER_FRAMES)?,
            rests: poses(gather(&|e| e.wanted[all..].to_vec()), 1)?,
            slips: tensor(gather(&|e| vec![e.slip]), 1)?,
            endings: tensor(gather(&one_of), 3)?,
            shares: tensor(gather(&share), LEVER_FRAMES)?,
        })
    }

    /// Returns the loss, averaged over lever-ups.
    ///
    /// The loss contains root mean square distances of positions and axes over the frames and at
    /// rest, and cross entropies of slip and ending. `beside` is an optional additional input, see
    /// [`LeverGraph::forward`].
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn loss(&self, network: &LeverGraph, beside: Option<&Tensor>) -> Result<Tensor> {
        let (poses, end) = network.forward(&self.tensors, beside)?;
        let [axes, rest, slip, ending] = WEIGHTS;
        let predicted = Tensor::stack(&poses, 1)?;
        // The published measure is the root mean square over frames instead of the mean distance.
        let squares = |predicted: &Tensor, wanted: &Tensor, from: usize, count: usize| {
            (predicted.narrow(2, from, count)? - wanted.narrow(2, from, count)?)?.sqr()?.sum(2)
        };
        let over = |squares: Tensor| -> Result<Tensor> {
            ((squares * &self.shares)?.sum(1)? + NEAR)?.sqrt()?.mean_all()
        };
        let mut loss = over(squares(&predicted, &self.wanted, 0, 3)?)?;
        loss = (loss + (over(squares(&predicted, &self.wanted, 3, 6)?)? * axes)?)?;
        let predicted = end.narrow(1, 4, LEVER_POSE)?.unsqueeze(1)?;
        let apart = (squares(&predicted, &self.rests, 0, 3)?.sum(1)? + NEAR)?.sqrt()?.mean_all()?;
        loss = (loss + (apart * rest)?)?;
        // Computes log(1 + exp x) - x y without overflow.
        let x = end.narrow(1, 0, 1)?;
        let soft = (x.relu()? + ((x.abs()?.neg()?.exp()? + 1.0)?.log()?))?;
        loss = (loss + ((soft - (x * &self.slips)?)?.mean_all()? * slip)?)?;
        let logits = end.narrow(1, 1, 3)?;
        let shares = logits.broadcast_sub(&logits.log_sum_exp(1)?.unsqueeze(1)?)?;
        loss - ((shares * &self.endings)?.sum(1)?.mean_all()? * ending)?
    }
}
