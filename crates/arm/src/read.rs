//! Reader for the arms of task and plan files, and its interface to the core library.

use std::sync::Arc;

use pushplan::geometry::{Turn3, Vector, Vector3};
use pushplan::scene::{Annulus, ArmFault, JointTrajectory, Obstacle, Scene, State, Tool};
use pushplan::task::{
    ArmRefusal, ArmSource, Followed, Plan, RobotArm, StatedArm, Task, read_arms_with,
};

use super::find::{find_places, usual_home};
use super::follow::follow;
use super::foot::foot;
use super::judge::judge;
use super::kinematics::{flange, frames, level};
use super::model::Arm;
use super::places::Places;
use super::room::pairs;

/// Error message and remedy.
pub(super) type Wrong = (String, String);

/// Error of the height of a tool that is corrected for an arm whose joints all move horizontally,
/// metres.
const LEVELLED: f64 = 1e-3;

/// Lengths of a tool mount that are tried for an arm that cannot reach the table, metres.
const SHORTER: [f64; 3] = [0.1, 0.07, 0.05];

const AGAIN: &str = "the file is damaged or from another version; create it again";

/// Registers the reader of this crate, for arms of URDF files and of plan files.
pub fn install() {
    read_arms_with(|stated| Ok(Arc::new(read(stated)?)));
}

fn read(stated: &StatedArm) -> Result<Arm, ArmRefusal> {
    let refused = |(message, advice): Wrong| ArmRefusal { message, advice, at_home: false };
    let saved = matches!(stated.source, ArmSource::Saved(_));
    let mut arm = match &stated.source {
        ArmSource::Saved(json) => serde_json::from_value(json.clone())
            .map_err(|error| refused((format!("the arm is not valid: {error}"), AGAIN.into())))?,
        urdf => from_urdf(urdf).map_err(refused)?,
    };
    if let Some(home) = &stated.home {
        if home.len() != arm.joints.len() {
            let message = format!(
                "`home` has {} numbers, but the arm has {} joints",
                home.len(),
                arm.joints.len()
            );
            let advice = format!("give one number for each of {}, radians", names(&arm));
            return Err(ArmRefusal { message, advice, at_home: true });
        }
        arm.home.clone_from(home);
    }
    if let Some(fault) = arm.fault() {
        let advice = if saved { AGAIN.into() } else { String::new() };
        return Err(refused((fault, advice)));
    }
    if !saved {
        arm.pairs = pairs(&arm);
        let offset = level(&arm, &frames(&arm, &arm.home), stated.lift);
        arm.mount.length += offset.filter(|offset| offset.abs() <= LEVELLED).unwrap_or(0.0);
    }
    let known = Some(arm.places.clone()).filter(Places::known);
    let Some(places) = known.or_else(|| find_places(&arm, stated.lift)) else {
        let axis = match &stated.source {
            ArmSource::Urdf { axis, .. } => *axis,
            ArmSource::Saved(_) => 2,
        };
        let (message, advice) = unable(&arm, stated.lift, axis);
        return Err(refused((message, advice)));
    };
    arm.places = places;
    if !saved
        && stated.home.is_none()
        && let Some(home) = usual_home(&arm, [stated.lift, stated.travel])
    {
        arm.home = home;
    }
    Ok(arm)
}

/// Returns the reason why an arm cannot hold a tool above the table anywhere, and the remedy.
/// `axis` points out of the flange, see [`ArmSource::Urdf`].
fn unable(arm: &Arm, lift: f64, axis: usize) -> Wrong {
    let able = |other: usize, length: f64| {
        let mut turned = arm.clone();
        turned.flange.rotation *= outwards(axis).inverse() * outwards(other);
        turned.mount.length = length;
        find_places(&turned, lift).is_some()
    };
    let word = |axis: usize| ["x", "y", "z", "-x", "-y", "-z"][axis];
    let mut others = (0..6).filter(|other| *other != axis);
    let length = arm.mount.length;
    let mut shorter = SHORTER.into_iter().filter(|shorter| *shorter < length);
    let base = arm.base.position.z;
    let message = match level(arm, &frames(arm, &arm.home), lift) {
        Some(offset) if offset.abs() > LEVELLED => {
            let message = format!(
                "all joints of this arm move horizontally, with the tool {:.1} mm {} the height \
                 at which it pushes",
                offset.abs() * 1e3,
                if offset > 0.0 { "above" } else { "below" }
            );
            let advice = format!("write `base_pose: {{height: {:.4}}}`", base - offset);
            return (message, advice);
        }
        _ if arm.joints.len() < 5 => format!(
            "with {} joints this arm cannot choose position, height and rotation of a tool that \
             points down",
            arm.joints.len()
        ),
        _ => format!(
            "this arm cannot hold a tool above the table with its flange {:.2} m above it and \
             pointing down",
            length + lift
        ),
    };
    let advice = if let Some(other) = others.find(|other| able(*other, length)) {
        format!("write `tool_mount: {{axis: {}}}`", word(other))
    } else if let Some(shorter) = shorter.find(|shorter| able(axis, *shorter)) {
        format!("it can with `tool_mount: {{length: {shorter}}}` and tools at most that high")
    } else {
        format!(
            "the {} axis of `flange` must point out of it; check `base_pose` and `tool_mount` as \
             well",
            word(axis)
        )
    };
    (message, advice)
}

