//! The points that an object stands on.

use crate::geometry::{Footprint, Vector};

use super::balance::{balanced, carries};
use super::support::Support;
use super::underside::underside;

/// Most points of a support.
pub const MAX_FEET: usize = 16;

/// Loads whose centre is nearer to the middle than this are about it, metres: rounding.
const MIDDLE: f64 = 1e-9;

/// Points under an object with their shares of its weight, which together stand for a [`Support`].
#[derive(Clone, Debug, PartialEq)]
pub struct Feet {
    /// Coordinates in the object's frame, metres; what is beyond `count` carries nothing.
    pub x: [f64; MAX_FEET],
    /// See `x`.
    pub y: [f64; MAX_FEET],
    /// Shares of the weight; they add up to one.
    pub load: [f64; MAX_FEET],
    /// How many there are.
    pub count: usize,
    /// What they carry together, as a share of the object's weight: one but of things with parts above
    /// the table.
    pub share: f64,
    /// Where the centre of the load is, metres: the object's but of such things.
    pub centre: Vector,
    /// Whether they stand for an object that looks the same at every turn.
    pub round: bool,
    /// Whether they stand for even pressure, so that other points would do as well.
    even: bool,
    /// Mean distance from the centre, metres: the ratio of the largest friction torque to the
    /// largest friction force.
    pub mean_radius: f64,
    /// Mean square distance from the centre, square metres.
    pub mean_square: f64,
    /// Sums of load (r / c)^k exp(i k phi) over the points at (r, phi), for k = 2, 3, 4, c being the
    /// mean radius: how the support differs from a round one, real and imaginary parts.
    pub harmonics: [Vector; 3],
    /// The inverse of the second moments of the load, xx, xy and yy, 1 / m^2.
    stiffness: [f64; 3],
}

impl Feet {
    /// The points that stand for `support` under an object that covers `footprint`.
    ///
    /// Even pressure is that of sixteen points with equal loads: a grid of four by four under a
    /// cuboid, two rings of eight under a cylinder. They have the second moments of the underside,
    /// so friction is exact for slides that hardly turn; the torque of turns on the spot is exact
    /// under cylinders and thin rods, and 0.5 % too small under squares. Under prisms
    /// see `underside`.
    pub fn new(support: &Support, footprint: &Footprint) -> Self {
        let mut feet = match (support, *footprint) {
            (Support::Points(points), _) => Self::on(points),
            (Support::Even, Footprint::Disc { radius }) => {
                // Radii r with mean 2 R / 3 and mean square R^2 / 2.
                let off = (0.5f64 - 4.0 / 9.0).sqrt();
                let rings = [(2.0 / 3.0 - off, 0.0), (2.0 / 3.0 + off, 0.5)];
                Self::equal(rings.into_iter().flat_map(|(r, turn)| ring(r * radius, turn)))
            }
            (Support::Even, Footprint::Rectangle { half }) => {
                // The Gauss-Legendre rule on either half of a side: mean h / 2, square h^2 / 3.
                let off = (1.0f64 / 3.0 - 0.25).sqrt();
                let places = [-0.5 - off, -0.5 + off, 0.5 - off, 0.5 + off];
                Self::equal(places.into_iter().flat_map(|u| {
                    places.into_iter().map(move |v| Vector::new(u * half.x, v * half.y))
                }))
            }
            (Support::Even, Footprint::Polygon(polygon)) => {
                let (points, even) = underside(&polygon);
                // Even pressure carries no centre of mass that is not the centroid.
                let loads = balanced(&points, &even).unwrap_or(even);
                Self::of(points.into_iter().zip(loads))
            }
            (Support::Corners, footprint) => Self::corners(&footprint, 1.0),
            (Support::Spread(share), footprint) => Self::corners(&footprint, *share),
        };
        let stated = matches!(support, Support::Points(_));
        feet.round = !stated && matches!(footprint, Footprint::Disc { .. });
        if feet.round {
            feet.harmonics = [Vector::zeros(); 3];
        }
        feet.even = matches!(support, Support::Even);
        feet
    }

