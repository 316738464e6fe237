//! Tests of `cast`.

use super::*;
use crate::geometry::{ConvexPolygon, clearance};

fn polygon(corners: &[[f64; 2]]) -> Footprint {
    let corners: Vec<Vector> = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    Footprint::Polygon(ConvexPolygon::new(&corners).expect("convex"))
}

#[test]
fn closed_forms() {
    let disc = Footprint::Disc { radius: 0.05 };
    let square = Footprint::Rectangle { half: Vector::new(0.02, 0.02) };
    let from = Pose::default();
    let at = Pose::new(0.3, 0.03, 0.0);
    let meet = |a, b| travel_to_contact((a, &from), Vector::x(), (b, &at));
    let near = |found: Option<f64>, expected: f64| {
        assert!((found.unwrap_or(f64::NAN) - expected).abs() < 1e-12, "{found:?} {expected}");
    };
    near(meet(&disc, &disc), 0.3 - (0.1f64.powi(2) - 0.03f64.powi(2)).sqrt());
    near(meet(&square, &square), 0.26);
    // The square's corner at (0.02, 0.02) meets the disc 0.01 below its centre.
    near(meet(&square, &disc), 0.28 - (0.05f64.powi(2) - 0.01f64.powi(2)).sqrt());
    near(meet(&disc, &square), 0.28 - (0.05f64.powi(2) - 0.01f64.powi(2)).sqrt());
    // A square rotated by 45 degrees approaches with its corner first.
    let turned = Pose::new(0.0, 0.03, std::f64::consts::FRAC_PI_4);
    near(
        travel_to_contact((&square, &turned), Vector::x(), (&square, &at)),
        0.28 - 0.02 * std::f64::consts::SQRT_2,
    );
    assert_eq!(travel_to_contact((&disc, &from), -Vector::x(), (&disc, &at)), None);
    assert_eq!(travel_to_contact((&disc, &from), Vector::y(), (&disc, &at)), None);
}

#[test]
fn the_gap_closes_exactly_at_the_reported_travel() {
    let shapes = [
        Footprint::Disc { radius: 0.04 },
        Footprint::Rectangle { half: Vector::new(0.06, 0.02) },
        Footprint::Rectangle { half: Vector::new(0.01, 0.05) },
        polygon(&[[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]]),
        polygon(&[[0.0, 0.0], [0.04, 0.0], [0.06, 0.03], [0.03, 0.06], [0.0, 0.04]]),
    ];
    let direction = Vector::new(0.3f64.cos(), 0.3f64.sin());
    for a in &shapes {
        for b in &shapes {
            for k in 0..40 {
                let from = Pose::new(-0.3, -0.2 + 0.01 * k as f64, 0.37 * k as f64);
                let still = Pose::new(0.05, 0.03, 1.1);
                let gap = |t: f64| {
                    let pose = Pose { position: from.position + direction * t, ..from };
                    clearance((a, &pose), (b, &still), 1.0)
                };
                match travel_to_contact((a, &from), direction, (b, &still)) {
                    Some(t) => {
                        assert!(gap(t - 1e-4) > 0.0, "{a:?} {b:?} {k}");
                        assert!(gap(t + 1e-6) < 1e-6, "{a:?} {b:?} {k}");
                    }
                    None => {
                        assert!((0..100).all(|n| gap(0.01 * n as f64) > 0.0));
                    }
                }
            }
        }
    }
}
