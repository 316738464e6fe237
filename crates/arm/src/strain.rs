//! Loads of the joints in a trajectory: positions, speeds, accelerations and jerks, in relation to
//! their limits.

use super::model::Arm;
use pushplan::scene::{ArmFault, JointPoint, JointTrajectory};

/// Shares of an interval at which limits are checked.
pub(super) const SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Tolerance for rounding of positions, radians and metres.
const ROUNDING: f64 = 1e-6;

/// Relative tolerances for rounding of speeds, accelerations and jerks, which grow with the power
/// of short times.
const SLACK: [f64; 3] = [1e-6, 1e-5, 1e-3];

/// Time within which a jump of the acceleration counts as a jerk, seconds: a cycle of a controller.
const CYCLE: f64 = 1e-3;

/// Largest loads of the joints.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strain {
    /// Joint that leaves its position limits.
    pub limit: Option<usize>,
    /// Largest speed, acceleration and jerk, as ratios of their limits with their tolerances.
    pub ratios: [f64; 3],
    /// Joints of the largest ratios.
    joints: [usize; 3],
    /// Absolute values of the largest ratios.
    needed: [f64; 3],
    /// Limits of the largest ratios.
    limits: [f64; 3],
}

impl Strain {
    /// Returns the first limit that is exceeded.
    pub fn fault(&self, arm: &Arm) -> Option<ArmFault> {
        let name = |k: usize| arm.joints[k].name.clone();
        if let Some(k) = self.limit {
            return Some(ArmFault::Limit { joint: name(k) });
        }
        let of = (0..3).find(|of| self.ratios[*of] > 1.0)?;
        let (joint, needed, limit) = (name(self.joints[of]), self.needed[of], self.limits[of]);
        Some(match of {
            0 => ArmFault::TooFast { joint, needed, limit },
            _ => ArmFault::TooAbrupt { joint, jerk: of == 2, needed, limit },
        })
    }

    fn add(&mut self, of: usize, joint: usize, needed: f64, limit: f64) {
        let ratio = needed / (limit * (1.0 + SLACK[of]));
        if ratio > self.ratios[of] {
            self.ratios[of] = ratio;
            (self.joints[of], self.needed[of], self.limits[of]) = (joint, needed, limit);
        }
    }
}

/// Returns the loads between points, in relation to a share of the limits. The speed of a joint
/// without a stated limit is limited except in pushes, where the plan determines it.
pub(super) fn strain(arm: &Arm, points: &[JointPoint], share: f64, pushing: bool) -> Strain {
    let path = JointTrajectory { joints: Vec::new(), points: points.to_vec(), pushes: Vec::new() };
    let mut found = Strain::default();
    for point in 0..points.len().saturating_sub(1) {
        add(arm, &path, point, &SHARES, (share, pushing), &mut found);
    }
    found
}

/// Adds the loads at some shares of the interval after a point.
pub(super) fn add(
    arm: &Arm,
    path: &JointTrajectory,
    point: usize,
    shares: &[f64],
    (share, pushing): (f64, bool),
    found: &mut Strain,
) {
    for at in shares {
        for (k, state) in path.derivatives(point, *at).into_iter().enumerate() {
            let joint = &arm.joints[k];
            let [_, rates @ ..] = state.map(f64::abs);
            let outside =
                |[low, high]: [f64; 2]| state[0] < low - ROUNDING || state[0] > high + ROUNDING;
            if joint.limits.is_some_and(outside) {
                found.limit = found.limit.or(Some(k));
            }
            let speed = joint.max_speed.or((!pushing).then(|| joint.speed()));
            let limits = [speed, joint.max_acceleration, joint.max_jerk];
            for of in 0..3 {
                if let Some(limit) = limits[of] {
                    found.add(of, k, rates[of], share * limit);
                }
            }
        }
    }
    // Where accelerations are not stated, they may jump from one cubic to the next.
    if point > 0 {
        let [before, after] = [path.derivatives(point - 1, 1.0), path.derivatives(point, 0.0)];
        for (k, (before, after)) in before.iter().zip(after).enumerate() {
            if let Some(limit) = arm.joints[k].max_jerk {
                found.add(2, k, (after[2] - before[2]).abs() / CYCLE, share * limit);
            }
        }
    }
}
