//! What is levered, with what, how, and what came of it.
//!
//! A lever goes under the edge of a plate and turns about a horizontal axis. Plates move in all six
//! degrees of freedom, so their scenes, actions and trajectories are types of their own beside the
//! planar ones.

mod action;
mod features;
mod follow_up;
mod goal;
mod motion;
mod outcome;
mod plan;
mod plate;
mod scene;
mod support;
mod task;
mod trajectory;
mod verdict;
mod weight;

pub use action::{LeverJob, LeverUp, Place, lever_frame};
pub use features::LeverFeatures;
pub use follow_up::FollowUp;
pub use goal::LeverOutcome;
pub use motion::{LeverFrame, LeverMotion};
pub use outcome::{Ending, LeverWarning};
pub use plan::LeverPlan;
pub use plate::{Plate, Slab};
pub use scene::{Blade, LeverScene};
pub use task::{LeverRules, Pivot};
pub use trajectory::{LEVER_FRAMES, LeverTrajectory, has_slipped};
pub use verdict::{LeverEvidence, LeverFault, LeverReason, LeverVerdict};
pub use weight::Weight;
