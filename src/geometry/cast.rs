//! How far a footprint can move straight before it touches another: translational time of
//! impact, in closed form.
//!
//! Two shapes with corners: separating axes with moving intervals (the side normals suffice for
//! convex polygons). A disc and one with corners: a ray against that, rounded by the radius. Two
//! discs: a ray against a circle.

use super::flat::CORNERS;
use super::{Footprint, Pose, Vector};

/// Travel, metres, along the unit vector `direction` after which `moving` first touches `still`.
///
/// 0 if they touch or overlap already; `None` if they never meet. Sliding past with faces that just
/// touch does not count as meeting.
pub fn travel_to_contact(
    moving: (&Footprint, &Pose),
    direction: Vector,
    still: (&Footprint, &Pose),
) -> Option<f64> {
    let (from, at) = (moving.1.position, still.1.position);
    let span = match (moving.0, still.0) {
        (&Footprint::Disc { radius: a }, &Footprint::Disc { radius: b }) => {
            in_disc(from - at, direction, a + b)
        }
        (&Footprint::Disc { radius }, shape) => {
            in_rounded(still.1.local_point(from), still.1.local_vector(direction), shape, radius)
        }
        // Seen from what moves, the disc comes the other way.
        (shape, &Footprint::Disc { radius }) => {
            in_rounded(moving.1.local_point(at), -moving.1.local_vector(direction), shape, radius)
        }
        _ => flats(moving, direction, still),
    }?;
    (span.1 >= 0.0).then_some(span.0.max(0.0))
}

/// Stretch of the ray from `point` along `direction` inside the disc about the origin.
fn in_disc(point: Vector, direction: Vector, radius: f64) -> Option<(f64, f64)> {
    let along = point.dot(&direction);
    let square = along * along - point.norm_squared() + radius * radius;
    (square > 0.0).then(|| (-along - square.sqrt(), -along + square.sqrt()))
}

/// Stretch of the ray inside the box about the origin.
fn in_box(point: Vector, direction: Vector, half: Vector) -> Option<(f64, f64)> {
    let x = in_interval(point.x, direction.x, (-half.x, half.x))?;
    let y = in_interval(point.y, direction.y, (-half.y, half.y))?;
    let (enter, leave) = (x.0.max(y.0), x.1.min(y.1));
    (enter < leave).then_some((enter, leave))
}

/// Stretch of time in which `position + t speed` is between both ends.
fn in_interval(position: f64, speed: f64, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    if speed.abs() < 1e-12 {
        return (low < position && position < high).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (a, b) = ((low - position) / speed, (high - position) / speed);
    Some((a.min(b), a.max(b)))
}

/// Stretch of the ray inside a shape with corners rounded outwards by `radius`: the union of the
/// shape, of a strip along each side and of a disc at each corner.
fn in_rounded(
    point: Vector,
    direction: Vector,
    shape: &Footprint,
    radius: f64,
) -> Option<(f64, f64)> {
    let join = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    match shape {
        Footprint::Disc { radius: own } => in_disc(point, direction, own + radius),
        Footprint::Rectangle { half } => {
            let boxes = [
                in_box(point, direction, half + Vector::new(radius, 0.0)),
                in_box(point, direction, half + Vector::new(0.0, radius)),
            ];
            let corners = CORNERS.map(|(x, y)| Vector::new(x * half.x, y * half.y));
            let discs = corners.map(|corner| in_disc(point - corner, direction, radius));
            boxes.into_iter().chain(discs).flatten().reduce(join)
        }
        Footprint::Polygon(polygon) => {
            let inside = (polygon.faces())
                .map(|(corner, normal)| (normal, (f64::NEG_INFINITY, corner.dot(&normal))))
                .try_fold((f64::NEG_INFINITY, f64::INFINITY), |span, (normal, ends)| {
                    let next = in_interval(point.dot(&normal), direction.dot(&normal), ends)?;
                    let (enter, leave) = (span.0.max(next.0), span.1.min(next.1));
                    (enter < leave).then_some((enter, leave))
                });
            let along_sides = polygon.sides().zip(polygon.faces()).map(|((a, b), (_, normal))| {
                // The strip's own axes: along the side, outwards.
                let (middle, length) = ((a + b + radius * normal) / 2.0, (b - a).norm());
                let axis = (b - a) / length;
                let own = |v: Vector| Vector::new(v.dot(&axis), v.dot(&normal));
                in_box(own(point - middle), own(direction), Vector::new(length, radius) / 2.0)
            });
            let discs =
                polygon.corners().iter().map(|corner| in_disc(point - corner, direction, radius));
            std::iter::once(inside).chain(along_sides).chain(discs).flatten().reduce(join)
        }
    }
}

/// Separating axes of two shapes with corners: while both overlap along all of them they meet.
fn flats(
    (moving, from): (&Footprint, &Pose),
    direction: Vector,
    (still, at): (&Footprint, &Pose),
) -> Option<(f64, f64)> {
    let between = from.position - at.position;
    let mut span = (f64::NEG_INFINITY, f64::INFINITY);
    let mut narrow = |axis: Vector| {
        let (own, other) = (from.local_vector(axis), at.local_vector(axis));
        let ends = (
            -(moving.extent(own) + still.extent(-other)),
            moving.extent(-own) + still.extent(other),
        );
        let next = in_interval(between.dot(&axis), direction.dot(&axis), ends)?;
        span = (span.0.max(next.0), span.1.min(next.1));
        Some(())
    };
    for (shape, pose) in [(moving, from), (still, at)] {
        match shape {
            Footprint::Polygon(polygon) => {
                for (_, normal) in polygon.faces() {
                    narrow(pose.vector(normal))?;
                }
            }
            _ => {
                narrow(pose.vector(Vector::x()))?;
                narrow(pose.vector(Vector::y()))?;
            }
        }
    }
    (span.0 < span.1).then_some(span)
}

#[cfg(test)]
mod tests {
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
        // A square turned by 45 degrees comes with its corner first.
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
}
