//! The equations of a frame: the effect of contacts, joints, table friction and inertia on a state
//! during a small motion of the tool.
//!
//! The solution is in closed form and implicit, second order in time, with joints eliminated, and
//! independent of any order. Objects that nothing can push in a frame slide freely or stay,
//! exactly. This module contains no learning and does not depend on the network that corrects its
//! results. It solves single frames, or frames of several candidates side by side: the loop over
//! time is in [`crate::rollout`].

mod active;
mod approach;
mod awake;
mod blocks;
mod bodies;
mod coast;
mod constraint;
mod eliminated;
mod elimination;
mod fall;
mod forces;
mod frame;
mod gain;
mod hold;
mod index;
mod joint;
mod limb;
mod lone;
mod march;
mod midway;
mod pairs;
mod points;
mod prior;
mod sight;
mod solver;
mod subset;
mod system;
mod twist;
mod unknown;

pub use pushplan_kernel::{Motion, Tally};

pub use bodies::{Bodies, Given, Groups, Jointed, Mounted, Movable, Partner};
pub use forces::FrameForces;
pub use frame::{Frame, FrameProblem, FrameSolution, Touch};
pub use hold::hold;
pub use index::{AwakeIndex, GroupIndex, Index, ListIndex, SceneIndex};
pub use pairs::{PairId, Pairs};
pub use points::{Contact, MARGIN};
pub use sight::Sight;
pub use solver::FrameSolver;
pub use subset::Subset;
