//! Arms: joints, what hangs on them, where their tools are mounted, and how they move.

mod fault;
mod model;
mod motion;
mod places;

pub use fault::ArmFault;
pub use model::{Arm, ArmBody, ArmJoint, MAX_JOINTS, ToolMount};
pub use motion::{JointPoint, JointTrajectory};
pub use places::Places;
