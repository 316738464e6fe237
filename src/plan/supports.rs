//! Final poses of a candidate for all plausible support models.
//!
//! The underside of an object cannot be observed, but its support determines its rotation.
//! Refinement therefore brings the centre of all final poses over plausible support models to the
//! goal, and not the predicted pose. The centre is the one of the smallest enclosing ball, which
//! minimises the distance to the worst pose.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::effect::Job;
use crate::{
    outcome::Record,
    scene::{Physics, Situation},
    task::ToolMotion,
};

use super::goal_errors::{apart, goal_errors};
use super::score::final_score;
use super::{Evaluation, Rollouts, Workspace};

/// Maximum distance of the centre from the prediction for the believed support, in tolerances,
/// because the believed support must reach the goal in any case.
const MOST: f64 = 0.35;

/// Number of steps to find the centre of the smallest enclosing ball, each towards the farthest
/// point (Badoiu and Clarkson 2003, "Smaller core-sets for balls"). The remaining error is at most
/// a few hundredths of the radius.
const ROUNDS: usize = 64;

/// Final poses of a candidate for plausible support models, including the believed one.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    /// Offset from the predicted final pose to the centre for every goal, in units of the
    /// tolerances: x, y, heading.
    pub middles: Vec<Vector3<f64>>,
    /// Score of the final pose farthest from the goal.
    pub worst: f64,
    /// Distance of the farthest final pose from the centre, in units of the tolerances.
    pub radius: f64,
}

/// Plausible support models other than the believed one.
pub(super) struct Supports(Vec<Arc<Physics>>);

impl Supports {
    pub fn around(situation: &Situation) -> Self {
        let believed = &situation.physics;
        let with = |support| {
            let mut physics = (**believed).clone();
            physics.support_all(&situation.scene, support);
            physics
        };
        let others = Physics::PLAUSIBLE_SUPPORTS.iter().map(with);
        Self(others.filter(|other| other.feet != believed.feet).map(Arc::new).collect())
    }

    /// Returns the number of support models, including the believed one.
    pub fn count(&self) -> usize {
        self.0.len() + 1
    }

    /// Rolls out evaluated candidates with unchanged pushes for all support models except the
    /// believed one.
    pub fn ends(
        &self,
        workspace: &Workspace,
        rollouts: &mut Rollouts,
        evaluations: &[&Evaluation],
    ) -> Vec<Ends> {
        let start = rollouts.situation().start.clone();
        let mut jobs = Vec::with_capacity(evaluations.len() * self.0.len());
        for evaluation in evaluations {
            let motions = evaluation.motions(workspace);
            jobs.extend(self.0.iter().map(|physics| {
                let job = |motion: &ToolMotion| Job {
                    start: start.clone(),
                    motion: motion.clone().into(),
                    physics: Arc::clone(physics),
                };
                motions.iter().map(job).collect::<Vec<Job>>()
            }));
        }
        let trajectories = rollouts.in_turn(&jobs, Record::Outcome);
        let task = workspace.task;
        let of = |k: usize, evaluation: &Evaluation| {
            let others = &trajectories[k * self.0.len()..(k + 1) * self.0.len()];
            let predicted = goal_errors(task, &evaluation.outcome);
            let finite = || others.iter().filter(|other| other.outcome().is_finite());
            let all: Vec<Vec<Vector3<f64>>> = finite()
                .map(|other| apart(task, &goal_errors(task, other.outcome()), &predicted))
                .collect();
            let balls = (0..predicted.len()).map(|goal| {
                let apart: Vec<_> = all.iter().map(|apart| apart[goal]).collect();
                ball(&apart)
            });
            let (middles, radii): (Vec<_>, Vec<f64>) = balls.unzip();
            let worst = others.iter().map(|other| final_score(task, other));
            Ends {
                middles: middles.iter().map(|middle| middle.cap_magnitude(MOST)).collect(),
                worst: worst.fold(evaluation.score, f64::max),
                radius: radii.into_iter().fold(0.0, f64::max),
            }
        };
        evaluations.iter().enumerate().map(|(k, evaluation)| of(k, evaluation)).collect()
    }
}

/// Returns the centre and radius of the smallest ball around the origin and `points`.
fn ball(points: &[Vector3<f64>]) -> (Vector3<f64>, f64) {
    let mut centre = Vector3::zeros();
    for round in 1..=ROUNDS {
        let far = |point: &Vector3<f64>| (point - centre).norm();
        let mut farthest = Vector3::zeros();
        for point in points {
            if far(point) > far(&farthest) {
                farthest = *point;
            }
        }
        centre += (farthest - centre) / (round + 1) as f64;
    }
    let radius = points.iter().map(|point| (point - centre).norm()).fold(centre.norm(), f64::max);
    (centre, radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_is_as_near_to_all_as_can_be() {
        assert_eq!(ball(&[]), (Vector3::zeros(), 0.0));
        let (a, b) = (Vector3::new(2.0, 0.0, 0.0), Vector3::new(1.0, 0.2, 0.0));
        // The two farthest of these points and the origin determine the ball.
        let (middle, radius) = ball(&[a, b]);
        assert!((middle - 0.5 * a).norm() < 0.02 && (radius - 1.0).abs() < 0.02);
        let corners = [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0)];
        assert!((ball(&corners).0 - Vector3::new(0.5, 0.5, 0.0)).norm() < 0.02);
    }
}
