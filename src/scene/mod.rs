//! The plain data of the field: objects, tools, tasks, motions, trajectories, plans.
//!
//! No files are read here, nothing is simulated and nothing is decided; every other room takes
//! and gives these types. SI units and radians throughout.

mod groups;
mod guess;
mod hypothesis;
mod job;
mod joint;
mod motion;
mod plan;
mod ranges;
mod state;
mod task;
mod tool;
mod trajectory;
mod warning;
mod world;

pub use guess::NEARLY_TOUCHING;
pub use hypothesis::Hypothesis;
pub use job::Job;
pub use joint::{Joint, JointKind};
pub use motion::{
    COAST_FRAME, FRAME_TRAVEL, FrameStep, MAX_COAST_FRAMES, Push, REST_SPEED, Stroke, ToolMotion,
};
pub use plan::{Engine, Evidence, Outcome, Plan, Verdict};
pub use ranges::{Ranges, Span, TRAINED_SLIDE, TRAINED_TURN};
pub use state::{State, Velocity};
pub use task::{Directions, Goal, Offsets, PushForm, PushRules, Robot, Task, ToolChoice};
pub use tool::{Part, Tool, ToolError};
pub use trajectory::{Body, Contact, Frame, Record, Trajectory};
pub use warning::Warning;
pub use world::{GRAVITY, Object, Obstacle, Scene};
