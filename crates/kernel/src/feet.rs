//! The support points (feet) of an object.

use crate::Vector;

/// Maximum number of points of a support.
pub const MAX_FEET: usize = 16;

/// Distance from the middle below which the centre of a load counts as the middle, metres:
/// rounding.
const MIDDLE: f64 = 1e-9;

/// Support points of an object with their shares of its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Feet {
    /// Coordinates in the object's frame, metres; entries beyond `count` carry nothing.
    pub x: [f64; MAX_FEET],
    /// See `x`.
    pub y: [f64; MAX_FEET],
    /// Shares of the weight; they add up to one.
    pub load: [f64; MAX_FEET],
    /// Number of points.
    pub count: usize,
    /// Load of all points as a share of the object's weight: one, except for compound objects with
    /// parts above the table.
    pub share: f64,
    /// Centre of the load, metres: the object's centre, except for such compound objects.
    pub centre: Vector,
    /// Whether the points represent an object that is symmetric under every rotation.
    pub round: bool,
    /// Whether the points represent even pressure, so that other points would be equivalent.
    pub even: bool,
    /// Mean distance from the centre, metres: the ratio of the largest friction torque to the
    /// largest friction force.
    pub mean_radius: f64,
    /// Mean square distance from the centre, square metres.
    pub mean_square: f64,
    /// Deviation of the support from a round one, real and imaginary parts.
    ///
    /// The numbers are the sums of load (r / c)^k exp(i k phi) over the points at (r, phi), for k =
    /// 2, 3, 4, with the mean radius c.
    pub harmonics: [Vector; 3],
    /// Inverse of the second moments of the load, xx, xy and yy, 1 / m^2.
    pub(crate) stiffness: [f64; 3],
}

impl Feet {
    /// Returns the support of a solid that carries nothing.
    pub fn none() -> Self {
        Self::of([])
    }

    /// Returns these points with the given share of the object's weight, centred at `centre`.
    pub fn loaded(&self, share: f64, centre: Vector) -> Self {
        if centre.norm() < MIDDLE {
            return Self { share, ..self.clone() };
        }
        let loads = self.leaning(centre);
        let points = || self.each().map(|(at, _)| at).zip(loads);
        let centre = points().map(|(at, load)| load * at).sum();
        Self { share, centre, even: self.even, ..Self::of(points()) }
    }

    /// Returns points with equal loads.
    pub fn equal(points: impl IntoIterator<Item = Vector>) -> Self {
        let points: Vec<Vector> = points.into_iter().collect();
        let load = 1.0 / points.len() as f64;
        Self::of(points.into_iter().map(|point| (point, load)))
    }

    /// Returns points with their shares of the weight; only the first [`MAX_FEET`] are kept.
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
        // Points in a line could not carry a displaced load.
        let whole = xx * yy - xy * xy;
        if whole > 1e-9 * (xx + yy) * (xx + yy) {
            feet.stiffness = [yy / whole, -xy / whole, xx / whole];
        }
        feet
    }

    /// Returns the [`Self::harmonics`] in a frame along a unit vector, with `turn` the cosine and
    /// sine of the object's rotation in that frame.
    pub fn harmonics_turned(&self, turn: Vector) -> [Vector; 3] {
        let mut power = turn;
        self.harmonics.map(|harmonic| {
            power = multiplied(power, turn);
            multiplied(harmonic, power)
        })
    }

    /// Iterates over the points with their shares of the weight.
    pub fn each(&self) -> impl Iterator<Item = (Vector, f64)> + '_ {
        (0..self.count).map(|k| (Vector::new(self.x[k], self.y[k]), self.load[k]))
    }

    /// Returns the relative increase of a point's load per metre that moves the centre of the load
    /// to `lean`. The change is the least possible, as with equal springs.
    #[inline(always)]
    pub(crate) fn slope(&self, lean: Vector) -> Vector {
        let [xx, xy, yy] = self.stiffness;
        Vector::new(xx * lean.x + xy * lean.y, xy * lean.x + yy * lean.y)
    }

    /// Returns the shares of the weight with the centre of the load at `lean`, in the object's
    /// frame. Points cannot pull. If the load of a point would be negative, the other points carry
    /// the whole load, whose centre is then closer to the middle than `lean`.
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

/// Returns the product of two complex numbers.
fn multiplied(a: Vector, b: Vector) -> Vector {
    Vector::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}
