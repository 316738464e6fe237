//! The belief regulator's recurrent cell: its parameters, its step and its weights file.
//!
//! A gated recurrent unit per pair of objects (Cho et al., EMNLP 2014) on evidence about that pair and
//! on the effects of the frozen propagation network, with messages between pairs that share an object
//! (Tekden et al., ICRA 2020, section III-C; thesis 7.2.3 and 8.1.1). With features x_p `[F]`, hidden
//! states h_p `[H]` and the message m_p = the sum of h_q over pairs q != p that share an object with p,
//! counted once for each shared object:
//!
//! ```text
//! r, z, c = x W_x + m W_m + b,  with h W_h
//! r = sigmoid(r_x + r_h)   z = sigmoid(z_x + z_h)   c = tanh(c_x + r (c_h + b_c))
//! h' = (1 - z) c + z h     l, t = relu(h' V_h + m' V_m + b_v) V + b_l
//! ```
//!
//! The logits l of the four types of joints, which start at zero, are added to the filter's
//! logarithms times 2 sigmoid(t), which starts at one: a filter that is too sure of itself should
//! not be outweighed, but believed less.

mod card;
mod cell;
mod layout;

pub use card::{RegulatorCard, RegulatorWeights};
pub use cell::{LEAST, Memory, Regulator};
pub use layout::{TYPES, fresh_regulator, regulator_layout};
