//! Names, shapes and initial values of the lever-up network's parameters.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use crate::network::{Layout, Parameters};

/// Count of numbers of a pose.
pub const LEVER_POSE: usize = 9;

/// Count of numbers of the end: the logit of a slip, the logits of three endings, the pose at rest.
pub const LEVER_ENDS: usize = 4 + LEVER_POSE;

/// Widths of a lever-up network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeverSizes {
    /// Number of features of a lever-up, S.
    pub still: usize,
    /// Number of features of a frame, M.
    pub moving: usize,
    /// Width of the hidden state, H.
    pub width: usize,
    /// Whether the pose predicted last is an input of the next frame.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub feedback: bool,
}

/// Returns the names and shapes of all parameters. The order of the four gates in every row is
/// input, forget, new, output.
pub fn lever_layout(sizes: &LeverSizes) -> Layout {
    let LeverSizes { still, moving, width, feedback } = *sizes;
    let mut layout = vec![
        ("gates.still", vec![still, 4 * width]),
        ("gates.moving", vec![moving, 4 * width]),
        ("gates.hidden", vec![width, 4 * width]),
        ("gates.bias", vec![4 * width]),
        ("pose.hidden", vec![width, LEVER_POSE]),
        ("pose.bias", vec![LEVER_POSE]),
        ("end.hidden", vec![width, width]),
        ("end.hidden_bias", vec![width]),
        ("end.told", vec![width, LEVER_ENDS]),
        ("end.told_bias", vec![LEVER_ENDS]),
    ];
    if feedback {
        layout.push(("gates.pose", vec![LEVER_POSE, 4 * width]));
    }
    layout
}

/// Returns random initial values from `seed`: uniform with the variance 1 / fan-in.
///
/// The output layers of poses and end are zero, so that an untrained network leaves the analytic
/// model unchanged. Forget gates begin open.
pub fn fresh_lever(sizes: &LeverSizes, seed: u64) -> Parameters {
    let mut random = Pcg64::seed_from_u64(seed);
    let values = lever_layout(sizes).into_iter().map(|(name, shape)| {
        (name.to_owned(), fresh_lever_values(name, &shape, sizes.width, &mut random))
    });
    Parameters { values: values.collect() }
}

/// Returns the initial values of one parameter of a network of hidden `width`.
pub fn fresh_lever_values(
    name: &str,
    shape: &[usize],
    width: usize,
    random: &mut Pcg64,
) -> Vec<f32> {
    let zero = shape.len() == 1 || name == "pose.hidden" || name == "end.told";
    let bound = (3.0 / shape[0].max(1) as f32).sqrt();
    let value = |k: usize| match name {
        "gates.bias" if k / width == 1 => 1.0,
        _ if zero => 0.0,
        // Three products add up to a gate.
        _ if name.starts_with("gates") => random.random_range(-bound..bound) * 0.577,
        _ => random.random_range(-bound..bound),
    };
    (0..shape.iter().product()).map(value).collect()
}
