//! The colliders of the 3-D engine: solids, feet and the table, and which of them meet.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::math::Matrix;
use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, Group as Layer, InteractionGroups,
    InteractionTestMode, MassProperties, Pose3, Rotation, SharedShape, Vector,
};

use crate::geometry::{Shape, Vector as Planar};

/// Objects, tool parts and obstacles.
const SOLID: Layer = Layer::GROUP_1;
/// What objects stand on.
const FEET: Layer = Layer::GROUP_2;
/// The table, for solids and for feet.
const TABLE_TOP: Layer = Layer::GROUP_3;
const FLOOR: Layer = Layer::GROUP_4;

/// Radius of a foot, metres. From 0.5 to 5 mm it makes no difference.
pub(super) const FOOT: f64 = 2e-3;

/// How far an object's solid hangs above the table, metres.
pub(super) const CLEAR: f64 = 5e-4;

/// How deep a table that ends is, metres: nothing gets below it.
pub(super) const TABLE_DEPTH: f64 = 0.5;

/// Where a table ends: the pose of its middle and its full extents, metres.
pub(super) type Top = (Pose3, [f64; 2]);

/// The table as solids meet it.
pub(super) fn table(friction: f64, top: Option<Top>) -> ColliderBuilder {
    rubbing(ground(top), friction).collision_groups(groups(TABLE_TOP, SOLID))
}

/// The table as feet meet it, whose friction says what that of the pair is.
pub(super) fn floor(top: Option<Top>) -> ColliderBuilder {
    ground(top).friction(1.0).collision_groups(groups(FLOOR, FEET))
}

/// A foot at `pose` with this coefficient of friction; it meets the table alone.
pub(super) fn foot(pose: Pose3, coefficient: f64) -> ColliderBuilder {
    ColliderBuilder::ball(FOOT)
        .position(pose)
        .density(0.0)
        .friction(coefficient)
        .friction_combine_rule(CoefficientCombineRule::Multiply)
        .collision_groups(groups(FEET, FLOOR))
}

/// A solid with its middle at `pose` and its axis along z; rapier's cylinder has it along y.
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

/// What of a shape meets the table instead of its [`solid`], with the same arguments: of a face on
/// a half-space parry looks at four corners alone, so prisms of more corners tip into the table.
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

/// The solid of an object of this mass, kg.
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

/// Parts of a prism's base with at most four corners each; none where it has no more itself.
fn slabs(shape: &Shape) -> Vec<Vec<Planar>> {
    match shape {
        Shape::Prism { base, .. } if base.corners().len() > 4 => cut(base.corners()),
        _ => Vec::new(),
    }
}

/// A convex polygon cut into parts with at most four corners each.
pub(super) fn cut(corners: &[Planar]) -> Vec<Vec<Planar>> {
    let (first, others) = (corners[0], &corners[1..]);
    let cut = (0..others.len() - 1).step_by(2);
    cut.map(|k| {
        let end = (k + 3).min(others.len());
        [&[first], &others[k..end]].concat()
    })
    .collect()
}

/// An upright prism about the origin.
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
    // Of a prism on a convex base there always is one.
    ColliderBuilder::convex_mesh(corners, &faces)
        .unwrap_or_else(|| ColliderBuilder::ball(height / 2.0))
}

/// The shape without what lies within [`CLEAR`] of the table.
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

/// The coefficient of a pair is the mean of the two values.
pub(super) fn rubbing(collider: ColliderBuilder, friction: f64) -> ColliderBuilder {
    collider.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

#[cfg(test)]
mod tests;
