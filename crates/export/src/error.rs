//! Why a plan cannot be exported.

use thiserror::Error;

/// Why a plan cannot be written in another program's format.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ExportError {
    /// MuJoCo's bodies form trees; no file of pushplan holds such a scene.
    #[error("the joint between `{}` and `{}` closes a loop, which MJCF's trees of bodies cannot hold", between[0], between[1])]
    JointLoop {
        /// Names of the two objects.
        between: [String; 2],
    },
    /// A plan of a robot without an arm, or that was not solved with it.
    #[error("it has no motion of joints; solve a task whose `robot` has a `urdf`")]
    NoJoints,
    /// A plan without its tools; a file of ours never holds one.
    #[error("its steps name tools that the file does not hold")]
    Tools,
    /// A trajectory that cannot be written, such as one of more frames than a file can count.
    #[error("it cannot be written as MCAP: {0}")]
    Mcap(String),
}
