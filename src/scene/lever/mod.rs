//! What is levered, with what, how, and what came of it.
//!
//! A lever goes under the edge of a plate and turns about a horizontal axis. Plates move in all six
//! degrees of freedom, so their scenes, actions and trajectories are types of their own beside the
//! planar ones.

mod action;
mod after;
mod fault;
mod features;
mod motion;
mod outcome;
mod plate;
mod scene;
mod support;
mod task;
mod trajectory;
mod weight;

pub use action::{LeverJob, LeverUp, Place, lever_frame};
pub use fault::LeverFault;
pub use features::LeverFeatures;
pub use motion::{LeverFrame, LeverRecord};
pub use outcome::{Ending, LeverWarning};
pub use plate::{Plate, Slab};
pub use scene::{Blade, LeverScene};
pub use task::{LeverRules, Pivot};
pub use trajectory::{LEVER_FRAMES, LeverTrajectory, has_slipped};
pub use weight::Weight;
