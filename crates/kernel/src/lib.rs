//! The innermost loop of [`pushplan`](https://crates.io/crates/pushplan): the equations of a frame of one
//! pushed object that nothing is joined to, in at most two contacts, without lists and with several frames
//! side by side.
//!
//! Most frames of a search are of one pushed object, and each of its updates is one chain of quotients
//! and roots that the processor waits for. The chains of other candidates fill that waiting. Nothing in
//! a frame depends on those next to it, so a result is the same bits with any number of them.
//!
//! The crate holds numbers alone, and nothing that is specific to scenes or files. No function that calls its
//! vectorised code is generic, so that users of it compile none of that code again.

mod drag;
mod feet;
mod forces;
mod frames;
mod lanes;
mod lone;
mod motion;
mod object;
pub mod settings;
mod solution;
mod tally;
mod touching;
mod turn;

pub use drag::Drag;
pub use feet::{Feet, MAX_FEET};
pub use forces::MOST;
pub use lone::{LoneContact, LoneFrame, MANY, batch, solve};
pub use motion::Motion;
pub use solution::{Effort, LoneSolution};
pub use tally::Tally;
pub use touching::Follows;
pub use turn::{Turn, sines};

/// A planar vector.
pub type Vector = nalgebra::Vector2<f64>;
