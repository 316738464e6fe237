//! Tests of `underside`.

use super::*;
use crate::geometry::Footprint;
use crate::scene::Support;

fn polygon(corners: &[[f64; 2]]) -> ConvexPolygon {
    let corners: Vec<Vector> = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    ConvexPolygon::new(&corners).expect("convex")
}

#[test]
fn even_feet_under_polygons_have_the_moments_of_even_pressure() {
    let house = [[0.0, 0.0], [0.08, 0.0], [0.08, 0.05], [0.04, 0.09], [0.0, 0.06]];
    let ring = |n: u32| {
        let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        (0..n).map(|k| [0.04 * angle(k).cos(), 0.04 * angle(k).sin()]).collect::<Vec<_>>()
    };
    let shapes = [
        (polygon(&[[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]]), 1e-9),
        (polygon(&[[0.0, 0.0], [0.10, 0.0], [0.07, 0.04], [0.02, 0.05]]), 1e-9),
        (polygon(&house), 0.04),
        (polygon(&ring(5)), 0.034),
        (polygon(&ring(6)), 0.024),
        (polygon(&ring(8)), 0.014),
    ];
    for (shape, off) in shapes {
        let feet = Support::Even.feet(&Footprint::Polygon(shape));
        let sum = |value: &dyn Fn(Vector) -> f64| -> f64 {
            feet.each().map(|(at, load)| load * value(at)).sum()
        };
        assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-12, "{shape:?}");
        assert!(sum(&|at| at.x).abs() < 1e-15 && sum(&|at| at.y).abs() < 1e-15);
        let moments = [sum(&|at| at.x * at.x), sum(&|at| at.x * at.y), sum(&|at| at.y * at.y)];
        for (found, expected) in moments.into_iter().zip(shape.second_moments()) {
            assert!((found - expected).abs() < 1e-15, "{shape:?} {found} {expected}");
        }
        let ratio = feet.mean_radius / shape.mean_radius();
        assert!((1.0 - 1e-9..1.0 + off).contains(&ratio), "{shape:?} {ratio}");
        // All points lie under the object.
        for (at, _) in feet.each() {
            let mut faces = shape.faces();
            assert!(faces.all(|(corner, normal)| normal.dot(&(at - corner)) < 1e-12));
        }
    }
}

#[test]
fn a_square_stands_alike_however_it_is_written() {
    let half = Vector::new(0.04, 0.04);
    let square = polygon(&[[0.0, 0.0], [0.08, 0.0], [0.08, 0.08], [0.0, 0.08]]);
    for (support, off) in [(Support::Even, 0.006), (Support::Spread(0.7), 1e-12)] {
        let own = support.feet(&Footprint::Polygon(square));
        let other = support.feet(&Footprint::Rectangle { half });
        assert_eq!(own.count, other.count);
        assert!((own.mean_square / other.mean_square - 1.0).abs() < 1e-12);
        assert!((own.mean_radius / other.mean_radius - 1.0).abs() < off);
    }
}

#[test]
fn a_centre_of_mass_aside_is_carried_where_it_is() {
    let corners = [[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]].map(|[x, y]| Vector::new(x, y));
    for centre in [[0.03, 0.02], [0.035, 0.02], [0.01, 0.045], [0.07, 0.005]] {
        let shape = ConvexPolygon::balanced(&corners, Vector::new(centre[0], centre[1]));
        let footprint = Footprint::Polygon(shape.expect("inside"));
        for support in [Support::Even, Support::Corners, Support::Spread(0.6)] {
            let feet = support.feet(&footprint);
            let sum: f64 = feet.load.iter().sum();
            let moment: Vector = feet.each().map(|(at, load)| load * at).sum();
            assert!((sum - 1.0).abs() < 1e-9 && moment.norm() < 1e-9, "{centre:?} {support:?}");
            assert!(feet.load.iter().all(|load| *load >= 0.0));
        }
    }
}
