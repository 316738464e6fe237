//! The network on plain numbers: what planning uses, without candle.

use crate::network::{Parameters, Statistics};

use super::{
    layout::{LEVER_ENDS, LEVER_POSE, LeverSizes},
    weights::LeverWeights,
};

/// Normalised features beyond this are cut off, in standard deviations, so that a lever-up unlike
/// any in training cannot drive it anywhere.
pub(super) const BOUND: f32 = 10.0;

/// The network with its weights; shared between threads.
#[derive(Clone, Debug)]
pub struct LeverCell {
    sizes: LeverSizes,
    still: Statistics,
    moving: Statistics,
    parameters: Parameters,
}

/// What it says of a lever-up, to be added to what the prior says.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverTold {
    /// Of every frame the pose: [T, 9].
    pub poses: Vec<f32>,
    /// Slip, endings, pose at rest.
    pub end: [f32; LEVER_ENDS],
}

impl LeverCell {
    /// Of these weights.
    pub fn new(weights: &LeverWeights) -> Self {
        let LeverWeights { card, parameters } = weights;
        Self {
            sizes: card.sizes,
            still: card.still.clone(),
            moving: card.moving.clone(),
            parameters: parameters.clone(),
        }
    }

    /// Predicts from features `still` [S] of the lever-up and `moving` [T, M] of its frames.
    pub fn predict(&self, still: &[f32], moving: &[f32]) -> LeverTold {
        let width = self.sizes.width;
        let mut told = self.get("gates.bias").to_vec();
        multiply(&scaled(&self.still, still), self.get("gates.still"), &mut told);
        let (mut hidden, mut memory) = (vec![0.0; width], vec![0.0; width]);
        let mut gates = vec![0.0; 4 * width];
        let mut poses = Vec::new();
        for frame in moving.chunks_exact(self.sizes.moving.max(1)) {
            gates.copy_from_slice(&told);
            multiply(&scaled(&self.moving, frame), self.get("gates.moving"), &mut gates);
            multiply(&hidden, self.get("gates.hidden"), &mut gates);
            for k in 0..width {
                let [input, forget, new, output] = [0, 1, 2, 3].map(|gate| gates[gate * width + k]);
                memory[k] = sigmoid(forget) * memory[k] + sigmoid(input) * new.tanh();
                hidden[k] = sigmoid(output) * memory[k].tanh();
            }
            let mut pose = [0.0; LEVER_POSE];
            pose.copy_from_slice(self.get("pose.bias"));
            multiply(&hidden, self.get("pose.hidden"), &mut pose);
            poses.extend(pose);
        }
        let mut last = self.get("end.hidden_bias").to_vec();
        multiply(&hidden, self.get("end.hidden"), &mut last);
        last.iter_mut().for_each(|value| *value = value.max(0.0));
        let mut end = [0.0; LEVER_ENDS];
        end.copy_from_slice(self.get("end.told_bias"));
        multiply(&last, self.get("end.told"), &mut end);
        LeverTold { poses, end }
    }

    /// A parameter that reading the weights checked.
    fn get(&self, name: &str) -> &[f32] {
        &self.parameters.values[name]
    }
}

/// A row of features, shifted and scaled.
fn scaled(scales: &Statistics, row: &[f32]) -> Vec<f32> {
    scales.apply(row).into_iter().map(|x| x.clamp(-BOUND, BOUND)).collect()
}

/// Adds x [n] times `matrix` [n, m] to `into` [m].
fn multiply(x: &[f32], matrix: &[f32], into: &mut [f32]) {
    for (x, row) in x.iter().zip(matrix.chunks_exact(into.len())) {
        into.iter_mut().zip(row).for_each(|(into, value)| *into += x * value);
    }
}

fn sigmoid(x: f32) -> f32 {
    1.0 / (1.0 + (-x).exp())
}
