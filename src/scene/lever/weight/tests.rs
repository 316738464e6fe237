//! Tests of `weight`.

use super::*;
use crate::geometry::Pose;

fn box_slab(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> Slab {
    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
    let corners = corners.map(|[x, y]| Vector::new(x, y)).to_vec();
    Slab { corners, bottom: z[0], height: z[1] - z[0] }
}

fn plate(slabs: Vec<Slab>) -> Plate {
    let pose = Pose::new(0.5, -0.1, 0.7);
    Plate {
        name: "plate".to_owned(),
        slabs,
        mass: 0.3,
        friction: 0.4,
        clearance: 0.0,
        pose,
        z: 0.0,
    }
}

#[test]
fn a_cuboid_in_three_pieces_weighs_as_one() {
    let whole = plate(vec![box_slab([0.0, 0.08], [0.0, 0.05], [0.0, 0.02])]).balanced();
    let pieces = plate(vec![
        box_slab([0.0, 0.08], [0.0, 0.05], [0.0, 0.005]),
        box_slab([0.0, 0.03], [0.0, 0.05], [0.005, 0.02]),
        box_slab([0.03, 0.08], [0.0, 0.05], [0.005, 0.02]),
    ])
    .balanced();
    let (whole, pieces) = (whole.weight(), pieces.weight());
    let [x, y, z] = [0.08f64, 0.05, 0.02].map(|v| v * v);
    let known = [y + z, x + z, x + y].map(|sum| 0.3 / 12.0 * sum);
    for k in 0..6 {
        let known = known.get(k).copied().unwrap_or(0.0);
        assert!((whole.inertia[k] - known).abs() < 1e-15, "{k}");
        assert!((pieces.inertia[k] - known).abs() < 1e-15, "{k}");
    }
    assert!((whole.centre - pieces.centre).norm() < 1e-15);
    assert!((whole.centre - Vector3::new(0.0, 0.0, 0.01)).norm() < 1e-15);
}

#[test]
fn balancing_moves_the_frame_and_nothing_else() {
    let before = plate(vec![box_slab([0.01, 0.08], [0.02, 0.05], [0.0, 0.02])]);
    let after = before.clone().balanced();
    for (a, b) in before.corners().iter().zip(after.corners()) {
        assert!((before.pose.point(*a) - after.pose.point(*b)).norm() < 1e-15);
    }
}
