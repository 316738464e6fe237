//! Export errors.

use thiserror::Error;

/// Error of writing a plan in another program's format.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ExportError {
    /// Joints that form a loop, while MuJoCo's bodies form trees; no file of pushplan contains such
    /// a scene.
    #[error("the joint between `{}` and `{}` closes a loop, which MJCF's trees of bodies cannot \
             represent", between[0], between[1])]
    JointLoop {
        /// Names of the two objects.
        between: [String; 2],
    },
    /// Plan of a robot without an arm, or solved without one.
    #[error("the plan has no joint motion; solve a task whose `robot` has a `urdf`")]
    NoJoints,
    /// Plan without its tools, which plan files always contain.
    #[error("the plan's steps name tools that the file does not contain")]
    Tools,
    /// Trajectory that cannot be written, for example because it has more frames than a file can
    /// count.
    #[error("the plan cannot be written as MCAP: {0}")]
    Mcap(String),
}
