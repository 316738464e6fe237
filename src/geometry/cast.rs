//! Distance that a footprint can move straight before it touches another: translational time of
//! impact, in closed form.
//!
//! Two shapes with corners: separating axes with moving intervals (the side normals suffice for
//! convex polygons). A disc and a shape with corners: a ray against the shape rounded by the
//! radius. Two discs: a ray against a circle.

use super::flat::CORNERS;
use super::{Footprint, Pose, Vector};

/// Returns the travel, metres, along the unit vector `direction` until `moving` first touches
/// `still`.
///
/// Returns 0 if they already touch or overlap, and `None` if they never meet. Faces that only touch
/// while sliding past do not meet.
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
        // In the frame of the moving shape, the disc approaches from the opposite direction.
        (shape, &Footprint::Disc { radius }) => {
            in_rounded(moving.1.local_point(at), -moving.1.local_vector(direction), shape, radius)
        }
        _ => flats(moving, direction, still),
    }?;
    (span.1 >= 0.0).then_some(span.0.max(0.0))
}

/// Returns the stretch of the ray from `point` along `direction` inside the disc about the origin.
fn in_disc(point: Vector, direction: Vector, radius: f64) -> Option<(f64, f64)> {
    let along = point.dot(&direction);
    let square = along * along - point.norm_squared() + radius * radius;
    (square > 0.0).then(|| (-along - square.sqrt(), -along + square.sqrt()))
}

/// Returns the stretch of the ray inside the box about the origin.
fn in_box(point: Vector, direction: Vector, half: Vector) -> Option<(f64, f64)> {
    let x = in_interval(point.x, direction.x, (-half.x, half.x))?;
    let y = in_interval(point.y, direction.y, (-half.y, half.y))?;
    let (enter, leave) = (x.0.max(y.0), x.1.min(y.1));
    (enter < leave).then_some((enter, leave))
}

/// Returns the time interval in which `position + t speed` is between both ends.
fn in_interval(position: f64, speed: f64, (low, high): (f64, f64)) -> Option<(f64, f64)> {
    if speed.abs() < 1e-12 {
        return (low < position && position < high).then_some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (a, b) = ((low - position) / speed, (high - position) / speed);
    Some((a.min(b), a.max(b)))
}

/// Returns the stretch of the ray inside a shape rounded outwards by `radius`: the union of the
/// shape, a strip along each side and a disc at each corner.
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
                // Axes of the strip: along the side, and outwards.
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

/// Returns the travel interval in which two shapes with corners overlap along all separating axes.
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
mod tests;
