//! Robot arms: the interface through which the core plans and checks joint motions.
//!
//! The core has no arm of its own. A crate that has one registers its reader with
//! [`read_arms_with`]; task and plan files can then state such an arm.

use std::any::Any;
use std::fmt::Debug;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value as Json;

use super::{Plan, PushRules, Task};
use crate::geometry::{Pose3, Vector};
use crate::scene::{Annulus, ArmFault, JointTrajectory, Obstacle, Robot, Scene, State, Tool};

/// The joint trajectory that carries out a plan, or the first infeasible push and the reason.
pub type Followed = Result<JointTrajectory, (usize, ArmFault)>;

/// A robot arm that holds tools over the table.
pub trait RobotArm: Any + Debug + Send + Sync {
    /// Returns the annulus in which it holds a tool, about its own base.
    fn annulus(&self) -> Annulus;

    /// Returns the distance from its flange to the underside of a tool, metres.
    fn mount_length(&self) -> f64;

    /// Returns the position below its flange at the start of a plan, metres.
    fn home(&self) -> Vector;

    /// Returns `false` if it certainly cannot hold a tool at a position (metres) with its end
    /// effector rotated by `yaw` (radians); a cheap test for searches.
    fn allows(&self, position: Vector, yaw: f64) -> bool;

    /// Returns the boxes around the solids that stand on the table with its root, as obstacles
    /// whose names begin with [`Robot::BASE`](crate::scene::Robot::BASE).
    fn foot(&self) -> Vec<Obstacle>;

    /// Returns the inconsistency in its description, if any.
    fn fault(&self) -> Option<String>;

    /// Plans the joint motion for the pushes of a plan. `states` are the known states of the
    /// objects before the first push and after each push.
    ///
    /// # Errors
    /// Returns the first push that the arm cannot execute from any joint configuration, and the
    /// reason.
    fn follow(
        &self,
        task: &Task,
        scene: &Scene,
        tool: &Arc<Tool>,
        plan: &Plan,
        states: &[State],
    ) -> Followed;

    /// Returns the first fault of every push that a trajectory does not carry out; `states` as in
    /// [`RobotArm::follow`].
    fn judge(
        &self,
        scene: &Scene,
        tool: &Arc<Tool>,
        plan: &Plan,
        states: &[State],
        path: &JointTrajectory,
    ) -> Vec<(usize, ArmFault)>;

    /// Returns the arm in the form stored in plan files.
    fn to_json(&self) -> Json;
}

impl dyn RobotArm {
    /// Returns the reason against a tool and the remedy, if the tool is higher than the mount is
    /// long: it would be inside the arm.
    pub fn refuses(&self, tool: &Tool) -> Option<(String, String)> {
        let (height, length) = (tool.height(), self.mount_length());
        // A millionth of a metre is a rounding of files.
        (height > length + 1e-6).then(|| {
            let message = format!(
                "`{}` is {height:.3} m high, but its underside is only {length:.3} m below the \
                 flange, so it would be inside the arm",
                tool.name
            );
            let advice = format!(
                "write `tool_mount: {{length: {height:.3}}}` or more, or choose a lower tool"
            );
            (message, advice)
        })
    }

    /// Returns the arm as its own type.
    pub fn downcast<T: RobotArm>(&self) -> Option<&T> {
        (self as &dyn Any).downcast_ref()
    }
}

impl PartialEq for dyn RobotArm {
    fn eq(&self, other: &Self) -> bool {
        self.to_json() == other.to_json()
    }
}

/// The source of an arm's description.
#[derive(Clone, Debug)]
pub enum ArmSource<'a> {
    /// A URDF file.
    Urdf {
        /// Path of the file.
        path: PathBuf,
        /// Name of the link on which tools are mounted.
        flange: &'a str,
        /// Pose of the root link in the world.
        base: Pose3,
        /// Distance from the flange to the tool's underside, metres.
        length: f64,
        /// Rotation of the tool about the axis out of the flange, radians.
        yaw: f64,
        /// Axis of the flange's frame that points out of it: 0 to 2 for x, y and z, 3 to 5 for
        /// their opposites.
        axis: usize,
        /// Maximum accelerations: none to use the values of the file, one for all joints, or one
        /// for each.
        accelerations: Vec<f64>,
        /// Maximum jerks, likewise.
        jerks: Vec<f64>,
    },
    /// The form stored in plan files, see [`RobotArm::to_json`].
    Saved(Json),
}

/// The description of an arm in a file.
#[derive(Clone, Debug)]
pub struct StatedArm<'a> {
    /// Source of the description.
    pub source: ArmSource<'a>,
    /// Joint positions at the start of plans, radians or metres; `None` for the arm's own.
    pub home: Option<Vec<f64>>,
    /// Height of the tool above the table while it pushes, metres.
    pub lift: f64,
    /// Height of the tool above the table between pushes, metres.
    pub travel: f64,
}

/// The reason why an arm cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArmRefusal {
    /// Description of the fault.
    pub message: String,
    /// Remedy.
    pub advice: String,
    /// Whether the fault is in the stated home.
    pub at_home: bool,
}

/// A function that reads arms.
pub type ArmReader = fn(&StatedArm) -> Result<Arc<dyn RobotArm>, ArmRefusal>;

/// The only reader of the program, global because files are read in many places.
static READER: OnceLock<ArmReader> = OnceLock::new();

/// Registers the reader of arms; only the first one counts.
pub fn read_arms_with(reader: ArmReader) {
    let _ = READER.set(reader);
}

/// Reads an arm with the registered reader.
pub(crate) fn read_arm(stated: &StatedArm) -> Result<Arc<dyn RobotArm>, ArmRefusal> {
    let none = || ArmRefusal {
        message: "this program cannot read arms".into(),
        advice: "register a reader of arms first, such as the one in the crate `pushplan-arm`"
            .into(),
        at_home: false,
    };
    READER.get().ok_or_else(none)?(stated)
}

pub(super) fn serialize<S: Serializer>(
    arm: &Option<Arc<dyn RobotArm>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    arm.as_ref().map(|arm| arm.to_json()).serialize(serializer)
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Arc<dyn RobotArm>>, D::Error> {
    let Some(json) = Option::<Json>::deserialize(deserializer)? else { return Ok(None) };
    let stated = StatedArm {
        source: ArmSource::Saved(json),
        home: None,
        lift: PushRules::LIFT,
        travel: Robot::TRAVEL,
    };
    read_arm(&stated).map(Some).map_err(|refusal| serde::de::Error::custom(refusal.message))
}
