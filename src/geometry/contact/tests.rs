//! Contact points against closed forms, in both orders and for all pairs of shapes.

use super::*;
use crate::geometry::ConvexPolygon;

#[test]
fn flush_faces_touch_at_both_ends_of_the_shared_edge() {
    let wide = Footprint::Rectangle { half: Vector::new(0.01, 0.10) };
    let small = Footprint::Rectangle { half: Vector::new(0.03, 0.03) };
    let (points, count) =
        contact_points((&small, &Pose::new(0.05, 0.02, 0.0)), (&wide, &Pose::default()), 0.02);
    assert_eq!(count, 2);
    let mut ends: Vec<f64> = points.iter().flatten().map(|p| p.on_first.y).collect();
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] + 0.01).abs() < 1e-12 && (ends[1] - 0.05).abs() < 1e-12);
    for p in points.iter().flatten() {
        assert!((p.gap - 0.01).abs() < 1e-12);
        assert!((p.normal - Vector::x()).norm() < 1e-12);
    }
}

#[test]
fn both_argument_orders_agree_for_every_pair_of_shapes() {
    let shapes = [
        Footprint::Disc { radius: 0.04 },
        Footprint::Rectangle { half: Vector::new(0.05, 0.02) },
        Footprint::Rectangle { half: Vector::new(0.01, 0.07) },
        prism(&[[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]]),
        prism(&[[0.0, 0.0], [0.04, 0.0], [0.06, 0.03], [0.03, 0.06], [0.0, 0.04]]),
    ];
    let (p, q) = (Pose::new(0.1, 0.02, 0.4), Pose::new(-0.01, 0.0, 2.2));
    for a in &shapes {
        for b in &shapes {
            let (forward, n) = contact_points((a, &p), (b, &q), 1.0);
            let (backward, m) = contact_points((b, &q), (a, &p), 1.0);
            assert_eq!(n, m);
            for (f, g) in forward.iter().flatten().zip(backward.iter().flatten()) {
                let g = g.flipped();
                assert!((f.gap - g.gap).abs() < 1e-12, "{a:?} {b:?}");
                assert!((f.normal - g.normal).norm() < 1e-12);
            }
        }
    }
}

fn prism(corners: &[[f64; 2]]) -> Footprint {
    let corners: Vec<Vector> = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    Footprint::Polygon(ConvexPolygon::new(&corners).expect("convex"))
}

#[test]
fn a_rectangle_written_as_a_polygon_has_the_same_contacts() {
    let half = Vector::new(0.05, 0.02);
    let polygon = prism(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.04], [0.0, 0.04]]);
    let rectangle = Footprint::Rectangle { half };
    let others = [
        Footprint::Disc { radius: 0.03 },
        Footprint::Rectangle { half: Vector::new(0.01, 0.07) },
        prism(&[[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]]),
    ];
    let mut seen = 0;
    for other in &others {
        for k in 0..200 {
            let angle = 0.37 * f64::from(k);
            let at = Pose::new(0.07 * angle.cos(), 0.07 * angle.sin(), 0.61 * f64::from(k));
            let here = Pose::new(0.003, -0.001, 0.2);
            let [p, q] =
                [&rectangle, &polygon].map(|own| contact_points((own, &here), (other, &at), 0.02));
            assert_eq!(p.1, q.1, "{other:?} {k}");
            for (p, q) in p.0.iter().flatten().zip(q.0.iter().flatten()) {
                assert!((p.on_first - q.on_first).norm() < 1e-12, "{other:?} {k} {p:?} {q:?}");
                assert!((p.normal - q.normal).norm() < 1e-12 && (p.gap - q.gap).abs() < 1e-12);
                let kind = |p: &ContactPoint| std::mem::discriminant(&p.follows);
                assert_eq!(kind(p), kind(q), "{other:?} {k} {p:?} {q:?}");
                seen += 1;
            }
        }
    }
    assert!(seen > 300, "{seen}");
}

#[test]
fn a_triangle_meets_a_wall_with_its_side_and_a_disc_with_its_tip() {
    let triangle = prism(&[[0.0, 0.0], [0.06, 0.03], [0.0, 0.06]]);
    let wall = Footprint::Rectangle { half: Vector::new(0.01, 0.2) };
    let behind = Pose::new(-0.02 - 0.01 - 0.002, 0.0, 0.0);
    let (points, count) = contact_points((&triangle, &Pose::default()), (&wall, &behind), 0.01);
    assert_eq!(count, 2);
    for (point, y) in points.iter().flatten().zip([-0.03, 0.03]) {
        assert!((point.gap - 0.002).abs() < 1e-15 && point.follows == Follows::Second);
        assert!((point.on_first - Vector::new(-0.02, y)).norm() < 1e-15, "{point:?}");
    }
    let disc = Footprint::Disc { radius: 0.01 };
    let before = Pose::new(0.04 + 0.01 + 0.001, 0.0, 0.0);
    let (points, _) = contact_points((&disc, &before), (&triangle, &Pose::default()), 0.01);
    let point = points[0].expect("near");
    assert!((point.gap - 0.001).abs() < 1e-15 && (point.normal - Vector::x()).norm() < 1e-12);
    assert!(matches!(point.follows, Follows::Between(..)));
}

#[test]
fn a_body_in_a_face_is_resolved_through_that_face_beside_any_flank() {
    // Every corner is nearer to a flank than to the face that it crossed.
    let square = Footprint::Rectangle { half: Vector::new(0.032, 0.032) };
    let corners = [[0.0, 0.0], [0.064, 0.0], [0.064, 0.064], [0.0, 0.064]];
    for (first, second) in [(&square, &square), (&prism(&corners), &square)] {
        for aside in [0.0, 4e-4, -1e-3] {
            let (p, q) = (Pose::new(-0.059, aside, 0.0), Pose::default());
            let (points, count) = contact_points((first, &p), (second, &q), 0.001);
            assert_eq!(count, 2);
            for point in points.iter().flatten() {
                assert!((point.gap + 0.005).abs() < 1e-12, "{aside}: {}", point.gap);
                assert!((point.normal + Vector::x()).norm() < 1e-12);
                assert!((point.on_first.x + 0.027).abs() < 1e-12);
                assert!((point.on_second.x + 0.032).abs() < 1e-12);
            }
            let (back, _) = contact_points((second, &q), (first, &p), 0.001);
            assert!(back[0].is_some_and(|point| (point.gap + 0.005).abs() < 1e-12));
            // Deep contacts are also found by a query for deep ones only.
            assert_eq!(contact_points((first, &p), (second, &q), -0.004).1, 2);
        }
    }
}
