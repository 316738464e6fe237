//! Motion of the joints of an arm through a plan.

use serde::{Deserialize, Serialize};

/// Maximum number of moving joints.
pub const MAX_JOINTS: usize = 16;

/// The state of the joints at an instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointPoint {
    /// Time since the start, seconds.
    pub time: f64,
    /// Joint positions, radians or metres.
    pub positions: Vec<f64>,
    /// Joint velocities, radians or metres a second.
    pub velocities: Vec<f64>,
}

/// The joint motion with which an arm carries out a plan. Between points the joints follow cubic
/// Hermite polynomials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointTrajectory {
    /// Names of the joints.
    pub joints: Vec<String>,
    /// Points in order of time.
    pub points: Vec<JointPoint>,
    /// Indices of the first and last point of every push.
    pub pushes: Vec<[usize; 2]>,
}

impl JointTrajectory {
    /// Returns the positions at a share (0 to 1) of the time between a point and the next.
    pub fn between(&self, point: usize, share: f64) -> Vec<f64> {
        let [a, b] = [&self.points[point], &self.points[point + 1]];
        let (time, s) = (b.time - a.time, share);
        let (s2, s3) = (s * s, s * s * s);
        let weights = [2.0 * s3 - 3.0 * s2 + 1.0, s3 - 2.0 * s2 + s, 3.0 * s2 - 2.0 * s3, s3 - s2];
        (0..a.positions.len())
            .map(|k| {
                weights[0] * a.positions[k]
                    + weights[1] * time * a.velocities[k]
                    + weights[2] * b.positions[k]
                    + weights[3] * time * b.velocities[k]
            })
            .collect()
    }

    /// Returns the duration, seconds.
    pub fn duration(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time)
    }

    /// Returns the first inconsistency of the numbers, if any.
    pub fn fault(&self) -> Option<&'static str> {
        let count = self.joints.len();
        let mut before = f64::NEG_INFINITY;
        for point in &self.points {
            let numbers = point.positions.iter().chain(&point.velocities);
            if point.positions.len() != count || point.velocities.len() != count {
                return Some("every point must have one number per joint");
            }
            if !numbers.chain([&point.time]).all(|v| v.is_finite()) || point.time <= before {
                return Some(
                    "times must increase from point to point, and all numbers must be finite",
                );
            }
            before = point.time;
        }
        if self.points.first().is_some_and(|first| first.time != 0.0) {
            return Some("the first point must be at time 0");
        }
        let mut last = 0;
        for [from, to] in &self.pushes {
            if *from < last || to <= from || *to >= self.points.len() {
                return Some("pushes must begin and end at points, one after another");
            }
            last = *to;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_follow_cubics_and_damaged_ones_are_found() {
        let at = |time: f64, position: f64, velocity: f64| JointPoint {
            time,
            positions: vec![position],
            velocities: vec![velocity],
        };
        let mut path = JointTrajectory {
            joints: vec!["j".into()],
            points: vec![at(0.0, 0.0, 1.0), at(2.0, 2.0, 1.0), at(3.0, 2.0, 0.0)],
            pushes: vec![[0, 1]],
        };
        assert!((path.between(0, 0.25)[0] - 0.5).abs() < 1e-12);
        assert_eq!((path.between(1, 1.0)[0], path.duration(), path.fault()), (2.0, 3.0, None));
        path.pushes.push([1, 3]);
        assert!(path.fault().is_some());
        path.pushes.clear();
        path.points[1].time = 3.0;
        assert!(path.fault().is_some());
    }
}
