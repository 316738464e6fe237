//! Inference of the lever-up network for planning, without candle.

use pulp::{Arch, Simd, WithSimd};

use crate::network::{Parameters, Statistics};

use super::{
    card::LeverWeights,
    layout::{LEVER_ENDS, LEVER_POSE, LeverSizes},
};

/// Maximum magnitude of a normalised feature, in standard deviations. It keeps the output bounded
/// for a lever-up unlike any in training.
pub(super) const BOUND: f32 = 10.0;

/// Number of sums kept in registers.
const BLOCK: usize = 32;

/// A lever-up network with its weights; shared between threads.
#[derive(Clone, Debug)]
pub struct LeverCell {
    sizes: LeverSizes,
    still: Statistics,
    moving: Statistics,
    parameters: Parameters,
}

/// Output of the network for a lever-up, added to the analytic model.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverOutput {
    /// Pose in every frame: [T, 9].
    pub poses: Vec<f32>,
    /// Slip, endings, and pose at rest.
    pub end: [f32; LEVER_ENDS],
}

impl LeverCell {
    /// Creates a network with these weights.
    pub fn new(weights: &LeverWeights) -> Self {
        let LeverWeights { card, parameters } = weights;
        Self {
            sizes: card.sizes,
            still: card.still.clone(),
            moving: card.moving.clone(),
            parameters: parameters.clone(),
        }
    }

    /// Returns `true` if the network receives its last predicted pose.
    pub fn feeds_back(&self) -> bool {
        self.sizes.feedback
    }

    /// Predicts from features `still`, `[S]`, of the lever-up, and `moving`, `[T, M]`, of its
    /// frames.
    pub fn predict(&self, still: &[f32], moving: &[f32]) -> LeverOutput {
        let (still, moving) = (scaled(&self.still, still), scaled(&self.moving, moving));
        Arch::new().dispatch(Run { cell: self, still: &still, moving: &moving })
    }

    /// Returns a parameter, whose presence was checked when the weights were read.
    fn get(&self, name: &str) -> &[f32] {
        &self.parameters.values[name]
    }
}

/// A prediction from normalised features.
struct Run<'a> {
    cell: &'a LeverCell,
    still: &'a [f32],
    moving: &'a [f32],
}

// Uses the widest vectors of the processor, see `network/parity.rs`; the bits are the same on any.
impl WithSimd for Run<'_> {
    type Output = LeverOutput;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> LeverOutput {
        let Self { cell, still, moving } = self;
        let width = cell.sizes.width;
        let mut constant = cell.get("gates.bias").to_vec();
        multiply(still, cell.get("gates.still"), &mut constant);
        let of_last = cell.sizes.feedback.then(|| cell.get("gates.pose"));
        let [of_moving, of_hidden] = ["gates.moving", "gates.hidden"].map(|name| cell.get(name));
        let (of_pose, pose_bias) = (cell.get("pose.hidden"), cell.get("pose.bias"));
        let (mut hidden, mut memory) = (vec![0.0; width], vec![0.0; width]);
        let mut gates = vec![0.0; 4 * width];
        let mut poses = Vec::new();
        let mut pose = [0.0; LEVER_POSE];
        for frame in moving.chunks_exact(cell.sizes.moving.max(1)) {
            gates.copy_from_slice(&constant);
            multiply(frame, of_moving, &mut gates);
            multiply(&hidden, of_hidden, &mut gates);
            if let Some(of_last) = of_last {
                multiply(&pose, of_last, &mut gates);
            }
            let (input, rest) = gates.split_at(width);
            let (forget, rest) = rest.split_at(width);
            let (new, output) = rest.split_at(width);
            for k in 0..width {
                memory[k] = sigmoid(forget[k]) * memory[k] + sigmoid(input[k]) * tanh(new[k]);
                hidden[k] = sigmoid(output[k]) * tanh(memory[k]);
            }
            pose.copy_from_slice(pose_bias);
            multiply(&hidden, of_pose, &mut pose);
            poses.extend(pose);
        }
        let mut last = cell.get("end.hidden_bias").to_vec();
        multiply(&hidden, cell.get("end.hidden"), &mut last);
        last.iter_mut().for_each(|value| *value = value.max(0.0));
        let mut end = [0.0; LEVER_ENDS];
        end.copy_from_slice(cell.get("end.told_bias"));
        multiply(&last, cell.get("end.told"), &mut end);
        LeverOutput { poses, end }
    }
}

/// Shifts, scales and clamps rows of features.
fn scaled(scales: &Statistics, rows: &[f32]) -> Vec<f32> {
    scales.apply(rows).into_iter().map(|x| x.clamp(-BOUND, BOUND)).collect()
}

/// Adds x [n] times `matrix` [n, m] to `into` [m].
#[inline(always)]
fn multiply(x: &[f32], matrix: &[f32], into: &mut [f32]) {
    let columns = into.len();
    let (blocks, rest) = into.as_chunks_mut::<BLOCK>();
    let beyond = blocks.len() * BLOCK;
    for (k, block) in blocks.iter_mut().enumerate() {
        let mut sums = *block;
        for (x, row) in x.iter().zip(matrix.chunks_exact(columns)) {
            let row = &row[k * BLOCK..][..BLOCK];
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += x * value;
            }
        }
        *block = sums;
    }
    for (x, row) in x.iter().zip(matrix.chunks_exact(columns)) {
        for (into, value) in rest.iter_mut().zip(&row[beyond..]) {
            *into += x * value;
        }
    }
}

#[inline(always)]
fn sigmoid(x: f32) -> f32 {
    0.5 + 0.5 * tanh(0.5 * x)
}

/// Returns the hyperbolic tangent within 1e-6, in vectorisable operations: the rational function of
/// Eigen 3.4, `MathFunctionsImpl.h`.
#[inline(always)]
pub fn tanh(x: f32) -> f32 {
    // Beyond this range the result is 1 in single precision.
    let x = x.clamp(-7.905_311, 7.905_311);
    let x2 = x * x;
    let over = [
        -2.760_768_5e-16,
        2.000_188e-13,
        -8.604_672e-11,
        5.122_297e-8,
        1.485_722_4e-5,
        6.372_619_3e-4,
        4.893_524_6e-3,
    ];
    let under = [1.198_258_4e-6, 1.185_347_1e-4, 2.268_434_6e-3, 4.893_525e-3];
    let over = over.iter().fold(0.0, |sum, c| sum * x2 + c);
    x * over / under.iter().fold(0.0, |sum, c| sum * x2 + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rational_function_is_the_hyperbolic_tangent() {
        for k in -2000..=2000 {
            let x = k as f32 * 0.005;
            assert!((tanh(x) - x.tanh()).abs() < 1e-6, "{x}: {} {}", tanh(x), x.tanh());
        }
    }

    #[test]
    fn products_of_any_width_are_sums_of_products() {
        for columns in [1, BLOCK - 1, BLOCK, 2 * BLOCK + 3] {
            let x = [2.0, -1.0, 0.5];
            let matrix: Vec<f32> = (0..3 * columns).map(|k| k as f32).collect();
            let mut into = vec![1.0; columns];
            multiply(&x, &matrix, &mut into);
            for (k, found) in into.iter().enumerate() {
                let k = k as f32;
                let wanted =
                    1.0 + 2.0 * k - (columns as f32 + k) + 0.5 * (2 * columns) as f32 + 0.5 * k;
                assert!((found - wanted).abs() < 1e-3, "{columns} {k}: {found} {wanted}");
            }
        }
    }
}
