//! Loss of a single frame: pseudo-Huber on the six outputs of every node.

use candle_core::{Device, Result, Tensor};

/// Error above which the loss is linear, in output units (0.1 mm).
///
/// Pushes at the edge of slipping off are unpredictable and must not dominate the weights.
const KNEE: f64 = 0.01;

/// Weights of shifts (x, y), of rotations, and of the corresponding velocities.
const SHIFT: f32 = 1.0;
const TURN: f32 = 1.0;
/// Velocities affect only the free sliding after a push.
const VELOCITY: f32 = 0.2;
/// The rotation of a cylinder is unobservable and hardly affects its sliding.
const CYLINDER: f32 = 0.1;

/// Returns the weights of a node's six outputs, in their order.
pub(super) fn weights(cylinder: bool) -> [f32; 6] {
    let turn = if cylinder { CYLINDER } else { 1.0 };
    [SHIFT, VELOCITY, SHIFT, TURN * turn, VELOCITY, VELOCITY * turn]
}

/// Returns the sum over nodes and outputs of weight x KNEE^2 (sqrt(1 + (e / KNEE)^2) - 1), divided
/// by `count`.
///
/// Shapes: predicted [N, 6], target and weight row-major [N, 6].
pub(super) fn loss(
    predicted: &Tensor,
    target: Vec<f32>,
    weight: Vec<f32>,
    count: usize,
) -> Result<Tensor> {
    let shape = predicted.shape().clone();
    let target = Tensor::from_vec(target, shape.clone(), &Device::Cpu)?;
    let weight = Tensor::from_vec(weight, shape, &Device::Cpu)?;
    let error = ((predicted - target)? / KNEE)?;
    // The argument of the root is at least one, so the gradient is finite.
    let huber = ((error.sqr()? + 1.0)?.sqrt()? - 1.0)?;
    (huber * weight)?.sum_all()? * (KNEE * KNEE / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_errors_count_by_half_their_square_and_large_ones_linearly() -> Result<()> {
        let at = |e: f32| -> Result<f32> {
            let predicted =
                Tensor::from_vec(vec![e, 0.0, 0.0, 0.0, 0.0, 0.0], (1, 6), &Device::Cpu)?;
            loss(&predicted, vec![0.0; 6], vec![1.0; 6], 1)?.to_scalar()
        };
        assert!((at(0.001)? - 0.5e-6).abs() < 1e-8);
        let slope = at(10.0)? - at(9.0)?;
        assert!((slope - KNEE as f32).abs() < 1e-4);
        Ok(())
    }
}