    /// In place of even pressure fewer points with the same first and second moments, for engines
    /// in which all of them are contacts of a body that can tip: there it is left to chance how its
    /// weight spreads over many contacts, and each costs time. Eight under a cylinder, four under
    /// anything else. Points that are stated stay.
    pub fn few(&self, footprint: &Footprint) -> Self {
        if !self.even {
            return self.clone();
        }
        let mut feet = match *footprint {
            Footprint::Disc { .. } => Self::equal(ring(self.mean_square.sqrt(), 0.0)),
            Footprint::Rectangle { .. } | Footprint::Polygon(_) => {
                // On the principal axes of the second moments, which have these means and spread.
                let sum = |value: &dyn Fn(Vector) -> f64| -> f64 {
                    self.each().map(|(at, load)| load * value(at)).sum()
                };
                let half = 0.5 * sum(&|at| at.x * at.x - at.y * at.y);
                let across = sum(&|at| at.x * at.y);
                let (mean, spread) = (0.5 * self.mean_square, half.hypot(across));
                let (sin, cos) = (0.5 * across.atan2(half)).sin_cos();
                let a = (mean + spread).sqrt() * Vector::new(cos, sin);
                let b = (mean - spread).max(0.0).sqrt() * Vector::new(-sin, cos);
                Self::equal([a + b, b - a, -a - b, a - b])
            }
        };
        (feet.round, feet.even) = (self.round, true);
        feet
    }

    /// [`Self::few`] of a solid that carries this `share` of what an equal one beside it would: engines
    /// in which the points of one body are contacts load them all alike, so light solids stand on fewer,
    /// one in their middle or two on their long axis.
    pub fn fewer(&self, footprint: &Footprint, share: f64) -> Self {
        let few = self.few(footprint);
        let count = share * few.count as f64;
        if !self.even || count >= 3.0 {
            return few;
        }
        let mut feet = match count < 1.5 {
            true => Self::equal([Vector::zeros()]),
            false => {
                // Neighbours are the ends of a side; the middles of the shorter sides are as far apart
                // as the points of the whole are spread.
                let middle = |k: usize| {
                    let next = (k + 1) % few.count;
                    0.5 * Vector::new(few.x[k] + few.x[next], few.y[k] + few.y[next])
                };
                let farther = |a: Vector, b: Vector| if a.norm() >= b.norm() { a } else { b };
                let end = (0..few.count).map(middle).fold(Vector::zeros(), farther);
                Self::equal([end, -end])
            }
        };
        (feet.round, feet.even) = (false, true);
        feet
    }

    /// The points of a solid that carries nothing.
    pub fn none() -> Self {
        Self::of([])
    }

    /// The same points where they carry this share of the object's weight, with its centre there.
    pub(super) fn loaded(&self, share: f64, centre: Vector) -> Self {
        if centre.norm() < MIDDLE {
            return Self { share, ..self.clone() };
        }
        let loads = self.leaning(centre);
        let points = || self.each().map(|(at, _)| at).zip(loads);
        let centre = points().map(|(at, load)| load * at).sum();
        Self { share, centre, even: self.even, ..Self::of(points()) }
    }

    /// These points with loads that leave the centre of mass where it is, as equal as can be; see
    /// [`carries`].
    fn on(points: &[Vector]) -> Self {
        let loads =
            carries(points).unwrap_or_else(|| vec![1.0 / points.len() as f64; points.len()]);
        Self::of(points.iter().copied().zip(loads))
    }

    fn corners(footprint: &Footprint, share: f64) -> Self {
        match *footprint {
            Footprint::Disc { radius } => Self::equal(ring(share * radius, 0.0)),
            Footprint::Rectangle { half } => {
                let (x, y) = (share * half.x, share * half.y);
                Self::equal([(x, y), (-x, y), (-x, -y), (x, -y)].map(|(x, y)| Vector::new(x, y)))
            }
            Footprint::Polygon(polygon) => {
                let corners = polygon.corners().iter();
                Self::on(&corners.map(|corner| share * corner).collect::<Vec<_>>())
            }
        }
    }

