//! The colliders of a lever scene.

use rapier3d_f64::math::Matrix;
use rapier3d_f64::prelude::{ColliderBuilder, MassProperties, Pose3, Rotation, Vector};

use crate::geometry::Vector as Planar;
use crate::scene::{Blade, Slab, Weight};

use super::super::solids::{CLEAR, FOOT as SUPPORT, TABLE_DEPTH, Top, cut, prism, rubbing};

/// Half the width of the table, and half its thickness, metres.
const TABLE: (f64, f64) = (2.0, 0.25);

/// Maximum radius of a foot, metres. Radii from 0.5 to 2 mm give equal results.
const FOOT: f64 = 1e-3;

/// Number of corners above which outlines are divided about their centre; a division from a corner
/// would give needles.
const MANY: usize = 12;

/// Returns the table with its top at z = 0. On a half-space parry uses only four corners of a face,
/// which may not be the supporting ones.
pub(super) fn table(friction: f64, top: Option<Top>) -> ColliderBuilder {
    if let Some((pose, [x, y])) = top {
        return cuboid([x, y, TABLE_DEPTH], friction).position(pose);
    }
    let (half, depth) = TABLE;
    rubbing(ColliderBuilder::cuboid(half, half, depth), friction)
        .translation(Vector::new(0.0, 0.0, -depth))
}

/// Returns the blade about its centre.
pub(super) fn blade(blade: &Blade) -> ColliderBuilder {
    cuboid([blade.length, blade.width, blade.thickness], blade.friction)
}

/// Returns a cuboid with these extents, metres, about its centre.
pub(super) fn cuboid(size: [f64; 3], friction: f64) -> ColliderBuilder {
    let [x, y, z] = size.map(|extent| 0.5 * extent);
    rubbing(ColliderBuilder::cuboid(x, y, z), friction)
}

/// Returns mass and inertia of a plate in its frame.
pub(super) fn weight(weight: &Weight) -> MassProperties {
    let [xx, yy, zz, xy, xz, yz] = weight.inertia;
    let inertia = Matrix::from_cols(
        Vector::new(xx, xy, xz),
        Vector::new(xy, yy, yz),
        Vector::new(xz, yz, zz),
    );
    let [x, y, z] = weight.centre.into();
    MassProperties::with_inertia_matrix(Vector::new(x, y, z), weight.mass, inertia)
}

/// Returns the solids of a slab in the frame of its plate.
pub(super) fn slab_parts(slab: &Slab, friction: f64) -> Vec<ColliderBuilder> {
    let middle = slab.bottom + 0.5 * slab.height;
    if let Some((centre, turn, [x, y])) = slab.rectangle() {
        let at = Vector::new(centre.x, centre.y, middle);
        let pose = Pose3::from_parts(at, Rotation::from_rotation_z(turn));
        return vec![cuboid([x, y, slab.height], friction).position(pose)];
    }
    let raised = Vector::Z * middle;
    let part =
        |corners: Vec<Planar>| rubbing(prism(&corners, slab.height), friction).translation(raised);
    let parts = if slab.corners.len() > MANY { kites } else { cut };
    parts(&slab.corners).into_iter().map(part).collect()
}

/// Divides a convex polygon into parts that meet in its centre.
fn kites(corners: &[Planar]) -> Vec<Vec<Planar>> {
    let count = corners.len();
    let middle = corners.iter().sum::<Planar>() / count as f64;
    let kite = |k: usize| {
        let rim = (k..=(k + 2).min(count)).map(|k| corners[k % count]);
        std::iter::once(middle).chain(rim).collect()
    };
    (0..count).step_by(2).map(kite).collect()
}

/// Returns balls on which a plate stands at these points of its frame, `height` metres below it. A
/// plate on the table also stands on a stated support, see [`clear`].
pub(super) fn feet(points: &[Planar], height: f64, friction: f64) -> Vec<ColliderBuilder> {
    let radius = if height > 0.0 { FOOT.min(0.5 * height) } else { SUPPORT };
    let foot = |at: &Planar| {
        let at = Vector::new(at.x, at.y, radius - height);
        rubbing(ColliderBuilder::ball(radius), friction).translation(at)
    };
    points.iter().map(foot).collect()
}

/// Returns the slab without its part just above the table.
pub(super) fn clear(slab: &Slab) -> Slab {
    let Slab { corners, bottom, height } = slab.clone();
    Slab { corners, bottom: bottom + CLEAR, height: height - CLEAR }
}
