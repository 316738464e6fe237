//! The points that an object stands on, from its support and outline.

use pushplan_kernel::Feet;

use crate::geometry::{Footprint, Vector};

use super::balance::{balanced, carries};
use super::support::Support;
use super::underside::underside;

impl Support {
    /// Returns the points that represent this support under an object that covers `footprint`.
    ///
    /// Sixteen points with equal loads represent even pressure: a grid of four by four under a
    /// cuboid, two rings of eight under a cylinder. They have the second moments of the underside,
    /// so friction is exact for slides with little rotation. The torque of rotations on the spot is
    /// exact under cylinders and thin rods, and 0.5 % too small under squares. For prisms see
    /// `underside`.
    pub fn feet(&self, footprint: &Footprint) -> Feet {
        let mut feet = match (self, *footprint) {
            (Self::Points(points), _) => on(points),
            (Self::Even, Footprint::Disc { radius }) => {
                // Radii r with mean 2 R / 3 and mean square R^2 / 2.
                let off = (0.5f64 - 4.0 / 9.0).sqrt();
                let rings = [(2.0 / 3.0 - off, 0.0), (2.0 / 3.0 + off, 0.5)];
                Feet::equal(rings.into_iter().flat_map(|(r, turn)| ring(r * radius, turn)))
            }
            (Self::Even, Footprint::Rectangle { half }) => {
                // The Gauss-Legendre rule on either half of a side: mean h / 2, square h^2 / 3.
                let off = (1.0f64 / 3.0 - 0.25).sqrt();
                let places = [-0.5 - off, -0.5 + off, 0.5 - off, 0.5 + off];
                Feet::equal(places.into_iter().flat_map(|u| {
                    places.into_iter().map(move |v| Vector::new(u * half.x, v * half.y))
                }))
            }
            (Self::Even, Footprint::Polygon(polygon)) => {
                let (points, even) = underside(&polygon);
                // Even pressure can only carry a centre of mass at the centroid.
                let loads = balanced(&points, &even).unwrap_or(even);
                Feet::of(points.into_iter().zip(loads))
            }
            (Self::Corners, footprint) => corners(&footprint, 1.0),
            (Self::Spread(share), footprint) => corners(&footprint, *share),
        };
        let stated = matches!(self, Self::Points(_));
        feet.round = !stated && matches!(footprint, Footprint::Disc { .. });
        if feet.round {
            feet.harmonics = [Vector::zeros(); 3];
        }
        feet.even = matches!(self, Self::Even);
        feet
    }
}

/// Replaces even pressure by fewer points with the same first and second moments: eight under a
/// cylinder, four otherwise. Stated points stay.
///
/// Fewer points serve engines in which every point is a contact of a body that can tip. There the
/// distribution of weight over many contacts is arbitrary, and each contact costs time.
pub fn few(feet: &Feet, footprint: &Footprint) -> Feet {
    if !feet.even {
        return feet.clone();
    }
    let mut made = match *footprint {
        Footprint::Disc { .. } => Feet::equal(ring(feet.mean_square.sqrt(), 0.0)),
        Footprint::Rectangle { .. } | Footprint::Polygon(_) => {
            // On the principal axes of the second moments, which have this mean and this spread.
            let sum = |value: &dyn Fn(Vector) -> f64| -> f64 {
                feet.each().map(|(at, load)| load * value(at)).sum()
            };
            let half = 0.5 * sum(&|at| at.x * at.x - at.y * at.y);
            let across = sum(&|at| at.x * at.y);
            let (mean, spread) = (0.5 * feet.mean_square, half.hypot(across));
            let (sin, cos) = (0.5 * across.atan2(half)).sin_cos();
            let a = (mean + spread).sqrt() * Vector::new(cos, sin);
            let b = (mean - spread).max(0.0).sqrt() * Vector::new(-sin, cos);
            Feet::equal([a + b, b - a, -a - b, a - b])
        }
    };
    (made.round, made.even) = (feet.round, true);
    made
}

/// Reduces [`few`] points further for a solid that carries this `share` of the load of an equal
/// solid beside it. Light solids stand on one point in their middle or on two points on their long
/// axis, because some engines load all contacts of a body alike.
pub fn fewer(feet: &Feet, footprint: &Footprint, share: f64) -> Feet {
    let few = few(feet, footprint);
    let count = share * few.count as f64;
    if !feet.even || count >= 3.0 {
        return few;
    }
    let mut made = match count < 1.5 {
        true => Feet::equal([Vector::zeros()]),
        false => {
            // Neighbouring points are the ends of a side; the middles of the shorter sides are as
            // far apart as the spread of all points.
            let middle = |k: usize| {
                let next = (k + 1) % few.count;
                0.5 * Vector::new(few.x[k] + few.x[next], few.y[k] + few.y[next])
            };
            let farther = |a: Vector, b: Vector| if a.norm() >= b.norm() { a } else { b };
            let end = (0..few.count).map(middle).fold(Vector::zeros(), farther);
            Feet::equal([end, -end])
        }
    };
    (made.round, made.even) = (false, true);
    made
}

/// Returns these points with loads that keep the centre of mass, as equal as possible; see
/// [`carries`].
fn on(points: &[Vector]) -> Feet {
    let loads = carries(points).unwrap_or_else(|| vec![1.0 / points.len() as f64; points.len()]);
    Feet::of(points.iter().copied().zip(loads))
}

fn corners(footprint: &Footprint, share: f64) -> Feet {
    match *footprint {
        Footprint::Disc { radius } => Feet::equal(ring(share * radius, 0.0)),
        Footprint::Rectangle { half } => {
            let (x, y) = (share * half.x, share * half.y);
            Feet::equal([(x, y), (-x, y), (-x, -y), (x, -y)].map(|(x, y)| Vector::new(x, y)))
        }
        Footprint::Polygon(polygon) => {
            let corners = polygon.corners().iter();
            on(&corners.map(|corner| share * corner).collect::<Vec<_>>())
        }
    }
}

/// Returns eight points on a circle; the first one is rotated by `turn` times the angle between
/// two.
fn ring(radius: f64, turn: f64) -> impl Iterator<Item = Vector> {
    (0..8).map(move |k| {
        let (y, x) = (std::f64::consts::FRAC_PI_4 * (f64::from(k) + turn)).sin_cos();
        radius * Vector::new(x, y)
    })
}

#[cfg(test)]
mod tests;
