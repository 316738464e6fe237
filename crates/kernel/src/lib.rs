//! The innermost loop of [`pushplan`](https://crates.io/crates/pushplan): the equations of a frame
//! of one pushed object without joints, in at most two contacts. Several frames are solved side by
//! side, without lists.
//!
//! A search mostly has frames of one pushed object. Each of its updates is one chain of quotients
//! and roots that the processor waits for, and the chains of other candidates fill that time. A
//! frame does not depend on its neighbours, so a result has the same bits with any number of them.
//!
//! The crate holds numbers alone, and nothing that is specific to scenes or files. No function that
//! calls its vectorised code is generic, so that users of the crate compile none of that code
//! again.

mod drag;
mod feet;
mod forces;
mod frames;
mod lanes;
mod motion;
mod object;
pub mod settings;
mod single_body;
mod solution;
mod stats;
mod touching;
mod turn;

pub use drag::Drag;
pub use feet::{Feet, MAX_FEET};
pub use forces::MOST;
pub use motion::Motion;
pub use single_body::{MANY, SingleBodyContact, SingleBodyFrame, batch, solve};
pub use solution::{Effort, SingleBodySolution};
pub use stats::SolverStats;
pub use touching::Follows;
pub use turn::{Turn, sines};

/// A planar vector.
pub type Vector = nalgebra::Vector2<f64>;
