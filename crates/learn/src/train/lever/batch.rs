//! Lever-ups as examples, and side by side as tensors.

use candle_core::{Device, Result, Tensor};
use pushplan::internals::effect::{LeverInputs, LeverModel, LeverNetwork, LeverView, lever_inputs};
use pushplan::internals::network::{ImageSizes, LEVER_POSE, LeverSizes, Statistics};
use pushplan::internals::scene::{Ending, LEVER_FRAMES};
use rayon::prelude::*;

use crate::dataset::LeverEpisode;
use crate::network::{LeverGraph, LeverTensors};
use crate::train::lever::settings::LeverSettings;

/// Normalised features beyond this are cut off, as the cell does.
const BOUND: f32 = 10.0;

/// Squared distances below this, in units of 5 cm, count less: 1 mm.
const NEAR: f64 = 4e-4;

/// Weights in the loss, beside that of ways during the turn: of axes, of the pose at rest, of slip
/// and ending. Ways decide; the others help a little.
const WEIGHTS: [f64; 4] = [0.3, 0.1, 0.1, 0.1];

/// A lever-up with its answer.
#[derive(Clone, Debug)]
pub(super) struct Example {
    pub inputs: LeverInputs,
    /// What is to be added to the base: [T, 9] and at rest [9].
    wanted: Vec<f32>,
    slip: f32,
    ending: usize,
    /// Frames that count.
    frames: usize,
}

/// The examples of `episodes` that came to rest without a jam, and have frames that count.
pub(super) fn examples(settings: &LeverSettings, episodes: &[LeverEpisode]) -> Vec<Example> {
    let sound: Vec<&LeverEpisode> = episodes.iter().filter(|episode| episode.is_sound()).collect();
    let examples = sound.par_iter().map(|episode| example(settings, episode));
    examples.filter(|example| example.frames > 0).collect()
}

fn example(settings: &LeverSettings, episode: &LeverEpisode) -> Example {
    let job = episode.job();
    let prior = settings
        .prior
        .then(|| LeverNetwork::PRIOR.rollout(std::slice::from_ref(&job)))
        .and_then(|mut said| said.pop());
    let inputs = lever_inputs(settings.features, &job, prior.as_ref());
    let view = LeverView::new(&job);
    let truth = &episode.trajectory;
    let poses = truth.lift.iter().chain([&truth.rest]);
    let told = poses.flat_map(|pose| LeverInputs::told(view.see(pose)));
    let wanted = told.zip(&inputs.base).map(|(told, base)| told - base).collect();
    let ending = match truth.ending {
        Ending::Back => 0,
        Ending::Flipped => 1,
        Ending::Leaning => 2,
    };
    let slip = f32::from(u8::from(truth.slipped()));
    let frames = if settings.cut { truth.before_slip() } else { LEVER_FRAMES };
    Example { inputs, wanted, slip, ending, frames }
}

/// A batch as tensors.
pub(super) struct Batch {
    tensors: LeverTensors,
    /// Of every frame: [B, T, 9].
    wanted: Tensor,
    /// At rest: [B, 1, 9].
    rests: Tensor,
    /// [B, 1].
    slips: Tensor,
    /// [B, 3]: 1 at the true ending.
    endings: Tensor,
    /// How much every frame counts, [B, T]; their sums are 1.
    shares: Tensor,
}

impl Batch {
    pub fn new(
        examples: &[&Example],
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
        let gather = |of: &dyn Fn(&Example) -> Vec<f32>| -> Vec<f32> {
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
        // Where a plate was a frame before: at first it has not moved.
        let before = |e: &Example, t: usize| match t.checked_sub(1) {
            Some(last) => e.wanted[last * LEVER_POSE..][..LEVER_POSE].to_vec(),
            None => vec![0.0; LEVER_POSE],
        };
        let told = if sizes.feedback { LEVER_FRAMES } else { 0 };
        let before = (0..told).map(|t| tensor(gather(&|e| before(e, t)), LEVER_POSE));
        let share = |e: &Example| {
            let share = |t: usize| if t < e.frames { 1.0 / e.frames as f32 } else { 0.0 };
            (0..LEVER_FRAMES).map(share).collect()
        };
        let one_of = |e: &Example| (0..3).map(|k| f32::from(u8::from(k == e.ending))).collect();
        Ok(Self {
            tensors: LeverTensors {
                still: tensor(
                    scaled(gather(&|e| e.inputs.still.clone()), still),
                    still.mean.len(),
                )?,
                image: sizes.image.map(|sizes| images(examples, &sizes)).transpose()?,
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

    /// Distances of ways and axes, their root mean square over the frames, and at rest, and cross
    /// entropies of slip and ending; means over lever-ups.
    pub fn loss(&self, network: &LeverGraph) -> Result<Tensor> {
        let (poses, end) = network.forward(&self.tensors)?;
        let [axes, rest, slip, ending] = WEIGHTS;
        let told = Tensor::stack(&poses, 1)?;
        // Not the mean distance: what is published is the root mean square over the frames.
        let squares = |told: &Tensor, wanted: &Tensor, from: usize, count: usize| {
            (told.narrow(2, from, count)? - wanted.narrow(2, from, count)?)?.sqr()?.sum(2)
        };
        let over = |squares: Tensor| -> Result<Tensor> {
            ((squares * &self.shares)?.sum(1)? + NEAR)?.sqrt()?.mean_all()
        };
        let mut loss = over(squares(&told, &self.wanted, 0, 3)?)?;
        loss = (loss + (over(squares(&told, &self.wanted, 3, 6)?)? * axes)?)?;
        let told = end.narrow(1, 4, LEVER_POSE)?.unsqueeze(1)?;
        let apart = (squares(&told, &self.rests, 0, 3)?.sum(1)? + NEAR)?.sqrt()?.mean_all()?;
        loss = (loss + (apart * rest)?)?;
        // log(1 + exp x) - x y, without overflow.
        let x = end.narrow(1, 0, 1)?;
        let soft = (x.relu()? + ((x.abs()?.neg()?.exp()? + 1.0)?.log()?))?;
        loss = (loss + ((soft - (x * &self.slips)?)?.mean_all()? * slip)?)?;
        let logits = end.narrow(1, 1, 3)?;
        let shares = logits.broadcast_sub(&logits.log_sum_exp(1)?.unsqueeze(1)?)?;
        loss - ((shares * &self.endings)?.sum(1)?.mean_all()? * ending)?
    }
}

/// Images side by side: [B, rows, columns, 1].
pub(super) fn images(examples: &[&Example], sizes: &ImageSizes) -> Result<Tensor> {
    let all: Vec<f32> = examples.iter().flat_map(|e| e.inputs.image.iter().copied()).collect();
    Tensor::from_vec(all, (examples.len(), sizes.rows, sizes.columns, 1), &Device::Cpu)
}
