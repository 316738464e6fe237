//! The plain data of scenes: objects, joints, obstacles, tools, the robot, physics and state.
//!
//! [`Physics`] holds assumed physical parameters; a [`Situation`] is a scene with these and the
//! state of all objects. Goals and motions are in `task`, results in `outcome`. SI units and
//! radians throughout. This module reads no files, simulates nothing and searches nothing.

mod arm_fault;
mod balance;
mod body;
mod compound;
mod feet;
mod fixed;
mod friction;
mod groups;
mod hand;
mod joint;
mod joint_hypothesis;
mod joint_trajectory;
mod lever;
mod model;
mod near;
mod object;
mod observed_pose;
mod obstacle;
mod outline;
mod part;
mod physics;
mod quantity;
mod raised;
mod ranges;
mod region;
mod robot;
mod separation;
mod serde_planar;
mod sets;
mod situation;
mod span;
mod state;
mod support;
mod table_fit;
mod tool;
mod underside;
mod unknowns;
mod world;
mod world_joint;

pub use arm_fault::ArmFault;
pub use balance::carries;
pub use body::{Body, TOUCHING};
pub use pushplan_kernel::settings::JOINT_ARM;
pub use pushplan_kernel::{Drag, Feet, MAX_FEET};

pub use feet::{few, fewer};
pub use fixed::{Fixed, Mover};
pub use friction::{PairFriction, Surface, pair_friction};
pub use groups::RigidGroups;
pub use hand::{Carried, Hand, SHOWN_HAND};
pub use joint::{Joint, JointKind};
pub use joint_hypothesis::NEARLY_TOUCHING;
pub use joint_trajectory::{JointPoint, JointTrajectory, MAX_JOINTS};
pub use lever::{Blade, LeverFeatures, LeverScene, Plate, Slab, Weight, stands_on};
pub use model::{
    Assumptions, CORRECTED, Engine, FRAME_TRAVEL, JointBelief, ModelKind, ModelPart, ModelSpec,
    Rate, SpecError, Stride,
};
pub use near::{JOINABLE, NearPair, near_pairs, pairs_within};
pub use object::{Object, Whole};
pub use observed_pose::ObservedPose;
pub use obstacle::Obstacle;
pub use outline::Piece;
pub use part::Part;
pub use physics::{Physics, face_height};
pub use quantity::Quantity;
pub use raised::{bearings, hanging};
pub use ranges::{Ranges, TRAINED_IMBALANCE, TRAINED_SLANT, TRAINED_SLIDE, TRAINED_TURN, slant};
pub use region::Region;
pub use robot::{Annulus, Robot};
pub use separation::{Misfit, Separation};
pub use sets::DisjointSets;
pub use situation::Situation;
pub use span::Span;
pub use state::{REST_SPEED, State, Velocity};
pub use support::Support;
pub use table_fit::{FittedObject, HeadSpread, Narrowed, OTHER_OBJECTS, TableFit};
pub use tool::{JOIN_GAP, Tool, ToolError};
pub use unknowns::Unknowns;
pub use world::{GRAVITY, Scene, TableTop};
pub use world_joint::WorldJoint;

pub(crate) use serde_planar::{is_zero, planar_only};
