//! Arm model: kinematics, limits, solids.

use serde::{Deserialize, Serialize};

use pushplan::geometry::{Pose3, Turn3, Vector3};
use pushplan::scene::MAX_JOINTS;

use super::hull::Hull;
use super::places::Places;

/// Maximum number of points of a solid, and of solids of a body.
const MOST: usize = 64;

/// Default maximum speed between pushes, radians or metres per second.
const USUAL_SPEED: f64 = 2.0;

/// Default maximum acceleration and jerk of revolute joints: a third to all of the limits of common
/// arms with six and seven joints (7.5 to 20 rad/s^2), and a tenth of their jerk.
const TURNING: [f64; 2] = [10.0, 200.0];

/// Default maximum acceleration and jerk of prismatic joints, m/s^2 and m/s^3: typical of lifts.
const SLIDING: [f64; 2] = [1.0, 20.0];

/// Distance that the planner keeps from joint limits, radians or metres, and its maximum as a share
/// of the range.
const MARGIN: f64 = 2e-3;
const MARGIN_SHARE: f64 = 0.01;

/// Movable joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmJoint {
    /// Name used by controllers.
    pub name: String,
    /// Whether the joint is prismatic; otherwise it is revolute.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub slides: bool,
    /// Joint frame at position zero, in the frame of the joint before.
    pub origin: Pose3,
    /// Unit axis in the joint frame.
    pub axis: Vector3,
    /// Lower and upper position limit, radians or metres; `None` for a continuous joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<[f64; 2]>,
    /// Maximum speed, radians or metres per second; `None` if unlimited.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_speed: Option<f64>,
    /// Maximum acceleration, radians or metres per second squared; `None` if unlimited, as in older
    /// plans.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_acceleration: Option<f64>,
    /// Maximum jerk, radians or metres per second cubed; `None` if unlimited.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_jerk: Option<f64>,
}

/// Rigid body that moves with a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmBody {
    /// Name of the link.
    pub name: String,
    /// Solids in the frame of the joint.
    pub solids: Vec<Hull>,
}

/// Mounting of the tool on the flange.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToolMount {
    /// Distance from the flange to the tool's underside along the flange's z axis, metres.
    pub length: f64,
    /// Rotation of the tool about that axis, radians.
    pub yaw: f64,
}

/// Serial arm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arm {
    /// Name of the robot.
    pub name: String,
    /// Pose of the base in the world.
    pub base: Pose3,
    /// Movable joints, from the base on.
    pub joints: Vec<ArmJoint>,
    /// Bodies: the base, then the body of each joint.
    pub bodies: Vec<ArmBody>,
    /// Links on other branches of the root at rest, such as a second arm, in the frame of the base.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<ArmBody>,
    /// Pairs of bodies to check for self-collision. Neighbours are excluded, and pairs whose convex
    /// solids overlap although the links do not. `beside` continues the count of `bodies`.
    pub pairs: Vec<[usize; 2]>,
    /// Flange in the frame of the last joint, with its z axis pointing outwards.
    pub flange: Pose3,
    /// Mounting of the tool.
    pub mount: ToolMount,
    /// Joint positions at the start of a plan, radians or metres.
    pub home: Vec<f64>,
    /// Feasible tool poses over the table, computed when a URDF is read.
    #[serde(default)]
    pub places: Places,
}

impl ArmJoint {
    /// Returns the joint frame at `position`, radians or metres, in the frame of the joint before.
    pub fn pose(&self, position: f64) -> Pose3 {
        let moved = match self.slides {
            true => Pose3 { position: self.axis * position, ..Pose3::default() },
            false => Pose3 {
                position: Vector3::zeros(),
                rotation: Turn3::from_scaled_axis(self.axis * position),
            },
        };
        self.origin * moved
    }

    /// Returns the position nearest to zero that the limits allow.
    pub fn rest(&self) -> f64 {
        self.limits.map_or(0.0, |[low, high]| 0.0_f64.clamp(low, high))
    }

