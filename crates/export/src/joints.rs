//! Joint trajectories of an arm: `trajectory_msgs/JointTrajectory` of ROS as JSON, and a CSV table.

use std::fmt::Write;
use std::iter;

use serde_json::json;

use pushplan::asset::PlanFile;
use pushplan::scene::JointTrajectory;

use super::ExportError;

/// Nanoseconds per second.
const NANOS: f64 = 1e9;

fn joints(plan: &PlanFile) -> Result<&JointTrajectory, ExportError> {
    plan.joints.as_ref().ok_or(ExportError::NoJoints)
}

/// Returns the message `trajectory_msgs/JointTrajectory` as JSON with its field names: radians
/// (metres for prismatic joints), seconds.
///
/// # Errors
/// Returns [`ExportError::NoJoints`] for a plan without a joint trajectory.
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
                "accelerations": point.accelerations,
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

/// Returns the joint trajectory as CSV: a row for each point, with its time, seconds, then the
/// positions, velocities and accelerations.
///
/// # Errors
/// Returns [`ExportError::NoJoints`] for a plan without a joint trajectory.
pub fn joint_table(plan: &PlanFile) -> Result<String, ExportError> {
    let path = joints(plan)?;
    let mut text = String::from("time");
    for ending in ["", " velocity", " acceleration"] {
        for name in &path.joints {
            // Joint names may contain any character.
            let _ = write!(text, ",\"{}{ending}\"", name.replace('"', "\"\""));
        }
    }
    text.push('\n');
    for point in &path.points {
        let _ = write!(text, "{:.9}", point.time);
        let accelerations = point.accelerations.iter().copied().chain(iter::repeat(0.0));
        let values = point.positions.iter().chain(&point.velocities).copied();
        for value in values.chain(accelerations.take(path.joints.len())) {
            let _ = write!(text, ",{value:.9}");
        }
        text.push('\n');
    }
    Ok(text)
}
