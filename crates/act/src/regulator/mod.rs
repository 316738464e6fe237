//! Recurrent cell of the belief regulator: parameters, inference and weights file.
//!
//! The cell is a gated recurrent unit per pair of objects (Cho et al., EMNLP 2014). Its input is
//! evidence about the pair and the effects of the frozen propagation network. Pairs that share an
//! object exchange messages (Tekden et al., ICRA 2020, section III-C; Tekden 2020, sections 7.2.3
//! and 8.1.1).
//!
//! Each pair p has features x_p `[F]`, a hidden state h_p `[H]` and a message m_p. The message is
//! the sum of h_q over pairs q != p, counted once for each object shared with p:
//!
//! ```text
//! r, z, c = x W_x + m W_m + b,  with h W_h
//! r = sigmoid(r_x + r_h)   z = sigmoid(z_x + z_h)   c = tanh(c_x + r (c_h + b_c))
//! h' = (1 - z) c + z h     l, t = relu(h' V_h + m' V_m + b_v) V + b_l
//! ```
//!
//! The logits l of the four joint types start at zero. They are added to the filter's logarithms
//! times 2 sigmoid(t), which starts at one. An overconfident filter is thus scaled down instead of
//! outweighed.

mod card;
mod cell;
mod layout;

pub use card::{RegulatorCard, RegulatorWeights};
pub use cell::{LEAST, Memory, Regulator};
pub use layout::{TYPES, fresh_regulator, regulator_layout};
