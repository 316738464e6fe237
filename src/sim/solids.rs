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

fn half_space() -> ColliderBuilder {
    ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
}

/// The coefficient of a pair is the mean of the two values.
pub(super) fn rubbing(collider: ColliderBuilder, friction: f64) -> ColliderBuilder {
    collider.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyBuilder};

    use super::*;
    use crate::geometry::ConvexPolygon;

    fn octagon() -> Shape {
        let corner = |k: u32| (0.1 + std::f64::consts::FRAC_PI_4 * f64::from(k)).sin_cos();
        let corners: Vec<Planar> =
            (0..8).map(corner).map(|(y, x)| 0.04 * Planar::new(x, y)).collect();
        Shape::Prism { base: ConvexPolygon::new(&corners).expect("convex"), height: 0.06 }
    }

    #[test]
    fn a_prism_is_cut_into_slabs_that_hold_all_of_it() {
        let Shape::Prism { base, .. } = octagon() else { unreachable!() };
        for count in 3..=8 {
            let base = ConvexPolygon::new(&base.corners()[..count]).expect("convex");
            let slabs = slabs(&Shape::Prism { base, height: 0.1 });
            assert_eq!(slabs.is_empty(), count <= 4);
            let area = |slab: &Vec<Planar>| ConvexPolygon::new(slab).expect("convex").area();
            let whole: f64 = slabs.iter().map(area).sum();
            assert!(count <= 4 || (whole / base.area() - 1.0).abs() < 1e-9, "{count}");
        }
    }

    /// On four corners of its underside alone it would lean by tens of degrees.
    #[test]
    fn a_prism_of_eight_corners_without_feet_stands_on_its_underside() {
        let shape = octagon();
        for lean in [0.0, 0.05, -0.05] {
            let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
            world.insert_collider(table(0.5), None);
            let pose = Pose3::from_parts(Vector::Z * 0.035, Rotation::from_rotation_x(lean));
            let body = world.insert_body(RigidBodyBuilder::dynamic().pose(pose));
            let own = weighing(solid(&shape, Pose3::IDENTITY, 0.5), &shape, 0.4);
            world.insert_collider(own, Some(body));
            for underside in undersides(&shape, Pose3::IDENTITY, 0.5) {
                world.insert_collider(underside, Some(body));
            }
            (0..240).for_each(|_| world.step());
            let body = &world.bodies[body];
            let up = *body.rotation() * Vector::Z;
            assert!(up.z > 0.5f64.to_radians().cos(), "{lean}: {up}");
            // rapier lets bodies sink by a millimetre unless told otherwise.
            assert!((body.translation().z - 0.03).abs() < 2e-3, "{lean}: {}", body.translation());
        }
    }

    #[test]
    fn an_objects_mass_lies_about_its_centre_of_mass() {
        let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.04], [0.0, 0.04]];
        let corners = corners.map(|[x, y]| Planar::new(x, y));
        let base = ConvexPolygon::balanced(&corners, Planar::new(0.03, 0.02)).expect("convex");
        let shape = Shape::Prism { base, height: 0.06 };
        let collider = weighing(solid(&shape, Pose3::IDENTITY, 0.5), &shape, 0.4).build();
        let found = collider.mass_properties();
        assert!((found.mass() - 0.4).abs() < 1e-12 && found.local_com.length() < 1e-15);
        let mut moments = found.principal_inertia().to_array();
        moments.sort_by(f64::total_cmp);
        let (xx, yy) = (0.1f64.powi(2) / 12.0 + 0.02f64.powi(2), 0.04f64.powi(2) / 12.0);
        let zz = 0.06f64.powi(2) / 12.0;
        for (found, expected) in moments.into_iter().zip([yy + zz, xx + yy, xx + zz]) {
            assert!((found - 0.4 * expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}
