//! Lever-ups as examples, and side by side as tensors.

use candle_core::{Device, Result, Tensor};
use rayon::prelude::*;

use crate::{
    dataset::LeverEpisode,
    effect::{LeverInputs, LeverModel, LeverNetwork, LeverView, lever_inputs},
    network::{LEVER_POSE, LeverGraph, LeverTensors, Statistics},
    scene::{Ending, LEVER_FRAMES},
    train::lever::settings::LeverSettings,
};

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
}

/// The examples of `episodes` that came to rest without a jam.
pub(super) fn examples(settings: &LeverSettings, episodes: &[LeverEpisode]) -> Vec<Example> {
    let sound: Vec<&LeverEpisode> = episodes.iter().filter(|episode| episode.is_sound()).collect();
    sound.par_iter().map(|episode| example(settings, episode)).collect()
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
    Example { inputs, wanted, slip: f32::from(u8::from(truth.slipped())), ending }
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
}

impl Batch {
    pub fn new(examples: &[&Example], scales: &[Statistics; 2]) -> Result<Self> {
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
        let one_of = |e: &Example| (0..3).map(|k| f32::from(u8::from(k == e.ending))).collect();
        Ok(Self {
            tensors: LeverTensors {
                still: tensor(
                    scaled(gather(&|e| e.inputs.still.clone()), still),
                    still.mean.len(),
                )?,
                moving: frames.collect::<Result<_>>()?,
            },
            wanted: poses(gather(&|e| e.wanted[..all].to_vec()), LEVER_FRAMES)?,
            rests: poses(gather(&|e| e.wanted[all..].to_vec()), 1)?,
            slips: tensor(gather(&|e| vec![e.slip]), 1)?,
            endings: tensor(gather(&one_of), 3)?,
        })
    }

    /// Distances of ways and axes, their root mean square over the frames, and at rest, and cross
    /// entropies of slip and ending; means over lever-ups.
    pub fn loss(&self, network: &LeverGraph) -> Result<Tensor> {
        let (poses, end) = network.forward(&self.tensors)?;
        let [axes, rest, slip, ending] = WEIGHTS;
        let told = Tensor::stack(&poses, 1)?;
        // Not the mean distance: what is published is the root mean square over the frames.
        let far = |told: &Tensor, wanted: &Tensor, from: usize, count: usize| -> Result<Tensor> {
            let apart = (told.narrow(2, from, count)? - wanted.narrow(2, from, count)?)?;
            (apart.sqr()?.sum(2)?.mean(1)? + NEAR)?.sqrt()?.mean_all()
        };
        let mut loss = far(&told, &self.wanted, 0, 3)?;
        loss = (loss + (far(&told, &self.wanted, 3, 6)? * axes)?)?;
        let told = end.narrow(1, 4, LEVER_POSE)?.unsqueeze(1)?;
        loss = (loss + (far(&told, &self.rests, 0, 3)? * rest)?)?;
        // log(1 + exp x) - x y, without overflow.
        let x = end.narrow(1, 0, 1)?;
        let soft = (x.relu()? + ((x.abs()?.neg()?.exp()? + 1.0)?.log()?))?;
        loss = (loss + ((soft - (x * &self.slips)?)?.mean_all()? * slip)?)?;
        let logits = end.narrow(1, 1, 3)?;
        let shares = logits.broadcast_sub(&logits.log_sum_exp(1)?.unsqueeze(1)?)?;
        loss - ((shares * &self.endings)?.sum(1)?.mean_all()? * ending)?
    }
}
