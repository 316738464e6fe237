//! Settings that both engines share, and why they are so.

use crate::geometry::Vector;
use crate::scene::{JointKind, Physics, Scene, State};

/// Penetration that is not corrected, metres. rapier's default of 1 mm lets bodies sink 1.4 mm.
pub(super) const ALLOWED_ERROR: f64 = 1e-5;

/// Largest ratio of masses at which rapier's soft contacts hold; above it bodies sink into each
/// other (8 mm at 100).
const SOFT_MASS_RATIO: f64 = 10.0;

/// Contact spring of the planar engine: natural frequency (Hz) and damping ratio.
///
/// With rapier's own (30 Hz, 5) a can of 0.11 kg sinks by 1.7 mm into a pair of 0.82 kg that it
/// pushes, and takes several frames to come out again; sinking falls with the square of the
/// frequency. With 300 Hz and ratio 1, objects jammed between tool and wall are shot out at 12 and 18 times the
/// tool's speed in two of 1000 random scenes; here at 5 times at most, with rapier's own twice.
pub(super) const PLANAR_CONTACT: (f64, f64) = (100.0, 5.0);

/// The same in both engines, of scenes above [`SOFT_MASS_RATIO`] and of articulated ones: with
/// the one above, 1 : 100 still sinks by 1.2 mm, and 12 cans on revolute joints creep for
/// seconds. It doubles the contact noise of cylinders in 3-D, so there rapier's own stays in use
/// elsewhere.
pub(super) const STIFF_CONTACT: (f64, f64) = (300.0, 1.0);

/// Small steps inside a step for articulated scenes; rapier's own number is 4.
///
/// In a row of 8 cans on revolute joints, pushed 1 m at 0.21 m/s, the axes drift by at most 0.70
/// mm in the planar engine (0.92 in 3-D) with 4, 0.10 (0.16) with 6 and 0.06 (0.11) with 8.
pub(super) const ARTICULATED_ITERATIONS: usize = 6;

/// Whether some objects can move against others that they are joined with, or against the world.
///
/// Such neighbours also touch each other, with the leverage of everything attached to the joint:
/// rapier's soft contacts let 12 boxes on revolute joints with gaps of 2 mm, which can turn by 3
/// degrees, turn by 24 instead, and the row then never came to rest.
pub(super) fn is_articulated(scene: &Scene, physics: &Physics) -> bool {
    !scene.mounts.is_empty() || physics.joints.iter().any(|joint| joint.kind != JointKind::Fixed)
}

/// Whether the masses of bodies that can meet differ so much that contacts must be stiffened.
pub(super) fn needs_stiff_contacts(physics: &Physics) -> bool {
    let mass = |group: &Vec<usize>| group.iter().map(|&k| physics.masses[k]).sum();
    let masses: Vec<f64> = physics.rigid_groups().members.iter().map(mass).collect();
    are_uneven(&masses)
}

fn are_uneven(masses: &[f64]) -> bool {
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
        assert!(!are_uneven(&[]));
        assert!(!are_uneven(&[0.1, 1.0]));
        assert!(are_uneven(&[0.1, 0.5, 1.1]));
    }
}
