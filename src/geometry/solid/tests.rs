//! Tests of `solid`.

use super::*;
use crate::geometry::Pose;

#[test]
fn depth_is_that_of_boxes_and_of_crossed_edges() {
    let at = |x: f64, y: f64, z: f64| Pose3::upright(Pose::new(x, y, 0.0), z);
    let cube = Solid::cuboid([1.0; 3], &at(0.0, 0.0, 0.0));
    let beside = Solid::cuboid([1.0; 3], &at(0.9, 0.3, 0.2));
    assert!((cube.depth(&beside) - 0.1).abs() < 1e-12);
    assert!((cube.depth(&Solid::cuboid([1.0; 3], &at(1.5, 0.0, 0.0))) + 0.5).abs() < 1e-12);
    // Each stands on an edge, at right angles: only the axis across both edges separates them.
    let quarter = std::f64::consts::FRAC_PI_4;
    let about = |axis| Pose3::default().turned_about(Vector3::zeros(), axis, quarter);
    let lower = Solid::cuboid([1.0; 3], &about(Vector3::x_axis()));
    let mut above = about(Vector3::y_axis());
    above.position.z = 2f64.sqrt() + 0.01;
    let above = Solid::cuboid([1.0; 3], &above);
    assert!((lower.depth(&above) + 0.01).abs() < 1e-9, "{}", lower.depth(&above));
    let base = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| Vector::new(x, y));
    let wedge = Solid::prism(&base, [0.0, 1.0], &Pose3::default());
    let corner = Solid::cuboid([0.2; 3], &at(0.7, 0.7, 0.5));
    assert!(wedge.depth(&corner) < 0.0, "beyond the long side, within the bounding box");
    assert_eq!(wedge.lowest(), 0.0);
}

#[test]
fn common_areas_are_clipped() {
    let square =
        |a: f64, b: f64| [[a, a], [b, a], [b, b], [a, b]].map(|[x, y]| Vector::new(x, y)).to_vec();
    let mut common = common_area(&square(0.0, 2.0), &square(1.0, 3.0));
    // The clipper chooses the first corner.
    let first = common.iter().position(|corner| *corner == Vector::new(1.0, 1.0));
    common.rotate_left(first.expect("the lower left corner"));
    assert_eq!(common, square(1.0, 2.0));
    assert!(common_area(&square(0.0, 1.0), &square(2.0, 3.0)).is_empty());
}

#[test]
fn difference_and_intersection_partition_a_polygon() {
    let hexagon = |x: f64, y: f64, size: f64, turn: f64| -> Vec<Vector> {
        let angle = |k: i32| turn + std::f64::consts::TAU * f64::from(k) / 6.0;
        let corner = |k| Vector::new(x + size * angle(k).cos(), y + size * angle(k).sin());
        (0..6).map(corner).collect()
    };
    let whole = hexagon(0.0, 0.0, 1.0, 0.0);
    assert!((area_of(&whole) - 1.5 * 3f64.sqrt()).abs() < 1e-12);
    for k in 0..50 {
        let at = |factor: f64| 1.5 * (factor * f64::from(k)).sin();
        let other = hexagon(at(1.1), at(1.7), 0.2 + at(0.3).abs(), at(2.3));
        let left = without(&whole, &other);
        let common = common_area(&whole, &other);
        let sum: f64 = left.iter().map(|piece| area_of(piece)).sum();
        assert!((sum + area_of(&common) - area_of(&whole)).abs() < 1e-9, "{k}");
        for (n, piece) in left.iter().enumerate() {
            assert!(area_of(&common_area(piece, &other)) < 1e-9, "{k}");
            assert!(left[..n].iter().all(|before| area_of(&common_area(piece, before)) < 1e-9));
        }
    }
}
