//! How the joints of an arm carry a plan out: `trajectory_msgs/JointTrajectory` of ROS as JSON, and as
//! CSV.

use std::fmt::Write;

use serde_json::json;

use pushplan::asset::PlanFile;
use pushplan::scene::JointTrajectory;

use super::ExportError;

/// Nanoseconds in a second.
const NANOS: f64 = 1e9;

fn joints(plan: &PlanFile) -> Result<&JointTrajectory, ExportError> {
    plan.joints.as_ref().ok_or(ExportError::NoJoints)
}

/// The message `trajectory_msgs/JointTrajectory`, its fields by their names: radians (metres of joints
/// that slide), seconds.
///
/// # Errors
/// A plan without the motion of joints.
pub fn joint_trajectory(plan: &PlanFile) -> Result<String, ExportError> {
    let path = joints(plan)?;
    let points: Vec<_> = path
        .points
        .iter()
        .map(|point| {
            let nanos = (point.time * NANOS).round();
            let sec = (nanos / NANOS).floor();
            json!({
                "positions": point.positions,
                "velocities": point.velocities,
                "accelerations": [],
                "effort": [],
                "time_from_start": {"sec": sec as i64, "nanosec": (nanos - sec * NANOS) as i64},
            })
        })
        .collect();
    let message = json!({
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""},
        "joint_names": path.joints,
        "points": points,
    });
    Ok(format!("{message:#}\n"))
}

/// The same as a table: a row for each point, with its time, seconds, the positions and the velocities.
///
/// # Errors
/// A plan without the motion of joints.
pub fn joint_table(plan: &PlanFile) -> Result<String, ExportError> {
    let path = joints(plan)?;
    let mut text = String::from("time");
    for ending in ["", " velocity"] {
        for name in &path.joints {
            // Names of joints may hold anything.
            let _ = write!(text, ",\"{}{ending}\"", name.replace('"', "\"\""));
        }
    }
    text.push('\n');
    for point in &path.points {
        let _ = write!(text, "{:.9}", point.time);
        for value in point.positions.iter().chain(&point.velocities) {
            let _ = write!(text, ",{value:.9}");
        }
        text.push('\n');
    }
    Ok(text)
}
