//! A task and the plans for it: goals, rules, steps and tool motions.
//!
//! A [`Task`] is a scene with a robot, rules for steps and goals. A [`Plan`] is a list of steps, a
//! [`Motion`] is the path of a tool, and a [`Job`] is a motion that begins in a situation. SI units
//! and radians throughout. This module reads no files and simulates nothing.

mod arm;
mod definition;
pub mod demand;
mod goal;
mod goal_error;
mod goal_in_code;
mod job;
mod lever;
mod motion;
mod observation;
mod plan;
mod push_rules;
mod travel;
mod truth;

pub use arm::{ArmReader, ArmRefusal, ArmSource, Followed, RobotArm, StatedArm, read_arms_with};
pub use definition::{Task, ToolChoice};
pub use demand::{
    Area, AtPlace, Check, Coverage, Demand, Edge, End, Ending, Facing, Fall, Flipped, Gap, InArea,
    Kind, Lift, Mark, Outside, Quantity, Raised, ShownGoal, Swing,
};
pub use goal::{Aspect, Goal};
pub use job::Job;
pub use lever::{LeverJob, LeverRules, LeverUp, Pivot, Place, lever_frame};
pub use motion::{
    COAST_FRAME, FrameStep, LeverMotion, MAX_COAST_FRAMES, Motion, Push, RETREAT, Stroke,
    ToolMotion,
};
pub use observation::{Noise, Observation};
pub use plan::{LeverStep, Plan, PushStep, Step};
pub use push_rules::{Directions, Offsets, PushForm, PushRules};
pub use travel::{BlockedLeg, ReachablePositions, TravelLeg};
pub use truth::Truth;

pub(crate) use arm::read_arm;
