//! Tests of `support_edge`.

use super::*;

fn outline(corners: &[[f64; 2]]) -> Vec<Vector> {
    corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect()
}

#[test]
fn a_rectangle_stands_on_the_opposite_side() {
    let corners = outline(&[[-0.06, -0.04], [0.06, -0.04], [0.06, 0.04], [-0.06, 0.04]]);
    let found = support_edge(&corners, Vector::new(-0.06, 0.01), Vector::zeros()).unwrap();
    assert_eq!(found.edge, 1);
    assert!((found.distance - 0.12).abs() < 1e-15);
    // The ray meets it 1 cm below the middle of its 8 cm.
    assert!((found.fraction - 0.375).abs() < 1e-12);
    // From a point far enough along a side the ray leaves through the neighbouring side.
    let found = support_edge(&corners, Vector::new(-0.055, 0.04), Vector::zeros()).unwrap();
    assert_eq!(found.edge, 0);
    assert!((found.distance - 0.08).abs() < 1e-15);
}

#[test]
fn it_turns_with_the_outline_and_swaps_under_a_mirror() {
    let corners = outline(&[[-0.05, -0.03], [0.04, -0.05], [0.07, 0.02], [-0.02, 0.06]]);
    let centre = Vector::new(0.012, 0.003);
    for edge in 0..4 {
        for fraction in [0.2, 0.5, 0.85] {
            let point = corners[edge] + (corners[(edge + 1) % 4] - corners[edge]) * fraction;
            let found = support_edge(&corners, point, centre).unwrap();
            let mirrored: Vec<Vector> =
                corners.iter().rev().map(|c| Vector::new(c.x, -c.y)).collect();
            let mirror = |v: Vector| Vector::new(v.x, -v.y);
            let other = support_edge(&mirrored, mirror(point), mirror(centre)).unwrap();
            // Corner k is now corner 3 - k, so the side from k to k + 1 begins at 3 - (k + 1).
            assert_eq!(other.edge, (6 - found.edge) % 4);
            assert!((other.distance - found.distance).abs() < 1e-15);
            assert!((other.fraction + found.fraction - 1.0).abs() < 1e-12);
            let turn = crate::geometry::Pose::new(0.3, -0.2, 1.1);
            let turned: Vec<Vector> = corners.iter().map(|c| turn.point(*c)).collect();
            let other = support_edge(&turned, turn.point(point), turn.point(centre)).unwrap();
            assert_eq!(other.edge, found.edge);
            assert!((other.distance - found.distance).abs() < 1e-15);
        }
    }
}

#[test]
fn polygons_without_area_have_no_support() {
    let point = Vector::new(0.1, 0.0);
    assert_eq!(support_edge(&[], point, Vector::zeros()), None);
    assert_eq!(support_edge(&[point; 3], point, Vector::zeros()), None);
    let corners = outline(&[[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]);
    assert_eq!(support_edge(&corners, Vector::zeros(), Vector::zeros()), None);
    let nowhere = Vector::new(f64::NAN, 0.0);
    assert_eq!(support_edge(&corners, nowhere, Vector::zeros()), None);
}
