//! Tests of `solids`.

use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyBuilder};

use super::*;
use crate::geometry::ConvexPolygon;

fn octagon() -> Shape {
    let corner = |k: u32| (0.1 + std::f64::consts::FRAC_PI_4 * f64::from(k)).sin_cos();
    let corners: Vec<Planar> = (0..8).map(corner).map(|(y, x)| 0.04 * Planar::new(x, y)).collect();
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

/// A prism on only four corners of its underside would lean by tens of degrees.
#[test]
fn a_prism_of_eight_corners_without_feet_stands_on_its_underside() {
    let shape = octagon();
    for lean in [0.0, 0.05, -0.05] {
        let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
        world.insert_collider(table(0.5, None), None);
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
        // rapier lets bodies sink by a millimetre by default.
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
