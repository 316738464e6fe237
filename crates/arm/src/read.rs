//! Reader for the arms of task and plan files, and its interface to the core library.

use std::sync::Arc;

use pushplan::geometry::Vector;
use pushplan::scene::{ArmFault, JointTrajectory, Obstacle, Scene, State, Tool};
use pushplan::task::{
    ArmRefusal, ArmSource, Followed, Plan, RobotArm, StatedArm, Task, read_arms_with,
};

use super::find::{find_places, usual_home};
use super::follow::follow;
use super::foot::foot;
use super::judge::judge;
use super::kinematics::{flange, frames};
use super::model::Arm;
use super::places::Places;
use super::room::pairs;

/// Error message and remedy.
pub(super) type Wrong = (String, String);

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
            let names: Vec<&str> = arm.joints.iter().map(|joint| &*joint.name).collect();
            let message = format!(
                "`home` has {} numbers, but the arm has {} joints",
                home.len(),
                names.len()
            );
            let advice = format!("give one number for each of {}, radians", names.join(", "));
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
    }
    let known = Some(arm.places.clone()).filter(Places::known);
    let Some(places) = known.or_else(|| find_places(&arm, stated.lift)) else {
        let message = format!(
            "this arm cannot hold a tool above the table with its flange {:.2} m above it and \
             pointing down",
            arm.mount.length + stated.lift
        );
        let advice =
            "the z axis of `flange` must point out of it; check `base` and `tool_mount` as well";
        return Err(refused((message, advice.into())));
    };
    arm.places = places;
    if !saved
        && stated.home.is_none()
        && let Some(home) = usual_home(&arm, stated.travel)
    {
        arm.home = home;
    }
    Ok(arm)
}

#[cfg(feature = "urdf")]
fn from_urdf(source: &ArmSource) -> Result<Arm, Wrong> {
    let ArmSource::Urdf { path, flange, base, length, yaw } = source else {
        return Err((AGAIN.into(), String::new()));
    };
    let mount = super::model::ToolMount { length: *length, yaw: *yaw };
    Ok(Arm { base: *base, mount, ..super::urdf::chain(path, flange)? })
}

#[cfg(not(feature = "urdf"))]
fn from_urdf(_: &ArmSource) -> Result<Arm, Wrong> {
    let advice = "build it with the feature `urdf` of `pushplan-arm`";
    Err(("this program was built without support for URDF".into(), advice.into()))
}

impl RobotArm for Arm {
    fn ring(&self) -> [f64; 2] {
        self.places.ring_about_origin()
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
