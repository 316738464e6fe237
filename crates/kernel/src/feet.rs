//! The points that an object stands on.

use crate::Vector;

/// Maximum number of points of a support.
pub const MAX_FEET: usize = 16;

/// Loads whose centre is nearer to the middle than this are about it, metres: rounding.
const MIDDLE: f64 = 1e-9;

/// Points under an object with their shares of its weight, which together stand for its support.
#[derive(Clone, Debug, PartialEq)]
pub struct Feet {
    /// Coordinates in the object's frame, metres; what is beyond `count` carries nothing.
    pub x: [f64; MAX_FEET],
    /// See `x`.
    pub y: [f64; MAX_FEET],
    /// Shares of the weight; they add up to one.
    pub load: [f64; MAX_FEET],
    /// Number of points.
    pub count: usize,
    /// What they carry together, as a share of the object's weight: one but of things with parts above
    /// the table.
    pub share: f64,
    /// Where the centre of the load is, metres: the object's but of such things.
    pub centre: Vector,
    /// `true` if they stand for an object that looks the same at every turn.
    pub round: bool,
    /// `true` if they stand for even pressure, so that other points would do as well.
    pub even: bool,
    /// Mean distance from the centre, metres: the ratio of the largest friction torque to the
    /// largest friction force.
    pub mean_radius: f64,
    /// Mean square distance from the centre, square metres.
    pub mean_square: f64,
    /// Sums of load (r / c)^k exp(i k phi) over the points at (r, phi), for k = 2, 3, 4, c being the
    /// mean radius: how the support differs from a round one, real and imaginary parts.
    pub harmonics: [Vector; 3],
    /// The inverse of the second moments of the load, xx, xy and yy, 1 / m^2.
    pub(crate) stiffness: [f64; 3],
}

impl Feet {
    /// The points of a solid that carries nothing.
    pub fn none() -> Self {
        Self::of([])
    }

    /// Returns these points where they carry this share of the object's weight, with its centre there.
    pub fn loaded(&self, share: f64, centre: Vector) -> Self {
        if centre.norm() < MIDDLE {
            return Self { share, ..self.clone() };
        }
        let loads = self.leaning(centre);
        let points = || self.each().map(|(at, _)| at).zip(loads);
        let centre = points().map(|(at, load)| load * at).sum();
        Self { share, centre, even: self.even, ..Self::of(points()) }
    }

    /// Points with equal loads.
    pub fn equal(points: impl IntoIterator<Item = Vector>) -> Self {
        let points: Vec<Vector> = points.into_iter().collect();
        let load = 1.0 / points.len() as f64;
        Self::of(points.into_iter().map(|point| (point, load)))
    }

    /// Points with their shares of the weight; at most [`MAX_FEET`] of them count.
    pub fn of(points: impl IntoIterator<Item = (Vector, f64)>) -> Self {
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
    pub(crate) fn slope(&self, lean: Vector) -> Vector {
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
