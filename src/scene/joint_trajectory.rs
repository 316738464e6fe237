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
    /// Joint accelerations, radians or metres per second squared; empty in older plans.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub accelerations: Vec<f64>,
}

/// The joint motion with which an arm carries out a plan. Between points the joints follow quintic
/// Hermite polynomials, or cubic ones if a point states no accelerations.
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
        self.derivatives(point, share).into_iter().map(|[position, ..]| position).collect()
    }

    /// Returns position, velocity, acceleration and jerk of every joint at a share (0 to 1) of the
    /// time between a point and the next.
    pub fn derivatives(&self, point: usize, share: f64) -> Vec<[f64; 4]> {
        let [a, b] = [&self.points[point], &self.points[point + 1]];
        let (time, s) = (b.time - a.time, share);
        let each = |k: usize| {
            let way = b.positions[k] - a.positions[k];
            let [v, w] = [a.velocities[k] * time, b.velocities[k] * time];
            let bends = a.accelerations.get(k).zip(b.accelerations.get(k));
            // Coefficients of the powers of `s` from the second on.
            let [c2, c3, c4, c5] = match bends.map(|(a, b)| [a, b].map(|v| v * time * time)) {
                None => [3.0 * way - 2.0 * v - w, v + w - 2.0 * way, 0.0, 0.0],
                Some([a, b]) => [
                    0.5 * a,
                    10.0 * way - 6.0 * v - 4.0 * w - 1.5 * a + 0.5 * b,
                    8.0 * v + 7.0 * w - 15.0 * way + 1.5 * a - b,
                    6.0 * way - 3.0 * v - 3.0 * w - 0.5 * a + 0.5 * b,
                ],
            };
            [
                a.positions[k] + s * (v + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
                (v + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / time,
                (2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))) / time.powi(2),
                (6.0 * c3 + s * (24.0 * c4 + s * 60.0 * c5)) / time.powi(3),
            ]
        };
        (0..a.positions.len()).map(each).collect()
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
            let numbers = numbers.chain(&point.accelerations);
            let bends = point.accelerations.len();
            if point.positions.len() != count
                || point.velocities.len() != count
                || bends != 0 && bends != count
            {
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
            accelerations: Vec::new(),
        };
        let mut path = JointTrajectory {
            joints: vec!["j".into()],
            points: vec![at(0.0, 0.0, 1.0), at(2.0, 2.0, 1.0), at(3.0, 2.0, 0.0)],
            pushes: vec![[0, 1]],
        };
        assert!((path.between(0, 0.25)[0] - 0.5).abs() < 1e-12);
        assert_eq!((path.between(1, 1.0)[0], path.duration(), path.fault()), (2.0, 3.0, None));
        // The cubic of x = t^3 over two seconds, and with accelerations the quintic of x = t^5.
        path.points = vec![at(0.0, 0.0, 0.0), at(2.0, 8.0, 12.0)];
        assert_eq!(path.derivatives(0, 0.5), [[1.0, 3.0, 6.0, 6.0]]);
        path.points = vec![at(0.0, 0.0, 0.0), at(1.0, 1.0, 5.0), at(3.0, 2.0, 0.0)];
        path.points[0].accelerations = vec![0.0];
        path.points[1].accelerations = vec![20.0];
        assert_eq!(path.derivatives(0, 0.5), [[0.03125, 0.3125, 2.5, 15.0]]);
        assert_eq!(path.fault(), None);
        path.pushes.push([1, 3]);
        assert!(path.fault().is_some());
        path.pushes.clear();
        path.points[1].time = 3.0;
        assert!(path.fault().is_some());
    }
}
