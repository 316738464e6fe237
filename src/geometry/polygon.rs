//! Convex polygons: the footprint of an upright prism on the table.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Vector, cross};

/// Maximum number of corners of a polygon.
pub const MAX_CORNERS: usize = 8;

/// Distance below which two corners coincide, and minimum width of a polygon, metres.
const SMALLEST: f64 = 1e-3;

/// Maximum distance of a corner from the centre of mass, metres.
const LARGEST: f64 = 10.0;

/// Minimum distance of the centre of mass from a side, metres.
const INSIDE: f64 = 1e-4;

/// Minimum angle by which the outline turns at a corner, radians: one degree.
const STRAIGHT: f64 = 0.0175;

/// Deviation below which a rotated polygon coincides with itself, relative to its size: corners
/// given in whole millimetres are rounded.
const ALIKE: f64 = 0.01;

/// A convex polygon whose origin is the centre of mass of the body above it.
///
/// ```
/// use pushplan::{ConvexPolygon, Vector};
///
/// // Three corners anywhere; the polygon lies about its centroid.
/// let corners = [[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]].map(|[x, y]| Vector::new(x, y));
/// let plate = ConvexPolygon::new(&corners)?;
/// assert!((plate.corners()[0] - Vector::new(-0.03, -0.02)).norm() < 1e-12);
/// assert!((plate.area() - 0.0027).abs() < 1e-12);
/// # Ok::<(), pushplan::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Vector>", into = "Vec<Vector>")]
pub struct ConvexPolygon {
    corners: [Vector; MAX_CORNERS],
    count: usize,
}

/// Reason why corners do not form a convex polygon; corners are counted from zero.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PolygonError {
    /// Fewer than three or more than [`MAX_CORNERS`].
    #[error("a polygon has 3 to {MAX_CORNERS} corners, not {0}")]
    Count(usize),
    /// Two coincident corners; index of the second.
    #[error("corner {} lies on another one", .0 + 1)]
    Doubled(usize),
    /// A corner at which the outline does not turn.
    #[error("corner {} lies on the line between its neighbours", .0 + 1)]
    Straight(usize),
    /// A corner at which the outline turns inwards.
    #[error("the outline turns inwards at corner {}", .0 + 1)]
    Inwards(usize),
    /// An outline that winds more than once.
    #[error("the outline crosses itself")]
    Crossing,
    /// A polygon thinner than a millimetre, larger than ten metres, or not a number.
    #[error("the polygon is thinner than 1 mm or larger than 10 m")]
    Size,
    /// A centre of mass outside the outline.
    #[error("the centre of mass does not lie within the outline")]
    Unbalanced,
}

impl ConvexPolygon {
    /// Creates the polygon with these corners (metres, in order, either orientation) about its
    /// centroid, the centre of mass of evenly spread weight.
    ///
    /// # Errors
    /// Returns [`PolygonError`] if they do not form a convex polygon.
    pub fn new(corners: &[Vector]) -> Result<Self, PolygonError> {
        Self::balanced(corners, centroid(corners))
    }

    /// Creates the polygon with these corners about a centre of mass given in their frame, metres.
    ///
    /// # Errors
    /// Returns [`PolygonError`] if they do not form a convex polygon around it.
    pub fn balanced(corners: &[Vector], centre_of_mass: Vector) -> Result<Self, PolygonError> {
        let count = corners.len();
        if !(3..=MAX_CORNERS).contains(&count) {
            return Err(PolygonError::Count(count));
        }
        let mut polygon = Self { corners: [Vector::zeros(); MAX_CORNERS], count };
        for (own, corner) in polygon.corners.iter_mut().zip(corners) {
            *own = corner - centre_of_mass;
        }
        let near = |corner: &Vector| corner.norm() <= LARGEST;
        if !polygon.corners().iter().all(near) {
            return Err(PolygonError::Size);
        }
        // Kept counter-clockwise with the first corner first.
        let clockwise = twice_area(polygon.corners()) < 0.0;
        if clockwise {
            polygon.corners[1..count].reverse();
        }
        polygon.check().map_err(|error| match error {
            PolygonError::Straight(k) if clockwise && k > 0 => PolygonError::Straight(count - k),
            PolygonError::Inwards(k) if clockwise && k > 0 => PolygonError::Inwards(count - k),
            PolygonError::Doubled(k) if clockwise && k > 0 => PolygonError::Doubled(count - k),
            error => error,
        })?;
        Ok(polygon)
    }

    fn check(&self) -> Result<(), PolygonError> {
        let (corners, count) = (self.corners(), self.count);
        for (k, corner) in corners.iter().enumerate() {
            if corners[..k].iter().any(|other| (other - corner).norm() < SMALLEST) {
                return Err(PolygonError::Doubled(k));
            }
        }
        let mut turned = 0.0;
        for k in 0..count {
            let before = corners[k] - corners[(k + count - 1) % count];
            let after = corners[(k + 1) % count] - corners[k];
            let turn = cross(before, after).atan2(before.dot(&after));
            turned += turn;
            if turn.abs() < STRAIGHT {
                return Err(PolygonError::Straight(k));
            }
            if turn < 0.0 {
                return Err(PolygonError::Inwards(k));
            }
        }
        if turned > 1.5 * std::f64::consts::TAU {
            return Err(PolygonError::Crossing);
        }
        if self.faces().any(|(_, normal)| self.extent(normal) + self.extent(-normal) < SMALLEST) {
            return Err(PolygonError::Size);
        }
        if self.inner_radius() < INSIDE {
            return Err(PolygonError::Unbalanced);
        }
        Ok(())
    }

