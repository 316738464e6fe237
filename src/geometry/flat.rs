//! Shapes with straight sides for contact queries: corners, and the nearest point of a boundary.

use super::{ConvexPolygon, MAX_CORNERS, Vector};

/// Sine of the angle to a face beyond which a normal counts as a corner's (3 degrees). Nearer
/// normals count as the face's, so that rounding has no effect where the faces of two shapes end at
/// one place.
const FLUSH: f64 = 0.05;

/// The corners of a rectangle of unit half extents.
pub(super) const CORNERS: [(f64, f64); 4] = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];

/// A convex shape with straight sides, in its own frame.
pub(super) trait Flat {
    fn corners(&self) -> impl Iterator<Item = Vector>;

    fn nearest(&self, point: Vector) -> Nearest;
}

/// The boundary point nearest to a query point, in the shape's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    /// The boundary point.
    pub point: Vector,
    /// Unit outward normal, towards the query point.
    pub normal: Vector,
    /// Signed distance, metres; negative inside.
    pub distance: f64,
    /// Whether the normal belongs to a face, not to a corner.
    pub on_face: bool,
}

/// A rectangle by its half extents, metres.
pub(super) struct Rectangle(pub Vector);

impl Flat for Rectangle {
    fn corners(&self) -> impl Iterator<Item = Vector> {
        CORNERS.into_iter().map(|(x, y)| Vector::new(x * self.0.x, y * self.0.y))
    }

    fn nearest(&self, point: Vector) -> Nearest {
        let Self(half) = *self;
        let clamped = Vector::new(point.x.clamp(-half.x, half.x), point.y.clamp(-half.y, half.y));
        let outside = point - clamped;
        let distance = outside.norm();
        if distance > 1e-12 {
            let normal = outside / distance;
            let on_face = normal.x.abs().min(normal.y.abs()) <= FLUSH;
            return Nearest { point: clamped, normal, distance, on_face };
        }
        let depth_x = half.x - point.x.abs();
        let depth_y = half.y - point.y.abs();
        let (point, normal, distance) = if depth_x <= depth_y {
            let side = if point.x < 0.0 { -1.0 } else { 1.0 };
            (Vector::new(side * half.x, point.y), Vector::new(side, 0.0), -depth_x)
        } else {
            let side = if point.y < 0.0 { -1.0 } else { 1.0 };
            (Vector::new(point.x, side * half.y), Vector::new(0.0, side), -depth_y)
        };
        Nearest { point, normal, distance, on_face: true }
    }
}

/// A polygon with the normals of its sides, computed once for all query points.
pub(super) struct Faced<'a> {
    polygon: &'a ConvexPolygon,
    normals: [Vector; MAX_CORNERS],
}

impl<'a> Faced<'a> {
    pub fn new(polygon: &'a ConvexPolygon) -> Self {
        let mut normals = [Vector::zeros(); MAX_CORNERS];
        for (own, (_, normal)) in normals.iter_mut().zip(polygon.faces()) {
            *own = normal;
        }
        Self { polygon, normals }
    }
}

impl Flat for Faced<'_> {
    fn corners(&self) -> impl Iterator<Item = Vector> {
        self.polygon.corners().iter().copied()
    }

    fn nearest(&self, point: Vector) -> Nearest {
        let sides = || self.polygon.sides().zip(&self.normals);
        let (mut depth, mut face) = (f64::NEG_INFINITY, Vector::x());
        for ((corner, _), normal) in sides() {
            let above = normal.dot(&(point - corner));
            if above > depth {
                (depth, face) = (above, *normal);
            }
        }
        if depth > 1e-12 {
            let (mut square, mut nearest) = (f64::INFINITY, point);
            for ((a, b), normal) in sides() {
                let away = point - a;
                if normal.dot(&away) > 0.0 {
                    let side = b - a;
                    let along = (away.dot(&side) / side.norm_squared()).clamp(0.0, 1.0);
                    let here = a + along * side;
                    let apart = (point - here).norm_squared();
                    if apart < square {
                        (square, nearest) = (apart, here);
                    }
                }
            }
            let distance = square.sqrt();
            let normal = (point - nearest) / distance;
            let flush = |(_, face): (_, &Vector)| normal.dot(face) >= (1.0 - FLUSH * FLUSH).sqrt();
            let on_face = sides().any(flush);
            return Nearest { point: nearest, normal, distance, on_face };
        }
        Nearest { point: point - depth * face, normal: face, distance: depth, on_face: true }
    }
}
