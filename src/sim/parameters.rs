//! Settings of both engines, with their reasons.

use crate::geometry::Vector;
use crate::scene::{JointKind, Physics, Scene, State};

/// Penetration that is not corrected, metres. With rapier's default of 1 mm bodies sink by 1.4 mm.
pub(super) const ALLOWED_ERROR: f64 = 1e-5;

/// Maximum ratio of masses at which rapier's soft contacts hold; above it bodies sink into each
/// other (8 mm at 100).
const SOFT_MASS_RATIO: f64 = 10.0;

/// Contact spring of the 2-D engine: natural frequency (Hz) and damping ratio.
///
/// A can of 0.11 kg sinks by 1.7 mm into a pair of 0.82 kg that it pushes with rapier's default (30
/// Hz, 5), and needs several frames to separate. Sinking decreases with the square of the
/// frequency. With 300 Hz and ratio 1, objects jammed between tool and wall are ejected at 12 and
/// 18 times the tool's speed in two of 1000 random scenes. With this setting they reach at most 5
/// times the tool's speed, with rapier's default twice.
pub(super) const PLANAR_CONTACT: (f64, f64) = (100.0, 5.0);

/// Contact spring of both engines for articulated scenes and scenes above [`SOFT_MASS_RATIO`]. With
/// [`PLANAR_CONTACT`], 1 : 100 still sinks by 1.2 mm, and 12 cans on revolute joints creep for
/// seconds. This spring doubles the contact noise of cylinders in 3-D, so other 3-D scenes keep
/// rapier's default.
pub(super) const STIFF_CONTACT: (f64, f64) = (300.0, 1.0);

/// Number of solver iterations in a step for articulated scenes; rapier's default is 4.
///
/// Measured with a row of 8 cans on revolute joints, pushed 1 m at 0.21 m/s. The axes drift by at
/// most 0.70 mm in the 2-D engine (0.92 in 3-D) with 4, 0.10 (0.16) with 6 and 0.06 (0.11) with
/// 8.
pub(super) const ARTICULATED_ITERATIONS: usize = 6;

/// Returns `true` if some objects can move against joined objects or against the world.
///
/// Joined neighbours also touch each other, with the leverage of everything attached to the joint.
/// Twelve boxes on revolute joints with gaps of 2 mm, which can rotate by 3 degrees, rotated by 24
/// under rapier's soft contacts. The row then never stopped.
pub(super) fn is_articulated(scene: &Scene, physics: &Physics) -> bool {
    !scene.mounts.is_empty() || physics.joints.iter().any(|joint| joint.kind != JointKind::Fixed)
}

/// Returns `true` if the masses of bodies that can collide differ so much that contacts must be
/// stiffened.
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

/// Returns the mean position of the objects, metres. The engines place their origin there, so that
/// a scene far from the world's origin loses no precision.
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
