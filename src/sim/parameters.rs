//! Settings that both engines share, and why they are so.

use crate::geometry::Vector;
use crate::scene::State;

/// Penetration that is not corrected, metres. rapier's default of 1 mm lets bodies sink 1.4 mm.
pub(super) const ALLOWED_ERROR: f64 = 1e-5;

/// Largest ratio of masses at which rapier's soft contacts hold; above it bodies sink into each
/// other (8 mm at 100).
const SOFT_MASS_RATIO: f64 = 10.0;

/// Contact spring for scenes above [`SOFT_MASS_RATIO`]: natural frequency (Hz) and damping
/// ratio. It removes the sinking but doubles the contact noise of cylinders, so rapier's own
/// stays in use below.
pub(super) const STIFF_CONTACT: (f64, f64) = (300.0, 1.0);

/// Whether the masses (kg) differ so much that contacts must be stiffened.
pub(super) fn needs_stiff_contacts(masses: &[f64]) -> bool {
    let heaviest = masses.iter().copied().fold(0.0, f64::max);
    let lightest = masses.iter().copied().fold(f64::INFINITY, f64::min);
    heaviest > SOFT_MASS_RATIO * lightest
}

/// Mean position of the objects, metres: where the engines put their origin, so that a scene far
/// from the world's loses no digits.
pub(super) fn centre(state: &State) -> Option<Vector> {
    let count = state.poses.len();
    let sum: Vector = state.poses.iter().map(|pose| pose.position).sum();
    (count > 0).then(|| sum / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_are_stiffened_only_above_a_ratio_of_ten() {
        assert!(!needs_stiff_contacts(&[]));
        assert!(!needs_stiff_contacts(&[0.1, 1.0]));
        assert!(needs_stiff_contacts(&[0.1, 0.5, 1.1]));
    }
}