/// Returns the rotation that turns the z axis of a frame to one of its axes, as counted by
/// [`ArmSource::Urdf`].
fn outwards(axis: usize) -> Turn3 {
    let sign = if axis < 3 { 1.0 } else { -1.0 };
    let to = sign * Vector3::ith(axis % 3, 1.0);
    let about = Turn3::rotation_between(&Vector3::z(), &to);
    about.unwrap_or(Turn3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI))
}

/// Returns the names of the joints.
fn names(arm: &Arm) -> String {
    let names: Vec<&str> = arm.joints.iter().map(|joint| &*joint.name).collect();
    names.join(", ")
}

#[cfg(feature = "urdf")]
fn from_urdf(source: &ArmSource) -> Result<Arm, Wrong> {
    let ArmSource::Urdf { path, flange, base, length, yaw, axis, accelerations, jerks } = source
    else {
        return Err((AGAIN.into(), String::new()));
    };
    let mount = super::model::ToolMount { length: *length, yaw: *yaw };
    let mut arm = Arm { base: *base, mount, ..super::urdf::chain(path, flange)? };
    arm.flange.rotation *= outwards(*axis);
    let count = arm.joints.len();
    for (what, stated) in [("acceleration", accelerations), ("jerk", jerks)] {
        if ![0, 1, count].contains(&stated.len()) {
            let message = format!(
                "`joint_limits` has {} numbers for `{what}`, but the arm has {count} joints",
                stated.len()
            );
            return Err((message, format!("give one number for each of {}", names(&arm))));
        }
    }
    for (k, joint) in arm.joints.iter_mut().enumerate() {
        let stated =
            |from: &[f64]| from.get(k).or(from.first().filter(|_| from.len() == 1)).copied();
        joint.max_acceleration = stated(accelerations).or(Some(joint.acceleration()));
        joint.max_jerk = stated(jerks).or(Some(joint.jerk()));
    }
    Ok(arm)
}

#[cfg(not(feature = "urdf"))]
fn from_urdf(_: &ArmSource) -> Result<Arm, Wrong> {
    let advice = "build it with the feature `urdf` of `pushplan-arm`";
    Err(("this program was built without support for URDF".into(), advice.into()))
}

impl RobotArm for Arm {
    fn annulus(&self) -> Annulus {
        self.places.annulus()
    }

    fn mount_length(&self) -> f64 {
        self.mount.length
    }

    fn home(&self) -> Vector {
        flange(self, &frames(self, &self.home)).position.xy()
    }

    fn allows(&self, position: Vector, yaw: f64) -> bool {
        self.places.allow(position, yaw)
    }

    fn foot(&self) -> Vec<Obstacle> {
        foot(self)
    }

    fn fault(&self) -> Option<String> {
        self.fault()
    }

    fn follow(
        &self,
        task: &Task,
        scene: &Scene,
        tool: &Arc<Tool>,
        plan: &Plan,
        states: &[State],
    ) -> Followed {
        follow(task, (self, scene), tool, plan, states)
    }

    fn judge(
        &self,
        scene: &Scene,
        tool: &Arc<Tool>,
        plan: &Plan,
        states: &[State],
        path: &JointTrajectory,
    ) -> Vec<(usize, ArmFault)> {
        judge((self, scene), tool, plan, states, path)
    }

    fn to_json(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }
}
