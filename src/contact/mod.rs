//! The equations of a frame: what contacts, joints, friction with the table and inertia make of
//! a state while the tool moves a little.
//!
//! Closed form and implicit, second order in time, joints eliminated, independent of any order;
//! objects that nothing can push in a frame coast or stay, exactly. Nothing is learned here, and
//! nothing is known of the network that corrects it. One frame at a time, or those of candidates side
//! by side: the loop over time is in [`crate::rollout`].

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
