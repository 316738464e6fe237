//! The colliders of a lever scene.

use rapier3d_f64::math::Matrix;
use rapier3d_f64::prelude::{ColliderBuilder, MassProperties, Pose3, Rotation, Vector};

use crate::geometry::Vector as Planar;
use crate::scene::{Blade, Slab, Weight};

use super::super::solids::{CLEAR, FOOT as SUPPORT, TABLE_DEPTH, Top, cut, prism, rubbing};

/// Half the width of the table, metres, and half its thickness.
const TABLE: (f64, f64) = (2.0, 0.25);

/// Largest radius of a foot, metres. From 0.5 to 2 mm it makes no difference.
const FOOT: f64 = 1e-3;

/// Outlines of more corners are cut about their middle: from a corner they give needles.
const MANY: usize = 12;

/// The table with its top at z = 0. On a half-space parry looks at four corners of a face, which
/// need not be those that carry.
pub(super) fn table(friction: f64, top: Option<Top>) -> ColliderBuilder {
    if let Some((pose, [x, y])) = top {
        return cuboid([x, y, TABLE_DEPTH], friction).position(pose);
    }
    let (half, depth) = TABLE;
    rubbing(ColliderBuilder::cuboid(half, half, depth), friction)
        .translation(Vector::new(0.0, 0.0, -depth))
}

/// The blade about its centre.
pub(super) fn blade(blade: &Blade) -> ColliderBuilder {
    cuboid([blade.length, blade.width, blade.thickness], blade.friction)
}

/// A cuboid of these extents, metres, about its centre.
pub(super) fn cuboid(size: [f64; 3], friction: f64) -> ColliderBuilder {
    let [x, y, z] = size.map(|extent| 0.5 * extent);
    rubbing(ColliderBuilder::cuboid(x, y, z), friction)
}

/// Mass and inertia of a plate in its frame.
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

/// The solids of a slab in the frame of its plate.
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

/// A convex polygon cut into parts that meet in its middle.
fn kites(corners: &[Planar]) -> Vec<Vec<Planar>> {
    let count = corners.len();
    let middle = corners.iter().sum::<Planar>() / count as f64;
    let kite = |k: usize| {
        let rim = (k..=(k + 2).min(count)).map(|k| corners[k % count]);
        std::iter::once(middle).chain(rim).collect()
    };
    (0..count).step_by(2).map(kite).collect()
}

/// Balls on which a plate stands at these points of its frame, `height` metres below it. What lies on the
/// table stands on a stated support all the same, see [`clear`].
pub(super) fn feet(points: &[Planar], height: f64, friction: f64) -> Vec<ColliderBuilder> {
    let radius = if height > 0.0 { FOOT.min(0.5 * height) } else { SUPPORT };
    let foot = |at: &Planar| {
        let at = Vector::new(at.x, at.y, radius - height);
        rubbing(ColliderBuilder::ball(radius), friction).translation(at)
    };
    points.iter().map(foot).collect()
}

/// The slab without what lies just above the table.
pub(super) fn clear(slab: &Slab) -> Slab {
    let Slab { corners, bottom, height } = slab.clone();
    Slab { corners, bottom: bottom + CLEAR, height: height - CLEAR }
}
