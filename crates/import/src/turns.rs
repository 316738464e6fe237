//! 3-D rotations in the notations of files.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

/// Returns the rotation of a quaternion (w, x, y, z); `None` for length zero.
pub(super) fn quaternion([w, x, y, z]: [f64; 4]) -> Option<UnitQuaternion<f64>> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12)
}

/// Returns the rotation by `angle` radians about an axis; `None` for an axis of length zero.
pub(super) fn about([x, y, z]: [f64; 3], angle: f64) -> Option<UnitQuaternion<f64>> {
    let axis = Unit::try_new(Vector3::new(x, y, z), 1e-12)?;
    Some(UnitQuaternion::from_axis_angle(&axis, angle))
}

/// Returns the composition of rotations (radians) about axes named by letters: body axes for small
/// letters, world axes for capitals.
pub(super) fn euler(angles: [f64; 3], letters: [char; 3]) -> UnitQuaternion<f64> {
    let mut turn = UnitQuaternion::identity();
    for (angle, letter) in angles.into_iter().zip(letters) {
        let axis = match letter.to_ascii_lowercase() {
            'x' => Vector3::x_axis(),
            'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let next = UnitQuaternion::from_axis_angle(&axis, angle);
        turn = if letter.is_ascii_lowercase() { turn * next } else { next * turn };
    }
    turn
}

/// Returns the rotation to a frame with the given x axis and its y axis toward a second vector;
/// `None` if the two are collinear.
pub(super) fn axes([a, b, c, d, e, f]: [f64; 6]) -> Option<UnitQuaternion<f64>> {
    let x = Vector3::new(a, b, c).try_normalize(1e-12)?;
    let z = x.cross(&Vector3::new(d, e, f)).try_normalize(1e-12)?;
    let frame = Matrix3::from_columns(&[x, z.cross(&x), z]);
    Some(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame)))
}

/// Returns the smallest rotation that maps the z axis to the given axis; `None` for length zero.
pub(super) fn z_axis([x, y, z]: [f64; 3]) -> Option<UnitQuaternion<f64>> {
    let axis = Vector3::new(x, y, z).try_normalize(1e-12)?;
    // Straight down it is not unique; the rotation about x is used, as in MuJoCo.
    let down = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    Some(UnitQuaternion::rotation_between(&Vector3::z(), &axis).unwrap_or_else(down))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_quarter_turn_is_the_same_however_it_is_written() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let turns = [
            quaternion([half, 0.0, 0.0, half]),
            about([0.0, 0.0, 3.0], FRAC_PI_2),
            Some(euler([0.0, 0.0, FRAC_PI_2], ['x', 'y', 'z'])),
            axes([0.0, 2.0, 0.0, -1.0, 0.5, 0.0]),
        ];
        for turn in turns {
            let turned = turn.expect("a turn") * Vector3::x();
            assert!((turned - Vector3::y()).norm() < 1e-12, "{turned}");
        }
        assert!((z_axis([0.0, 5.0, 0.0]).unwrap() * Vector3::z() - Vector3::y()).norm() < 1e-12);
        assert_eq!((quaternion([0.0; 4]), axes([1.0, 0.0, 0.0, 2.0, 0.0, 0.0])), (None, None));
    }

    #[test]
    fn small_letters_turn_with_the_body_and_capitals_with_the_world() {
        let angles = [0.3, -0.7, 1.1];
        let [x, y, z] = angles;
        let body = euler(angles, ['x', 'y', 'z']);
        let world = euler([z, y, x], ['Z', 'Y', 'X']);
        assert!(body.angle_to(&world) < 1e-12);
        // URDF's roll, pitch and yaw are about the world's axes.
        let rpy = UnitQuaternion::from_euler_angles(x, y, z);
        assert!(euler(angles, ['X', 'Y', 'Z']).angle_to(&rpy) < 1e-12);
    }
}
