//! The plain data of scenes.
//!
//! - What is *seen* or stated in a file: objects, obstacles, tools, tasks and goals.
//! - What is *believed*: [`Physics`]. A [`Situation`] is a scene, where everything is now, and
//!   what is believed about it; a [`Job`] is a tool motion that begins in one.
//! - What *happened*: trajectories, plans and verdicts.
//!
//! No files are read here, nothing is simulated and nothing is decided; every other module takes
//! and returns these types. SI units and radians throughout.

mod area;
mod arm;
mod balance;
mod coverage;
mod drag;
mod fall;
mod feet;
mod fixed;
mod friction;
mod gap;
mod goal;
mod groups;
mod guess;
mod hand;
mod job;
mod joint;
mod keep;
mod lever;
mod missed;
mod model;
mod motion;
mod mount;
mod near;
mod observation;
mod obstacle;
mod outcome;
mod outline;
mod physics;
mod plan;
mod planar;
mod push_fault;
mod quantity;
mod raised;
mod ranges;
mod region;
mod separation;
mod sets;
mod situation;
mod state;
mod support;
mod table_fit;
mod task;
mod tool;
mod trajectory;
mod truth;
mod underside;
mod unknowns;
mod verdict;
mod warning;
mod way;
mod whole;
mod world;

pub use area::Area;
pub use arm::{
    Arm, ArmBody, ArmFault, ArmJoint, JointPoint, JointTrajectory, MAX_JOINTS, Places, ToolMount,
};
pub use balance::carries;
pub use coverage::Coverage;
pub use drag::Drag;
pub use fall::{Edge, Fall};
pub use feet::{Feet, MAX_FEET};
pub use fixed::{Fixed, Mover};
pub use friction::{PairFriction, Surface, pair_friction};
pub use gap::Gap;
pub use goal::Goal;
pub use groups::RigidGroups;
pub use guess::NEARLY_TOUCHING;
pub use hand::{Carried, Hand, SHOWN_HAND};
pub use job::{Job, in_turn};
pub use joint::{Joint, JointKind};
pub use lever::{
    Blade, Ending, LEVER_FRAMES, LeverFault, LeverFeatures, LeverFrame, LeverJob, LeverRecord,
    LeverRules, LeverScene, LeverTrajectory, LeverUp, LeverWarning, Pivot, Place, Plate, Slab,
    Weight, has_slipped, lever_frame,
};
pub use model::{
    Assumptions, CORRECTED, JointBelief, ModelKind, ModelPart, ModelSpec, Models, Rate, SpecError,
    Stride,
};
pub use motion::{
    COAST_FRAME, FRAME_TRAVEL, FrameStep, LeverMotion, MAX_COAST_FRAMES, Motion, Push, REST_SPEED,
    RETREAT, Stroke, ToolMotion,
};
pub use mount::Mount;
pub use near::{JOINABLE, NearPair, near_pairs, pairs_within};
pub use observation::{Noise, Observation, Sight};
pub use obstacle::Obstacle;
pub use outcome::{Lying, Miss, Outcome};
pub use outline::Piece;
pub use physics::{Physics, face_height};
pub use plan::{Engine, LeverStep, Plan, PushStep, Step};
pub use push_fault::PushFault;
pub use quantity::Quantity;
pub use raised::{bearings, hanging};
pub use ranges::{Ranges, Span, TRAINED_SLANT, TRAINED_SLIDE, TRAINED_TURN, slant};
pub use region::Region;
pub use separation::{JOINT_ARM, Misfit, Separation};
pub use sets::DisjointSets;
pub use situation::Situation;
pub use state::{State, Velocity};
pub use support::Support;
pub use table_fit::{FittedObject, HeadSpread, Narrowed, OTHER_OBJECTS, TableFit};
pub use task::{Directions, Offsets, PushForm, PushRules, Robot, Task, ToolChoice};
pub use tool::{JOIN_GAP, Part, Tool, ToolError};
pub use trajectory::{Body, Contact, Force, Frame, Lift, Record, Spread, TOUCHING, Trajectory};
pub use truth::Truth;
pub use unknowns::Unknowns;
pub use verdict::{Disturbance, Evidence, Reason, Verdict, never_on};
pub use warning::Warning;
pub use way::Way;
pub use whole::Whole;
pub use world::{GRAVITY, Object, Scene, TableTop};
