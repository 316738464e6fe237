//! What must come of a lever-up, and how near it came.

use std::f64::consts::FRAC_PI_2;

use serde::{Deserialize, Serialize};

use crate::geometry::{Vector, Vector3};
use crate::scene::Goal;

use super::action::lever_frame;
use super::{Ending, LeverScene, LeverTrajectory, LeverUp, LeverWarning};

/// By how much a missed demand counts as missed once more: metres of an edge that is not yet high
/// enough, or of a centre that is still inside.
const STEP: f64 = 0.01;

/// What came of a lever-up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverOutcome {
    /// Whether the goal is reached and nothing went wrong on the way that forbids it.
    pub reached: bool,
    /// The demand that is met worst: at most 1 if it is met.
    pub score: f64,
    /// How much higher the edge at the lever point lies at the end of the turn, metres.
    pub raised: f64,
    /// How the plate lies at rest.
    pub ending: Ending,
    /// Its centre of mass at rest, seen from above, metres.
    pub rest: Vector,
    /// What went wrong on the way.
    pub warnings: Vec<LeverWarning>,
}

impl LeverOutcome {
    /// What went wrong on the way, so that the end does not count.
    pub fn fault(&self) -> Option<LeverWarning> {
        self.warnings.iter().copied().find(|warning| *warning != LeverWarning::Slipped)
    }
}

impl Goal {
    /// What `trajectory` of `lever` comes to.
    pub fn judge_lever(
        &self,
        scene: &LeverScene,
        lever: &LeverUp,
        trajectory: &LeverTrajectory,
    ) -> LeverOutcome {
        let rest = trajectory.rest.position.xy();
        let raised = raised(scene, lever, trajectory);
        let held = trajectory.held.last().copied().unwrap_or(false);
        let outside = self.outside.map(|block| {
            let block = &scene.blocks[block];
            let local = block.pose.inverse().point(rest);
            let [x, y, _] = block.size;
            let beyond = (local.x.abs() - 0.5 * x).max(local.y.abs() - 0.5 * y);
            1.0 - beyond / STEP
        });
        let lifted = self.raised.map(|wanted| {
            let missing = (wanted - raised) / STEP;
            if held { 1.0 + missing } else { 2.0 + missing.max(0.0) }
        });
        let turned = self.flipped.map(|flipped| {
            let tilt = trajectory.rest.tilt();
            let off = if flipped { std::f64::consts::PI - tilt } else { tilt };
            let wanted = if flipped { Ending::Flipped } else { Ending::Back };
            match trajectory.ending == wanted {
                true => (off / FRAC_PI_2).min(1.0),
                false => 1.0 + off / FRAC_PI_2,
            }
        });
        let placed = self.has_place().then(|| (rest - self.position).norm() / self.tolerance);
        let demands = [outside, lifted, turned, placed];
        // What has no number counts as far off; comparisons with it would count as met.
        let number = |score: f64| if score.is_finite() { score } else { f64::MAX };
        let score = demands.into_iter().flatten().map(number).fold(0.0, f64::max);
        let mut outcome = LeverOutcome {
            reached: false,
            score,
            raised,
            ending: trajectory.ending,
            rest,
            warnings: trajectory.warnings.clone(),
        };
        outcome.reached = score <= 1.0 && trajectory.rest.is_finite() && outcome.fault().is_none();
        outcome
    }
}

/// How much higher the edge at the lever point lies at the end of the turn, metres.
fn raised(scene: &LeverScene, lever: &LeverUp, trajectory: &LeverTrajectory) -> f64 {
    let plate = &scene.plates[lever.plate];
    let at = lever_frame(plate.corners(), lever.place).position;
    let Some(end) = trajectory.lift.last() else { return 0.0 };
    end.point(Vector3::new(at.x, at.y, 0.0)).z - plate.z
}
