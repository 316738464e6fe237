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
/// The table.
const TABLE_TOP: Layer = Layer::GROUP_3;

/// Radius of a foot, metres. From 0.5 to 5 mm it makes no difference.
pub(super) const FOOT: f64 = 2e-3;

/// How far an object's solid hangs above the table, metres.
pub(super) const CLEAR: f64 = 5e-4;

/// The table.
pub(super) fn table(friction: f64) -> ColliderBuilder {
    let table = ColliderBuilder::new(SharedShape::halfspace(Vector::Z));
    rubbing(table, friction, groups(TABLE_TOP, SOLID | FEET))
}

/// A foot at `pose`; it meets the table alone.
pub(super) fn foot(pose: Pose3, friction: f64) -> ColliderBuilder {
    let ball = ColliderBuilder::ball(FOOT).position(pose).density(0.0);
    rubbing(ball, friction, groups(FEET, TABLE_TOP))
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
    rubbing(collider, friction, groups(SOLID, SOLID | TABLE_TOP))
}

/// The shape without what lies within [`CLEAR`] of the table.
pub(super) fn raised(shape: &Shape) -> Shape {
    match *shape {
        Shape::Cylinder { radius, height } => Shape::Cylinder { radius, height: height - CLEAR },
        Shape::Cuboid { size: [x, y, z] } => Shape::Cuboid { size: [x, y, z - CLEAR] },
    }
}

fn rubbing(collider: ColliderBuilder, friction: f64, meets: InteractionGroups) -> ColliderBuilder {
    collider
        .friction(friction)
        .friction_combine_rule(CoefficientCombineRule::Average)
        .collision_groups(meets)
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}
