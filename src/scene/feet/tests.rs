//! Tests of `feet`.

use super::*;
use crate::geometry::Vector3;

const SHAPES: [Footprint; 3] = [
    Footprint::Disc { radius: 0.05 },
    Footprint::Rectangle { half: Vector::new(0.04, 0.04) },
    Footprint::Rectangle { half: Vector::new(0.08, 0.02) },
];

#[test]
fn even_feet_have_the_moments_of_even_pressure() {
    for shape in SHAPES {
        let feet = Support::Even.feet(&shape);
        assert!((feet.load.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let centre: Vector = feet.each().map(|(at, load)| load * at).sum();
        assert!(centre.norm() < 1e-15);
        let (mean, square) = (feet.mean_radius, feet.mean_square);
        assert!((square / shape.gyration_radius().powi(2) - 1.0).abs() < 1e-9, "{shape:?}");
        assert!((mean / shape.mean_radius() - 1.0).abs() < 0.006, "{shape:?} {mean}");
    }
}

#[test]
fn the_load_of_a_leaning_object_has_its_centre_there() {
    for shape in SHAPES {
        for support in [Support::Even, Support::Corners] {
            let feet = support.feet(&shape);
            let lean = Vector::new(0.004, -0.002);
            let loads = feet.leaning(lean);
            let centre: Vector = feet.each().zip(loads).map(|((at, _), load)| load * at).sum();
            assert!((centre - lean).norm() < 1e-12, "{shape:?} {support:?}: {centre}");
            // At so low a speed all points have equal weights, and the load's first moment remains.
            let motion = (Vector::new(0.1, 0.03), 0.4);
            let drag = feet.drag(Vector::x(), motion, 1.0, lean);
            assert!((drag.first - lean).norm() < 1e-12, "{shape:?} {support:?}: {drag:?}");
        }
    }
}

#[test]
fn fewer_feet_have_the_same_second_moments() {
    for shape in SHAPES {
        let feet = Support::Even.feet(&shape);
        let fewer = few(&feet, &shape);
        assert!(fewer.count <= 8 && fewer.round == feet.round);
        let second = |feet: &Feet| {
            let moments = feet
                .each()
                .map(|(at, load)| load * Vector3::new(at.x * at.x, at.x * at.y, at.y * at.y));
            moments.sum::<Vector3>()
        };
        let (few, all) = (second(&fewer), second(&feet));
        assert!((few - all).norm() < 1e-9 * all.norm(), "{shape:?}");
        // Stated points stay, whatever their number.
        let points: Vec<Vector> = feet.each().map(|(at, _)| at).collect();
        let stated = Support::Points(points).feet(&shape);
        assert_eq!(super::few(&stated, &shape), stated);
    }
}

#[test]
fn harmonics_turn_with_the_object() {
    let points = [(0.03, 0.0), (-0.02, 0.02), (-0.02, -0.04)].map(|(x, y)| Vector::new(x, y));
    let (sin, cos) = 0.7f64.sin_cos();
    let turned = points.map(|p| Vector::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y));
    let [feet, other] =
        [points, turned].map(|points| Support::Points(points.to_vec()).feet(&SHAPES[0]));
    let found = feet.harmonics_turned(Vector::new(cos, sin));
    for (a, b) in found.iter().zip(other.harmonics) {
        assert!((a - b).norm() < 1e-12 && b.norm() > 0.01, "{a} {b}");
    }
    // A square's corners differ from a circle in the fourth harmonic alone.
    let square = Support::Corners.feet(&SHAPES[1]).harmonics;
    assert!(square[0].norm() < 1e-12 && square[1].norm() < 1e-12);
    assert!((square[2] + Vector::x()).norm() < 1e-12);
}

/// While it slides with little rotation, a disc under even pressure resists with a quarter of R^2.
#[test]
fn a_slide_that_hardly_turns_feels_the_second_moment_along_it() {
    for shape in SHAPES {
        let feet = Support::Even.feet(&shape);
        let second = match shape {
            Footprint::Disc { radius } => radius * radius / 4.0,
            Footprint::Rectangle { half } => half.x * half.x / 3.0,
            Footprint::Polygon(polygon) => polygon.second_moments()[0],
        };
        let (speed, turning) = (0.1, 1e-4);
        let drag =
            feet.drag(Vector::x(), (Vector::new(speed, 0.0), turning), 1e-9, Vector::zeros());
        // Torque: the translation acts on the points' first moment, the rotation on their second.
        let torque = -drag.first.y * speed + drag.second * turning;
        assert!((torque / (second * turning / speed) - 1.0).abs() < 1e-3, "{shape:?}");
    }
}
