//! The lever-up network: parameters, inference and weights file.
//!
//! A long short-term memory (Hochreiter and Schmidhuber 1997; Tekden 2020, chapter 6). It receives
//! the same features of the lever-up in every frame and predicts every pose at once, without
//! feedback of its predictions. With features s [S] of a lever-up, x_t [M] of a frame, and hidden
//! states h_t [H]:
//!
//! ```text
//! i, f, g, o = s W_s + x_t W_x + h_{t-1} W_h + b
//! c_t = sigmoid(f) c_{t-1} + sigmoid(i) tanh(g)      h_t = sigmoid(o) tanh(c_t)
//! pose_t = base_t + h_t V + a                        end = base + relu(h_T U + b_u) V_e + a_e
//! ```
//!
//! A network can also receive its last predicted pose as feedback, for comparison with that work.
//!
//! `base` is the output of the analytic model, or the start. The end consists of slip and ending as
//! logits, and the pose at rest.

mod card;
mod cell;
mod layout;

pub use card::{LeverCard, LeverWeights};
pub use cell::{LeverCell, LeverOutput, tanh};
pub use layout::{
    LEVER_ENDS, LEVER_POSE, LeverSizes, fresh_lever, fresh_lever_values, lever_layout,
};
