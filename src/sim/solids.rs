//! The colliders of the 3-D engine: solids, feet and the table, with their collision groups.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::math::Matrix;
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, Group as Layer, InteractionGroups,
    InteractionTestMode, MassProperties, Pose3, Rotation, SharedShape, Vector,
};

use crate::geometry::{Shape, Vector as Planar};

/// Objects, tool parts and obstacles.
const SOLID: Layer = Layer::GROUP_1;
/// Feet of objects.
const FEET: Layer = Layer::GROUP_2;
/// The table, for solids and for feet.
const TABLE_TOP: Layer = Layer::GROUP_3;
const FLOOR: Layer = Layer::GROUP_4;

/// Radius of a foot, metres. Radii from 0.5 to 5 mm give equal results.
pub(super) const FOOT: f64 = 2e-3;

/// Gap between an object's solid and the table, metres.
pub(super) const CLEAR: f64 = 5e-4;

/// Depth of a finite table, metres; nothing gets below it.
pub(super) const TABLE_DEPTH: f64 = 0.5;

/// Extent of a finite table: the pose of its centre and its full extents, metres.
pub(super) type Top = (Pose3, [f64; 2]);

/// Returns the table for solids.
pub(super) fn table(friction: f64, top: Option<Top>) -> ColliderBuilder {
    rubbing(ground(top), friction).collision_groups(groups(TABLE_TOP, SOLID))
}

/// Returns the table for feet, whose friction values are the coefficients of the pairs.
pub(super) fn floor(top: Option<Top>) -> ColliderBuilder {
    ground(top).friction(1.0).collision_groups(groups(FLOOR, FEET))
}

/// Returns a foot at `pose` with this coefficient of friction; it collides only with the table.
pub(super) fn foot(pose: Pose3, coefficient: f64) -> ColliderBuilder {
    ColliderBuilder::ball(FOOT)
        .position(pose)
        .density(0.0)
        .friction(coefficient)
        .friction_combine_rule(CoefficientCombineRule::Multiply)
        .collision_groups(groups(FEET, FLOOR))
}

/// Returns a solid with its centre at `pose` and its axis along z; rapier's cylinder has its axis
/// along y.
pub(super) fn solid(shape: &Shape, pose: Pose3, friction: f64) -> ColliderBuilder {
    let collider = match *shape {
        Shape::Cylinder { radius, height } => {
            let turn = Rotation::from_rotation_x(FRAC_PI_2);
            ColliderBuilder::cylinder(height / 2.0, radius)
                .position(Pose3::from_parts(pose.translation, pose.rotation * turn))
        }
        Shape::Cuboid { size: [x, y, z] } => {
            ColliderBuilder::cuboid(x / 2.0, y / 2.0, z / 2.0).position(pose)
        }
        Shape::Prism { base, height } => prism(base.corners(), height).position(pose),
    };
    let meets = if slabs(shape).is_empty() { SOLID | TABLE_TOP } else { SOLID };
    rubbing(collider, friction).collision_groups(groups(SOLID, meets))
}

/// Returns the colliders that touch the table in place of the shape's [`solid`], with equal
/// arguments. For a face on a half-space parry uses only four corners, so prisms with more corners
/// would tip into the table.
pub(super) fn undersides(
    shape: &Shape,
    pose: Pose3,
    friction: f64,
) -> impl Iterator<Item = ColliderBuilder> {
    let height = shape.height();
    slabs(shape).into_iter().map(move |corners| {
        rubbing(prism(&corners, height), friction)
            .position(pose)
            .density(0.0)
            .collision_groups(groups(SOLID, TABLE_TOP))
    })
}

/// Sets the mass of an object's solid, kg.
pub(super) fn weighing(collider: ColliderBuilder, shape: &Shape, mass: f64) -> ColliderBuilder {
    match shape {
        Shape::Prism { base, height } => {
            let ([xx, xy, yy], zz) = (base.second_moments(), height * height / 12.0);
            let inertia = Matrix::from_cols(
                Vector::new(yy + zz, -xy, 0.0),
                Vector::new(-xy, xx + zz, 0.0),
                Vector::new(0.0, 0.0, xx + yy),
            );
            let properties =
                MassProperties::with_inertia_matrix(Vector::ZERO, mass, inertia * mass);
            collider.mass_properties(properties)
        }
        _ => collider.mass(mass),
    }
}

/// Returns parts of a prism's base with at most four corners each; empty if the base has no more.
fn slabs(shape: &Shape) -> Vec<Vec<Planar>> {
    match shape {
        Shape::Prism { base, .. } if base.corners().len() > 4 => cut(base.corners()),
        _ => Vec::new(),
    }
}

/// Divides a convex polygon into parts with at most four corners each.
pub(super) fn cut(corners: &[Planar]) -> Vec<Vec<Planar>> {
    let (first, others) = (corners[0], &corners[1..]);
    let cut = (0..others.len() - 1).step_by(2);
    cut.map(|k| {
        let end = (k + 3).min(others.len());
        [&[first], &others[k..end]].concat()
    })
    .collect()
}

/// Returns an upright prism about the origin.
pub(super) fn prism(base: &[Planar], height: f64) -> ColliderBuilder {
    let count = base.len() as u32;
    let ring = |z: f64| base.iter().map(move |corner| Vector::new(corner.x, corner.y, z));
    let corners: Vec<Vector> = ring(-height / 2.0).chain(ring(height / 2.0)).collect();
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for k in 0..count {
        let next = (k + 1) % count;
        faces.extend([[k, next, count + next], [k, count + next, count + k]]);
        if 0 < k && k + 1 < count {
            faces.extend([[0, k + 1, k], [count, count + k, count + k + 1]]);
        }
    }
    // The hull of a prism on a convex base always exists.
    ColliderBuilder::convex_mesh(corners, &faces)
        .unwrap_or_else(|| ColliderBuilder::ball(height / 2.0))
}

/// Returns the shape without its part within [`CLEAR`] of the table.
pub(super) fn raised(shape: &Shape) -> Shape {
    match *shape {
        Shape::Cylinder { radius, height } => Shape::Cylinder { radius, height: height - CLEAR },
        Shape::Cuboid { size: [x, y, z] } => Shape::Cuboid { size: [x, y, z - CLEAR] },
        Shape::Prism { base, height } => Shape::Prism { base, height: height - CLEAR },
    }
}

fn ground(top: Option<Top>) -> ColliderBuilder {
    match top {
        Some((pose, [x, y])) => {
            ColliderBuilder::cuboid(0.5 * x, 0.5 * y, 0.5 * TABLE_DEPTH).position(pose)
        }
        None => ColliderBuilder::new(SharedShape::halfspace(Vector::Z)),
    }
}

/// Sets the friction value; the coefficient of a pair is the mean of the two values.
pub(super) fn rubbing(collider: ColliderBuilder, friction: f64) -> ColliderBuilder {
    collider.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

#[cfg(test)]
mod tests;
