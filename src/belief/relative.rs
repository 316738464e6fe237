//! Where one object is as seen from another, and how errors of what is seen show in it.

use nalgebra::{Matrix2x3, Matrix3, Vector3};

use crate::geometry::{Pose, Vector, perpendicular, wrap_angle};

/// Pose of a second object in the frame of a first: position (metres) and heading (radians).
pub(super) fn relative(first: &Pose, second: &Pose) -> Vector3<f64> {
    let position = first.local_point(second.position);
    Vector3::new(position.x, position.y, second.heading - first.heading)
}

/// The same with a heading that is nearest to that of `like`.
pub(super) fn relative_like(first: &Pose, second: &Pose, like: &Vector3<f64>) -> Vector3<f64> {
    let seen = relative(first, second);
    Vector3::new(seen.x, seen.y, like.z + wrap_angle(seen.z - like.z))
}

/// Covariance of a relative pose when the variances of both objects' positions (either coordinate)
/// and headings are these.
pub(super) fn spread(
    relative: &Vector3<f64>,
    position: [f64; 2],
    heading: [f64; 2],
) -> Matrix3<f64> {
    // A turn of the first object by d moves the second by -d times this in its frame.
    let arm = perpendicular(Vector::new(relative.x, relative.y));
    let turn = Vector3::new(arm.x, arm.y, 1.0);
    let shifts = Matrix2x3::identity();
    (position[0] + position[1]) * shifts.transpose() * shifts
        + heading[0] * turn * turn.transpose()
        + Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, heading[1]))
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
