//! Results of lever-ups.

mod after;
mod ending;
mod fault;
mod frame;
mod trajectory;

pub use ending::LeverWarning;
pub use fault::LeverFault;
pub use frame::{LeverFrame, LeverRecord};
pub use trajectory::{LEVER_FRAMES, LeverTrajectory, has_slipped};
