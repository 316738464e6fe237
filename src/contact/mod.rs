//! The equations of a frame: the effect of contacts, joints, table friction and inertia on a state
//! during a small motion of the tool.
//!
//! The solution is in closed form and implicit, second order in time, with joints eliminated, and
//! independent of any order. Objects that nothing can push in a frame slide freely or stay,
//! exactly. This module contains no learning and does not depend on the network that corrects its
//! results. It solves single frames, or frames of several candidates side by side: the loop over
//! time is in [`crate::rollout`].

mod active_set;
mod awake;
mod blocks;
mod bodies;
mod constraint;
mod contact_side;
mod eliminated;
mod elimination;
mod fall;
mod fixed_joints;
mod forces;
mod frame;
mod free_sliding;
mod index;
mod iterative;
mod joint;
mod joint_projection;
mod midpoint;
mod pairs;
mod points;
mod prior;
mod single_body;
mod solver;
mod subset;
mod substeps;
mod system;
mod tree_link;
mod twist;
mod unknown;
mod warm_start;

pub use pushplan_kernel::{Motion, SolverStats};

pub use bodies::{Bodies, Groups, Jointed, Mounted, Movable, Partner, PrescribedBody};
pub use contact_side::ContactSide;
pub use forces::FrameForces;
pub use frame::{Frame, FrameProblem, FrameSolution, Touch};
pub use index::{AwakeIndex, GroupIndex, Index, ListIndex, SceneIndex};
pub use joint_projection::project_joints;
pub use pairs::{PairId, Pairs};
pub use points::{Contact, MARGIN};
pub use solver::FrameSolver;
pub use subset::Subset;
