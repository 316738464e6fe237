//! The colliders of the 3-D engine: solids, feet and the table, and which of them meet.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, Group as Layer, InteractionGroups,
    InteractionTestMode, Pose3, Rotation, SharedShape, Vector,
};

use crate::geometry::Shape;

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

/// The table as solids meet it.
pub(super) fn table(friction: f64) -> ColliderBuilder {
    rubbing(half_space(), friction).collision_groups(groups(TABLE_TOP, SOLID))
}

/// The table as feet meet it, whose friction says what that of the pair is.
pub(super) fn floor() -> ColliderBuilder {
    half_space().friction(1.0).collision_groups(groups(FLOOR, FEET))
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
    };
    rubbing(collider, friction).collision_groups(groups(SOLID, SOLID | TABLE_TOP))
}

/// The shape without what lies within [`CLEAR`] of the table.
pub(super) fn raised(shape: &Shape) -> Shape {
    match *shape {
        Shape::Cylinder { radius, height } => Shape::Cylinder { radius, height: height - CLEAR },
        Shape::Cuboid { size: [x, y, z] } => Shape::Cuboid { size: [x, y, z - CLEAR] },
    }
}

fn half_space() -> ColliderBuilder {
    ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
}

fn rubbing(collider: ColliderBuilder, friction: f64) -> ColliderBuilder {
    collider.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}