    fn equal(points: impl IntoIterator<Item = Vector>) -> Self {
        let points: Vec<Vector> = points.into_iter().collect();
        let load = 1.0 / points.len() as f64;
        Self::of(points.into_iter().map(|point| (point, load)))
    }

    fn of(points: impl IntoIterator<Item = (Vector, f64)>) -> Self {
        let none = [0.0; MAX_FEET];
        let mut feet = Self {
            x: none,
            y: none,
            load: none,
            count: 0,
            share: 1.0,
            centre: Vector::zeros(),
            round: false,
            even: false,
            mean_radius: 0.0,
            mean_square: 0.0,
            harmonics: [Vector::zeros(); 3],
            stiffness: [0.0; 3],
        };
        let [mut xx, mut xy, mut yy] = [0.0; 3];
        for (point, load) in points.into_iter().take(MAX_FEET) {
            let k = feet.count;
            (feet.x[k], feet.y[k], feet.load[k]) = (point.x, point.y, load);
            feet.count += 1;
            feet.mean_radius += load * point.norm();
            feet.mean_square += load * point.norm_squared();
            xx += load * point.x * point.x;
            xy += load * point.x * point.y;
            yy += load * point.y * point.y;
        }
        for k in 0..feet.count {
            let point = Vector::new(feet.x[k], feet.y[k]) / feet.mean_radius;
            let mut power = point;
            for harmonic in &mut feet.harmonics {
                power = multiplied(power, point);
                *harmonic += feet.load[k] * power;
            }
        }
        // Nothing leans on points in a line, which could not carry it.
        let whole = xx * yy - xy * xy;
        if whole > 1e-9 * (xx + yy) * (xx + yy) {
            feet.stiffness = [yy / whole, -xy / whole, xx / whole];
        }
        feet
    }

    /// The [`Self::harmonics`] as seen along a unit vector to which the object's own x axis is
    /// turned by an angle of these cosine and sine.
    pub fn harmonics_turned(&self, turn: Vector) -> [Vector; 3] {
        let mut power = turn;
        self.harmonics.map(|harmonic| {
            power = multiplied(power, turn);
            multiplied(harmonic, power)
        })
    }

    /// Every point with its share of the weight.
    pub fn each(&self) -> impl Iterator<Item = (Vector, f64)> + '_ {
        (0..self.count).map(|k| (Vector::new(self.x[k], self.y[k]), self.load[k]))
    }

    /// How much more of its load than at the centre a point carries per metre, so that the centre
    /// of the load lies at `lean`: the least change that does it (even springs).
    #[inline(always)]
    pub(super) fn slope(&self, lean: Vector) -> Vector {
        let [xx, xy, yy] = self.stiffness;
        Vector::new(xx * lean.x + xy * lean.y, xy * lean.x + yy * lean.y)
    }

    /// Shares of the weight when the centre of the load lies at `lean`, in the object's frame.
    /// Points do not pull: where some would have to, the others carry all, with the centre a little
    /// less far off.
    pub fn leaning(&self, lean: Vector) -> [f64; MAX_FEET] {
        let slope = self.slope(lean);
        let mut load = self.load;
        for (k, load) in load.iter_mut().enumerate() {
            *load *= (1.0 + slope.x * self.x[k] + slope.y * self.y[k]).max(0.0);
        }
        let whole: f64 = load.iter().sum();
        load.map(|load| load / whole)
    }
}

/// The product of two complex numbers.
fn multiplied(a: Vector, b: Vector) -> Vector {
    Vector::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// Eight points on a circle, the first one turned by `turn` of the angle between two.
fn ring(radius: f64, turn: f64) -> impl Iterator<Item = Vector> {
    (0..8).map(move |k| {
        let (y, x) = (std::f64::consts::FRAC_PI_4 * (f64::from(k) + turn)).sin_cos();
        radius * Vector::new(x, y)
    })
}

#[cfg(test)]
mod tests;
