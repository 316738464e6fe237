//! Tests of `polygon`.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::geometry::Footprint;

fn polygon(corners: &[[f64; 2]]) -> Result<ConvexPolygon, PolygonError> {
    let corners: Vec<Vector> = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    ConvexPolygon::new(&corners)
}

fn regular(count: usize, radius: f64) -> ConvexPolygon {
    let angle = |k: usize| 0.3 + TAU * k as f64 / count as f64;
    let corners: Vec<Vector> = (0..count)
        .map(|k| Vector::new(0.2, -0.1) + radius * Vector::new(angle(k).cos(), angle(k).sin()))
        .collect();
    ConvexPolygon::new(&corners).unwrap()
}

#[test]
fn regular_polygons_have_the_moments_of_textbooks() {
    for count in 3..=MAX_CORNERS {
        let (shape, step) = (regular(count, 0.05), PI / count as f64);
        let [xx, xy, yy] = shape.second_moments();
        // I = m R^2 (2 + cos(2 pi / n)) / 6, equal about every axis.
        let gyration = 0.05 * 0.05 * (2.0 + (2.0 * step).cos()) / 6.0;
        assert!((xx + yy - gyration).abs() < 1e-15, "{count}");
        assert!((xx - yy).abs() < 1e-15 && xy.abs() < 1e-15, "{count}");
        let area = 0.5 * count as f64 * 0.05 * 0.05 * (2.0 * step).sin();
        assert!((shape.area() - area).abs() < 1e-15);
        assert!((shape.inner_radius() - 0.05 * step.cos()).abs() < 1e-15);
        assert!((shape.bounding_radius() - 0.05).abs() < 1e-15);
        assert_eq!(shape.symmetry(), count);
    }
}

#[test]
fn a_right_triangle_has_the_moments_of_textbooks() {
    let shape = polygon(&[[0.4, 0.2], [0.4, 0.26], [0.31, 0.2]]).unwrap();
    let (b, h) = (0.09, 0.06);
    let [xx, xy, yy] = shape.second_moments();
    assert!((xx - b * b / 18.0).abs() < 1e-15 && (yy - h * h / 18.0).abs() < 1e-15);
    // The right angle is on the left here.
    assert!((xy - b * h / 36.0).abs() < 1e-15, "{xy}");
    assert_eq!(shape.symmetry(), 1);
}

#[test]
fn a_rectangle_is_the_rectangle() {
    let shape = polygon(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.04], [0.0, 0.04]]).unwrap();
    let own = Footprint::Polygon(shape);
    let half = Vector::new(0.05, 0.02);
    let other = Footprint::Rectangle { half };
    assert!((own.mean_radius() - other.mean_radius()).abs() < 1e-15);
    assert!((own.gyration_radius() - other.gyration_radius()).abs() < 1e-15);
    let grown = Footprint::Polygon(shape.grown(0.003));
    assert!((grown.area() - other.grown(0.003).area()).abs() < 1e-15);
    for k in 0..16 {
        let direction = Vector::new((0.4 * f64::from(k)).cos(), (0.4 * f64::from(k)).sin());
        assert!((own.extent(direction) - other.extent(direction)).abs() < 1e-15);
    }
    assert_eq!(own.symmetry(), other.symmetry());
    assert_eq!(own.symmetry(), Some(2));
}

#[test]
fn clockwise_corners_are_turned_around_and_reading_back_changes_nothing() {
    let shape = polygon(&[[0.0, 0.0], [0.0, 0.06], [0.09, 0.0]]).unwrap();
    assert!(shape.area() > 0.0);
    assert!((shape.corners()[0] - Vector::new(-0.03, -0.02)).norm() < 1e-15);
    assert_eq!(ConvexPolygon::try_from(Vec::from(shape)), Ok(shape));
}

#[test]
fn invalid_convex_polygons_state_the_reason() {
    let square = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]];
    let with = |at: usize, corner: [f64; 2]| {
        let mut corners = square.to_vec();
        corners.insert(at, corner);
        let found = polygon(&corners);
        corners.reverse();
        assert!(polygon(&corners).is_err());
        found
    };
    assert_eq!(with(1, [0.05, 0.0]), Err(PolygonError::Straight(1)));
    assert_eq!(with(2, [0.05, 0.05]), Err(PolygonError::Inwards(2)));
    assert_eq!(with(3, [0.1003, 0.1]), Err(PolygonError::Doubled(3)));
    let clockwise = [[0.0, 0.0], [0.0, 0.1], [0.05, 0.05], [0.1, 0.1], [0.1, 0.0]];
    assert_eq!(polygon(&clockwise), Err(PolygonError::Inwards(2)));
    assert_eq!(polygon(&square[..2]), Err(PolygonError::Count(2)));
    let star: Vec<[f64; 2]> = (0..5)
        .map(|k| (2.0 * TAU / 5.0 * f64::from(k)).sin_cos())
        .map(|(y, x)| [0.1 * x, 0.1 * y])
        .collect();
    assert_eq!(polygon(&star), Err(PolygonError::Crossing));
    assert_eq!(polygon(&[[0.0, 0.0], [0.1, 0.0], [0.05, 0.0009]]), Err(PolygonError::Size));
    assert_eq!(polygon(&[[0.0, 0.0], [1e3, 0.0], [0.0, f64::NAN]]), Err(PolygonError::Size));
    let corners = square.map(|[x, y]| Vector::new(x, y));
    let outside = ConvexPolygon::balanced(&corners, Vector::new(0.11, 0.05));
    assert_eq!(outside, Err(PolygonError::Unbalanced));
}

#[test]
fn moments_are_about_the_centre_of_mass() {
    let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.04], [0.0, 0.04]];
    let corners = corners.map(|[x, y]| Vector::new(x, y));
    let shape = ConvexPolygon::balanced(&corners, Vector::new(0.03, 0.02)).unwrap();
    let [xx, _, yy] = shape.second_moments();
    assert!((xx - (0.1f64.powi(2) / 12.0 + 0.02f64.powi(2))).abs() < 1e-15);
    assert!((yy - 0.04f64.powi(2) / 12.0).abs() < 1e-15);
    assert_eq!(shape.symmetry(), 1);
}
