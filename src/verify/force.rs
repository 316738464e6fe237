//! Warnings about the force of the tool.

use crate::outcome::{Trajectory, Warning, squeeze};
use crate::scene::Scene;
use crate::task::Task;

/// Sustained force of an ordinary arm, newtons. Arms that work beside people have 50 to 150 N.
const ORDINARY_ARM: f64 = 150.0;

/// Returns the warnings about the force of the tool in a replay: more than the arm or an ordinary
/// arm can exert, or far more than friction requires. The last one needs a recorded replay.
pub(super) fn force_warnings(task: &Task, scene: &Scene, trajectory: &Trajectory) -> Vec<Warning> {
    let needed = trajectory.force.map_or(0.0, |force| force.lasting);
    let weak = match task.robot.max_force {
        Some(limit) if needed > limit => {
            Some(Warning::TooMuchForce { object: None, needed, limit })
        }
        None if needed > ORDINARY_ARM => Some(Warning::HardPush { needed }),
        _ => None,
    };
    let recorded = trajectory.frames.len() > 1;
    let squeezed = recorded.then(|| squeeze(scene, trajectory)).flatten();
    weak.into_iter().chain(squeezed).collect()
}
