//! Loss of whole pushes: pseudo-Huber on the error of every pose.

use candle_core::{Device, Result, Tensor};
use pushplan::internals::graph::{OUTPUT_EVEN, OUTPUT_ODD, READOUTS};
use pushplan::internals::network::MOST_CHANGE;

use super::example::Supervised;

/// Error above which the loss is linear, millimetres.
///
/// Pushes at the edge of slipping off are unpredictable and must not dominate the weights.
const KNEE: f64 = 0.5;

/// Returns the mean loss of `count` pushes, millimetres. `outputs` are the rows of all nodes,
/// [N, 6].
pub(super) fn loss(outputs: &Tensor, drawn: &Supervised, count: usize) -> Result<Tensor> {
    let Supervised { nodes, targets, scales, changes, weights, readouts, .. } = drawn;
    let (rows, all) = (nodes.len(), changes.len() / 3);
    let table = |values: &[f32], rows: usize, columns: usize| {
        Tensor::from_slice(values, (rows, columns), &Device::Cpu)
    };
    let index = |values: &[u32]| Tensor::from_slice(values, values.len(), &Device::Cpu);
    let (nodes, targets) = (index(nodes)?, index(targets)?);
    let scales = table(scales, rows, 3)?;
    let scale = |k: usize| scales.narrow(1, k, 1);
    // Rates of every readout, [N, READOUTS].
    let x = outputs.narrow(1, 0, OUTPUT_EVEN)?;
    let odd = outputs.narrow(1, OUTPUT_EVEN, OUTPUT_ODD)?.reshape(((), READOUTS, 2))?;
    let (y, turn) = (odd.narrow(2, 0, 1)?.squeeze(2)?, odd.narrow(2, 1, 1)?.squeeze(2)?);
    let share = |square: Tensor| ((square / (MOST_CHANGE * MOST_CHANGE))? + 1.0)?.sqrt()?.recip();
    let shift = share((x.sqr()? + y.sqr()?)?)?;
    let of = |rate: Tensor| rate.contiguous()?.index_select(&nodes, 0);
    let (along, across) = (of((x * &shift)?)?, of((y * &shift)?)?);
    let turn = of((&turn * share(turn.sqr()?)?)?)?;
    let sum = |change: Tensor| {
        let zeros = Tensor::zeros((all, READOUTS), change.dtype(), &Device::Cpu)?;
        zeros.index_add(&targets, &change, 0)
    };
    let to_x = (along.broadcast_mul(&scale(0)?)? - across.broadcast_mul(&scale(1)?)?)?;
    let to_y = (along.broadcast_mul(&scale(1)?)? + across.broadcast_mul(&scale(0)?)?)?;
    let to_turn = turn.broadcast_mul(&scale(2)?)?;
    let (changes, weights) = (table(changes, all, 3)?, table(weights, all, 2)?);
    let readouts = table(readouts, all, READOUTS)?;
    // Squared errors of every readout, [T, READOUTS].
    let square =
        |change: Tensor, k: usize| sum(change)?.broadcast_sub(&changes.narrow(1, k, 1)?)?.sqr();
    let huber = |square: Tensor, k: usize| {
        // The argument of the root is at least one, so the gradient is finite.
        let value = ((((square / (KNEE * KNEE))? + 1.0)?.sqrt()? - 1.0)? * KNEE)?;
        (value * readouts.broadcast_mul(&weights.narrow(1, k, 1)?)?)?.sum_all()
    };
    let position = huber((square(to_x, 0)? + square(to_y, 1)?)?, 0)?;
    let heading = huber(square(to_turn, 2)?, 1)?;
    (position + heading)? / count as f64
}