    /// Returns the corners, counter-clockwise, metres from the centre of mass.
    pub fn corners(&self) -> &[Vector] {
        &self.corners[..self.count]
    }

    /// Returns both ends of every side, counter-clockwise.
    pub fn sides(&self) -> impl Iterator<Item = (Vector, Vector)> + '_ {
        let corners = self.corners();
        (0..self.count).map(move |k| (corners[k], corners[(k + 1) % corners.len()]))
    }

    /// Returns the first end of every side and the side's outward unit normal.
    pub fn faces(&self) -> impl Iterator<Item = (Vector, Vector)> + '_ {
        self.sides().map(|(a, b)| (a, Vector::new(b.y - a.y, a.x - b.x).normalize()))
    }

    /// Returns the area, square metres.
    pub fn area(&self) -> f64 {
        twice_area(self.corners()) / 2.0
    }

    /// Returns the means of x^2, x y and y^2 over the area, square metres.
    pub fn second_moments(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (a, b) in self.sides() {
            let area = cross(a, b);
            sums[0] += area * (a.x * a.x + a.x * b.x + b.x * b.x);
            sums[1] += area * (a.x * a.y + 0.5 * (a.x * b.y + b.x * a.y) + b.x * b.y);
            sums[2] += area * (a.y * a.y + a.y * b.y + b.y * b.y);
        }
        sums.map(|sum| sum / (12.0 * self.area()))
    }

    /// Returns the mean distance of the area's points from the origin, metres.
    pub fn mean_radius(&self) -> f64 {
        // The integral of r over the triangle of a side and the origin is h / 3 times the integral
        // of sqrt(h^2 + t^2) along the side. h is the side's distance from the origin.
        let whole: f64 = self
            .sides()
            .map(|(a, b)| {
                let along = (b - a).normalize();
                let (h, from, to) = (cross(a, along), a.dot(&along), b.dot(&along));
                let below = |t: f64| t * h.hypot(t) + h * h * (t / h).asinh();
                h / 3.0 * 0.5 * (below(to) - below(from))
            })
            .sum();
        whole / self.area()
    }

    /// Returns the radius of the smallest circle about the origin that contains the polygon,
    /// metres.
    pub fn bounding_radius(&self) -> f64 {
        self.corners().iter().map(Vector::norm_squared).fold(0.0, f64::max).sqrt()
    }

    /// Returns the radius of the largest circle about the origin inside the polygon, metres;
    /// negative if the origin is outside.
    pub fn inner_radius(&self) -> f64 {
        self.faces().map(|(corner, normal)| corner.dot(&normal)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the extent of the polygon along a unit vector, metres (the support function).
    pub fn extent(&self, direction: Vector) -> f64 {
        let reaches = self.corners().iter().map(|corner| corner.dot(&direction));
        reaches.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the polygon with every side moved outwards by `margin` metres. A negative margin
    /// must not make a side vanish.
    pub fn grown(&self, margin: f64) -> Self {
        let normals: Vec<Vector> = self.faces().map(|(_, normal)| normal).collect();
        let mut grown = *self;
        for (k, corner) in grown.corners[..self.count].iter_mut().enumerate() {
            let (before, after) = (normals[(k + self.count - 1) % self.count], normals[k]);
            *corner += margin / (1.0 + before.dot(&after)) * (before + after);
        }
        grown
    }

    /// Returns the order of rotational symmetry about the origin: n for a regular polygon of n
    /// corners, 1 for most others.
    pub fn symmetry(&self) -> usize {
        let (corners, count) = (self.corners(), self.count);
        let within = ALIKE * self.bounding_radius();
        let looks_alike = |order: &usize| {
            let turn = super::Turn::by(std::f64::consts::TAU / *order as f64);
            (0..count).all(|k| {
                (turn.of(corners[k]) - corners[(k + count / order) % count]).norm() <= within
            })
        };
        (2..=count).rev().filter(|order| count % order == 0).find(looks_alike).unwrap_or(1)
    }
}

impl fmt::Debug for ConvexPolygon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.corners().iter().map(|corner| [corner.x, corner.y])).finish()
    }
}

impl TryFrom<Vec<Vector>> for ConvexPolygon {
    type Error = PolygonError;

    fn try_from(corners: Vec<Vector>) -> Result<Self, PolygonError> {
        Self::balanced(&corners, Vector::zeros())
    }
}

impl From<ConvexPolygon> for Vec<Vector> {
    fn from(polygon: ConvexPolygon) -> Self {
        polygon.corners().to_vec()
    }
}

/// Returns the centroid of a polygon with these corners in order, metres.
pub fn centroid(corners: &[Vector]) -> Vector {
    let Some(&first) = corners.first() else { return Vector::zeros() };
    // Relative to the first corner, so that polygons far from the origin lose no digits.
    let (mut whole, mut moment) = (0.0, Vector::zeros());
    for pair in corners.windows(2) {
        let (a, b) = (pair[0] - first, pair[1] - first);
        whole += cross(a, b);
        moment += cross(a, b) * (a + b);
    }
    if whole == 0.0 { first } else { first + moment / (3.0 * whole) }
}

/// Returns twice the enclosed area, positive for counter-clockwise corners.
fn twice_area(corners: &[Vector]) -> f64 {
    (0..corners.len()).map(|k| cross(corners[k], corners[(k + 1) % corners.len()])).sum()
}

#[cfg(test)]
mod tests;
