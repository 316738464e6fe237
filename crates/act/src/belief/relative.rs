//! Relative poses of two objects and propagation of observation errors to them.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Matrix3x2, Vector3};

use pushplan::geometry::{Pose, Vector, perpendicular};

/// Returns the pose of a second object in the frame of a first: position (metres), heading
/// (radians).
pub(super) fn relative(first: &Pose, second: &Pose) -> Vector3<f64> {
    let position = first.local_point(second.position);
    Vector3::new(position.x, position.y, second.heading - first.heading)
}

/// Returns the derivative of the relative pose with respect to the headings of both objects.
pub(super) fn by_headings(relative: &Vector3<f64>) -> Matrix3x2<f64> {
    let arm = perpendicular(Vector::new(relative.x, relative.y));
    Matrix3x2::new(-arm.x, 0.0, -arm.y, 0.0, -1.0, 1.0)
}

/// Returns the covariance of a relative pose for these variances of the objects' positions (per
/// coordinate) and headings.
pub(super) fn spread(
    relative: &Vector3<f64>,
    position: [f64; 2],
    heading: [f64; 2],
) -> Matrix3<f64> {
    let shifts = Matrix2x3::identity();
    let turns = by_headings(relative);
    (position[0] + position[1]) * shifts.transpose() * shifts
        + turns * Matrix2::from_diagonal(&heading.into()) * turns.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_is_that_of_small_errors() {
        let (first, second) = (Pose::new(0.3, 0.1, 0.7), Pose::new(0.36, 0.02, -0.4));
        let seen = relative(&first, &second);
        let moved = |one: [f64; 3], other: [f64; 3]| {
            let by = |pose: &Pose, d: [f64; 3]| {
                Pose::new(pose.position.x + d[0], pose.position.y + d[1], pose.heading + d[2])
            };
            (relative(&by(&first, one), &by(&second, other)) - seen) * 1e6
        };
        let mut sum = Matrix3::zeros();
        let (sd, turn) = ([2.0, 3.0], [5.0, 7.0]);
        for k in 0..3 {
            let mut step = [0.0; 3];
            step[k] = 1e-6;
            let scale = |d: [f64; 2]| if k < 2 { d } else { turn };
            for (which, error) in [moved(step, [0.0; 3]), moved([0.0; 3], step)].iter().enumerate()
            {
                sum += error * error.transpose() * scale(sd)[which];
            }
        }
        assert!((sum - spread(&seen, sd, turn)).amax() < 1e-4 * sum.amax());
    }
}
