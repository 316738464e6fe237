//! Results of lever-ups.

mod after;
mod ending;
mod fault;
mod trajectory;

pub use ending::LeverWarning;
pub use fault::LeverFault;
pub use trajectory::{LEVER_FRAMES, LeverTrajectory, has_slipped};
