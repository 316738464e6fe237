//! The network of lever-ups: what it is made of, how it computes and how it is kept.
//!
//! A long short-term memory (Hochreiter and Schmidhuber 1997; Tekden 2020, chapter 6) that is told
//! the same features in every frame and predicts every pose at once, not fed with its own
//! predictions. With features s [S] of a lever-up, x_t [M] of a frame, and hidden states h_t [H]:
//!
//! ```text
//! i, f, g, o = s W_s + x_t W_x + h_{t-1} W_h + b
//! c_t = sigmoid(f) c_{t-1} + sigmoid(i) tanh(g)      h_t = sigmoid(o) tanh(c_t)
//! pose_t = base_t + h_t V + a                        end = base + relu(h_T U + b_u) V_e + a_e
//! ```
//!
//! For comparison with the thesis a network can be fed with the pose that it predicted last.
//!
//! `base` is what the prior says, or the start. The end is slip and ending as logits, and the pose at
//! rest.

mod card;
mod cell;
mod layout;

pub use card::{LeverCard, LeverWeights};
pub use cell::{LeverCell, LeverTold, tanh};
pub use layout::{
    LEVER_ENDS, LEVER_POSE, LeverSizes, fresh_lever, fresh_lever_values, lever_layout,
};