    /// Returns the limits that the planner keeps, a little narrower, because the motion between two
    /// points may be beyond both.
    pub fn range(&self) -> Option<[f64; 2]> {
        let margin = |low: f64, high: f64| MARGIN.min(MARGIN_SHARE * (high - low));
        self.limits.map(|[low, high]| [low + margin(low, high), high - margin(low, high)])
    }

    /// Returns the maximum speed between pushes, radians or metres per second.
    pub fn speed(&self) -> f64 {
        self.max_speed.unwrap_or(USUAL_SPEED)
    }

    /// Returns the maximum acceleration, radians or metres per second squared.
    pub fn acceleration(&self) -> f64 {
        self.max_acceleration.unwrap_or(if self.slides { SLIDING[0] } else { TURNING[0] })
    }

    /// Returns the maximum jerk, radians or metres per second cubed.
    pub fn jerk(&self) -> f64 {
        self.max_jerk.unwrap_or(if self.slides { SLIDING[1] } else { TURNING[1] })
    }

    /// Returns the middle of the limits; 0 for a joint without limits.
    pub fn middle(&self) -> f64 {
        self.limits.map_or(0.0, |[low, high]| 0.5 * (low + high))
    }
}

impl Arm {
    /// Returns the pose of the flange relative to a tool whose end effector is at the origin, with
    /// its underside at height zero.
    pub fn flange_of_tool(&self) -> Pose3 {
        let down = Turn3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
        let turn = Turn3::from_axis_angle(&Vector3::z_axis(), self.mount.yaw);
        Pose3 { position: Vector3::z() * self.mount.length, rotation: down * turn }
    }

    /// Returns the links on the chain, then the links beside it.
    pub fn links(&self) -> impl Iterator<Item = &ArmBody> {
        self.bodies.iter().chain(&self.beside)
    }

    /// Returns a description of the first error in the model, if any.
    pub fn fault(&self) -> Option<String> {
        let finite =
            |pose: &Pose3| pose.is_finite() && (pose.rotation.coords.norm() - 1.0).abs() < 1e-6;
        let count = self.joints.len();
        if count == 0 || count > MAX_JOINTS {
            return Some(format!(
                "an arm must have 1 to {MAX_JOINTS} movable joints, but this one has {count}"
            ));
        }
        if self.bodies.len() != count + 1 || self.home.len() != count {
            return Some(
                "an arm must have one body more than joints, and one home position per joint"
                    .into(),
            );
        }
        for joint in &self.joints {
            let limits = joint
                .limits
                .is_none_or(|[low, high]| low.is_finite() && low < high && high.is_finite());
            let rates = [joint.max_acceleration, joint.max_jerk].into_iter().flatten();
            let rates = rates.chain(joint.max_speed).all(|rate| rate.is_finite() && rate > 0.0);
            let axis = (joint.axis.norm() - 1.0).abs() < 1e-6;
            if !(finite(&joint.origin) && axis && limits && rates) {
                let name = &joint.name;
                return Some(format!("joint `{name}` needs a finite pose, a unit axis and limits"));
            }
        }
        for (joint, at) in self.joints.iter().zip(&self.home) {
            if !at.is_finite() || joint.limits.is_some_and(|[low, high]| *at < low || *at > high) {
                return Some(format!(
                    "at home joint `{}` is at {at}, outside its limits",
                    joint.name
                ));
            }
        }
        let sound = |hull: &Hull| {
            (1..=MOST).contains(&hull.points.len())
                && hull.points.iter().all(|point| point.iter().all(|v| v.is_finite()))
                && hull.radius.is_finite()
                && hull.radius >= 0.0
        };
        for body in self.links() {
            if body.solids.len() > MOST || !body.solids.iter().all(sound) {
                return Some(format!("the solids of `{}` are not finite or too many", body.name));
            }
        }
        if self.pairs.iter().flatten().any(|body| *body > count + self.beside.len()) {
            return Some("the pairs of the arm name bodies that it does not have".into());
        }
        let mount = self.mount.length.is_finite() && self.mount.yaw.is_finite();
        (!(finite(&self.base) && finite(&self.flange) && mount))
            .then(|| "base, flange and mount must be finite".into())
    }
}
