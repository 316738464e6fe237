//! What an object stands on.

use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use crate::geometry::{ConvexPolygon, Footprint, Vector, cross};

/// How an object's weight is spread over its underside, as a task states it.
///
/// Friction resists turning the more, the farther out the weight rests: a box on its corners turns
/// half as far as one on even pressure. What is true of an object can be fitted to recorded pushes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    /// Even pressure over the whole underside.
    #[default]
    Even,
    /// The corners of a cuboid or prism; the rim of a cylinder.
    Corners,
    /// Like `Corners`, but at this share of their distance from the centre.
    Spread(f64),
    /// These points, in the object's frame, metres.
    Points(Vec<Vector>),
}

/// Most points of a support.
pub const MAX_FEET: usize = 16;

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
    /// Whether they stand for something that looks the same at every turn.
    pub round: bool,
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
    /// under cylinders and thin rods, and 0.5 % too small under squares. Under prisms see
    /// [`Self::under`].
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
            (Support::Even, Footprint::Polygon(polygon)) => Self::under(&polygon),
            (Support::Corners, footprint) => Self::corners(&footprint, 1.0),
            (Support::Spread(share), footprint) => Self::corners(&footprint, *share),
        };
        let stated = matches!(support, Support::Points(_));
        feet.round = !stated && matches!(footprint, Footprint::Disc { .. });
        if feet.round {
            feet.harmonics = [Vector::zeros(); 3];
        }
        feet
    }

    /// Fewer points with the same first and second moments, for engines in which all of them are
    /// contacts of a body that tips: how it spreads its weight over many is left to chance there,
    /// and each costs time. Eight under a cylinder, four under anything else.
    pub fn few(&self, footprint: &Footprint) -> Self {
        if self.count < MAX_FEET {
            return self.clone();
        }
        let mut feet = match *footprint {
            Footprint::Disc { .. } => Self::equal(ring(self.mean_square.sqrt(), 0.0)),
            Footprint::Rectangle { .. } | Footprint::Polygon(_) => {
                let second = self.each().map(|(at, load)| load * at * at.transpose());
                let axes = second.sum::<Matrix2<f64>>().symmetric_eigen();
                let along = |k: usize| {
                    axes.eigenvalues[k].max(0.0).sqrt() * axes.eigenvectors.column(k).into_owned()
                };
                let (a, b) = (along(0), along(1));
                Self::equal([a + b, b - a, -a - b, a - b])
            }
        };
        feet.round = self.round;
        feet
    }

    /// These points with loads that leave the centre of mass where it is, as equal as can be; see
    /// [`carries`].
    fn on(points: &[Vector]) -> Self {
        let loads =
            carries(points).unwrap_or_else(|| vec![1.0 / points.len() as f64; points.len()]);
        Self::of(points.iter().copied().zip(loads))
    }

    /// Even pressure under a polygon: two or four points in each triangle of a side and the centre
    /// of mass, with loads that have the second moments of the triangle.
    ///
    /// With three or four corners, at two places along a side and two depths, which make the torque
    /// of turns on the spot exact, too. With more corners, at the middles of the triangle's sides
    /// (the neighbour's being the same); that torque is then 1 to 4 % too large. Where the centre
    /// of mass is not the centroid even pressure cannot carry it: the loads are then those nearest
    /// to even ones that do, see [`carries`].
    fn under(polygon: &ConvexPolygon) -> Self {
        let whole = 2.0 * polygon.area();
        let sides = || polygon.sides().map(|(a, b)| (a, b, cross(a, b) / whole));
        let mut points = Vec::with_capacity(MAX_FEET);
        let mut loads = Vec::with_capacity(MAX_FEET);
        if polygon.corners().len() <= 4 {
            // Gauss-Legendre along the side.
            let places: Vec<(Vector, f64)> = sides()
                .flat_map(|(a, b, share)| {
                    let (middle, off) = ((a + b) / 2.0, (b - a) / 12f64.sqrt());
                    [(middle - off, share / 2.0), (middle + off, share / 2.0)]
                })
                .collect();
            // Depths with mean square 1/2 and the mean that gives the mean radius.
            let outside: f64 = places.iter().map(|(place, load)| load * place.norm()).sum();
            let mean = polygon.mean_radius() / outside;
            let off = (0.5 - mean * mean).max(0.0).sqrt();
            for depth in [mean - off, mean + off] {
                points.extend(places.iter().map(|(place, _)| depth * place));
                loads.extend(places.iter().map(|(_, load)| load / 2.0));
            }
        } else {
            let before = sides().last().map_or(0.0, |(_, _, share)| share);
            let mut before = before;
            for (a, b, share) in sides() {
                points.extend([a / 2.0, (a + b) / 2.0]);
                loads.extend([(before + share) / 3.0, share / 3.0]);
                before = share;
            }
        }
        let loads = balanced(&points, &loads).unwrap_or(loads);
        Self::of(points.into_iter().zip(loads))
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
            round: false,
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

    /// What resists a planar motion of the object, whose own x axis points along the unit vector
    /// `axis`, when every point drags with its load along its own motion, and those slower than
    /// `least` as if they were so fast. With d the motion of a point, the weight of its place is
    /// load / max(|d|, `least`). The object leans: the centre of its load lies `lean` metres aside.
    pub fn drag(
        &self,
        axis: Vector,
        (linear, angular): (Vector, f64),
        least: f64,
        lean: Vector,
    ) -> Drag {
        let speed = linear.norm();
        // The points of what is round stand for all of its turns, so they turn with the motion.
        let (cos, sin) = match self.round {
            true if speed > 0.0 => (linear.x / speed, linear.y / speed),
            true => (1.0, 0.0),
            false => (axis.x, axis.y),
        };
        let local = |v: Vector| Vector::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x);
        let mut drag = self.drag_along(local(linear), angular, least, self.slope(local(lean)));
        let Drag { first, .. } = drag;
        drag.first = Vector::new(cos * first.x - sin * first.y, sin * first.x + cos * first.y);
        drag
    }

    /// How much more of its load than at the centre a point carries per metre, so that the centre
    /// of the load lies at `lean`: the least change that does it (even springs).
    fn slope(&self, lean: Vector) -> Vector {
        let [xx, xy, yy] = self.stiffness;
        Vector::new(xx * lean.x + xy * lean.y, xy * lean.x + yy * lean.y)
    }

    /// Shares of the weight when the centre of the load lies at `lean`, in the object's frame.
    /// Points do not pull: where some would have to, the rest carries all, a little less far aside.
    pub fn leaning(&self, lean: Vector) -> [f64; MAX_FEET] {
        let slope = self.slope(lean);
        let mut load = self.load;
        for (k, load) in load.iter_mut().enumerate() {
            *load *= (1.0 + slope.x * self.x[k] + slope.y * self.y[k]).max(0.0);
        }
        let whole: f64 = load.iter().sum();
        load.map(|load| load / whole)
    }

    /// [`Self::drag`] in the points' own frame.
    #[inline]
    fn drag_along(&self, linear: Vector, angular: f64, least: f64, slope: Vector) -> Drag {
        // Whole blocks and a sum for each place in them, so that the compiler makes vectors of
        // them; spare points carry nothing.
        let mut sums = [[0.0; BLOCK]; 5];
        for block in 0..self.count.div_ceil(BLOCK) {
            let range = block * BLOCK..(block + 1) * BLOCK;
            let (x, y) = (&self.x[range.clone()], &self.y[range.clone()]);
            let load = &self.load[range];
            for k in 0..BLOCK {
                let (u, v) = (linear.x - angular * y[k], linear.y + angular * x[k]);
                let load = load[k] * (1.0 + slope.x * x[k] + slope.y * y[k]).max(0.0);
                let weight = load / (u * u + v * v).sqrt().max(least);
                sums[0][k] += weight;
                sums[1][k] += weight * x[k];
                sums[2][k] += weight * y[k];
                sums[3][k] += weight * (x[k] * x[k] + y[k] * y[k]);
                sums[4][k] += load;
            }
        }
        let [sum, x, y, second, whole] = sums.map(|places| places.iter().sum::<f64>());
        let scale = 1.0 / whole;
        Drag { sum: scale * sum, first: scale * Vector::new(x, y), second: scale * second }
    }

    /// The same where every point moves by `moved`.
    pub fn even_drag(&self, moved: f64) -> Drag {
        let first = Vector::zeros();
        Drag { sum: 1.0 / moved, first, second: self.mean_square / moved }
    }
}

/// Points that the compiler treats together.
const BLOCK: usize = 4;

/// Moments of the weights of points that drag, see [`Feet::drag`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Drag {
    /// Sum of the weights.
    pub sum: f64,
    /// Sum of weight times place against the centre, in world axes.
    pub first: Vector,
    /// Sum of weight times squared distance from the centre.
    pub second: f64,
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

/// Shares of the weight that points carry, so that together they carry it at the origin: those
/// nearest to equal shares, as even springs would have them. `None` where they cannot, because the
/// origin lies outside of them.
pub fn carries(points: &[Vector]) -> Option<Vec<f64>> {
    balanced(points, &vec![1.0; points.len()])
}

/// The same for points whose shares would be as these `weights` if the origin were in their middle.
fn balanced(points: &[Vector], weights: &[f64]) -> Option<Vec<f64>> {
    let mut used = vec![true; points.len()];
    loop {
        if !used.contains(&true) {
            return None;
        }
        // Loads w (a + b . point) of sum one and without moment: three equations, by Cramer's rule.
        let among = || (0..points.len()).filter(|&k| used[k]).map(|k| (points[k], weights[k]));
        let n: f64 = among().map(|(_, weight)| weight).sum();
        let sum: Vector = among().map(|(point, weight)| weight * point).sum();
        let xx: f64 = among().map(|(point, weight)| weight * point.x * point.x).sum();
        let xy: f64 = among().map(|(point, weight)| weight * point.x * point.y).sum();
        let yy: f64 = among().map(|(point, weight)| weight * point.y * point.y).sum();
        let a = xx * yy - xy * xy;
        let b = Vector::new(sum.y * xy - sum.x * yy, sum.x * xy - sum.y * xx);
        let whole = n * a + sum.dot(&b);
        // On one line they carry nothing: it would tip.
        if whole <= 1e-9 * n * (xx + yy) * (xx + yy) {
            return None;
        }
        let load = |k: usize| weights[k] * (a + b.dot(&points[k])) / whole;
        let lowest = (0..points.len()).filter(|&k| used[k]).map(|k| (k, load(k)));
        let lowest = lowest.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if lowest.1 < -1e-9 {
            used[lowest.0] = false;
            continue;
        }
        let loads: Vec<f64> =
            (0..points.len()).map(|k| if used[k] { load(k).max(0.0) } else { 0.0 }).collect();
        let moment: Vector = points.iter().zip(&loads).map(|(point, load)| *load * point).sum();
        let sum: f64 = loads.iter().sum();
        return (moment.norm() < 1e-6 && (sum - 1.0).abs() < 1e-6).then_some(loads);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Footprint; 3] = [
        Footprint::Disc { radius: 0.05 },
        Footprint::Rectangle { half: Vector::new(0.04, 0.04) },
        Footprint::Rectangle { half: Vector::new(0.08, 0.02) },
    ];

    #[test]
    fn even_feet_have_the_moments_of_even_pressure() {
        for shape in SHAPES {
            let feet = Feet::new(&Support::Even, &shape);
            assert!((feet.load.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let centre: Vector = feet.each().map(|(at, load)| load * at).sum();
            assert!(centre.norm() < 1e-15);
            let (mean, square) = (feet.mean_radius, feet.mean_square);
            assert!((square / shape.gyration_radius().powi(2) - 1.0).abs() < 1e-9, "{shape:?}");
            assert!((mean / shape.mean_radius() - 1.0).abs() < 0.006, "{shape:?} {mean}");
        }
    }

    #[test]
    fn what_leans_has_the_centre_of_its_load_there() {
        for shape in SHAPES {
            for support in [Support::Even, Support::Corners] {
                let feet = Feet::new(&support, &shape);
                let lean = Vector::new(0.004, -0.002);
                let loads = feet.leaning(lean);
                let centre: Vector = feet.each().zip(loads).map(|((at, _), load)| load * at).sum();
                assert!((centre - lean).norm() < 1e-12, "{shape:?} {support:?}: {centre}");
                // So slow that all points weigh alike, what is left is the load's first moment.
                let motion = (Vector::new(0.1, 0.03), 0.4);
                let drag = feet.drag(Vector::x(), motion, 1.0, lean);
                assert!((drag.first - lean).norm() < 1e-12, "{shape:?} {support:?}: {drag:?}");
            }
        }
    }

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
            let feet = Feet::new(&Support::Even, &Footprint::Polygon(shape));
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
            // They lie under the object.
            for (at, _) in feet.each() {
                let mut faces = shape.faces();
                assert!(faces.all(|(corner, normal)| normal.dot(&(at - corner)) < 1e-12));
            }
        }
    }

    #[test]
    fn fewer_feet_have_the_same_second_moments() {
        for shape in SHAPES {
            let feet = Feet::new(&Support::Even, &shape);
            let few = feet.few(&shape);
            assert!(few.count <= 8 && few.round == feet.round);
            for (a, b) in few.stiffness.iter().zip(&feet.stiffness) {
                assert!((a - b).abs() < 1e-9 * feet.stiffness[0], "{shape:?}");
            }
        }
    }

    #[test]
    fn harmonics_turn_with_the_object() {
        let points = [(0.03, 0.0), (-0.02, 0.02), (-0.02, -0.04)].map(|(x, y)| Vector::new(x, y));
        let (sin, cos) = 0.7f64.sin_cos();
        let turned = points.map(|p| Vector::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y));
        let [feet, other] =
            [points, turned].map(|points| Feet::new(&Support::Points(points.to_vec()), &SHAPES[0]));
        let found = feet.harmonics_turned(Vector::new(cos, sin));
        for (a, b) in found.iter().zip(other.harmonics) {
            assert!((a - b).norm() < 1e-12 && b.norm() > 0.01, "{a} {b}");
        }
        // A square's corners differ from a circle in the fourth harmonic alone.
        let square = Feet::new(&Support::Corners, &SHAPES[1]).harmonics;
        assert!(square[0].norm() < 1e-12 && square[1].norm() < 1e-12);
        assert!((square[2] + Vector::x()).norm() < 1e-12);
    }

    #[test]
    fn a_square_stands_alike_however_it_is_written() {
        let half = Vector::new(0.04, 0.04);
        let square = polygon(&[[0.0, 0.0], [0.08, 0.0], [0.08, 0.08], [0.0, 0.08]]);
        for (support, off) in [(Support::Even, 0.006), (Support::Spread(0.7), 1e-12)] {
            let own = Feet::new(&support, &Footprint::Polygon(square));
            let other = Feet::new(&support, &Footprint::Rectangle { half });
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
                let feet = Feet::new(&support, &footprint);
                let sum: f64 = feet.load.iter().sum();
                let moment: Vector = feet.each().map(|(at, load)| load * at).sum();
                assert!((sum - 1.0).abs() < 1e-9 && moment.norm() < 1e-9, "{centre:?} {support:?}");
                assert!(feet.load.iter().all(|load| *load >= 0.0));
            }
        }
    }

    /// Turning little while it slides, a disc under even pressure resists with a quarter of R^2.
    #[test]
    fn a_slide_that_hardly_turns_feels_the_second_moment_along_it() {
        for shape in SHAPES {
            let feet = Feet::new(&Support::Even, &shape);
            let second = match shape {
                Footprint::Disc { radius } => radius * radius / 4.0,
                Footprint::Rectangle { half } => half.x * half.x / 3.0,
                Footprint::Polygon(polygon) => polygon.second_moments()[0],
            };
            let (speed, turning) = (0.1, 1e-4);
            let drag =
                feet.drag(Vector::x(), (Vector::new(speed, 0.0), turning), 1e-9, Vector::zeros());
            // Torque: the slide pulls at the points' first moment, the turn at their second.
            let torque = -drag.first.y * speed + drag.second * turning;
            assert!((torque / (second * turning / speed) - 1.0).abs() < 1e-3, "{shape:?}");
        }
    }

    #[test]
    fn three_points_carry_what_lies_between_them_and_nothing_else() {
        let points = [(0.03, 0.0), (-0.02, 0.02), (-0.02, -0.04)].map(|(x, y)| Vector::new(x, y));
        let loads = carries(&points).expect("the origin is inside");
        let centre: Vector = points.iter().zip(&loads).map(|(at, load)| *load * at).sum();
        assert!(centre.norm() < 1e-12 && loads.iter().all(|load| *load > 0.0), "{loads:?}");
        let aside = points.map(|point| point + Vector::new(0.1, 0.0));
        assert_eq!(carries(&aside), None);
    }

    #[test]
    fn points_share_the_weight_as_equally_as_they_can() {
        let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let square = square.map(|(x, y)| Vector::new(x, y));
        let loads = carries(&square).expect("inside");
        assert!(loads.iter().all(|load| (load - 0.25).abs() < 1e-12));
        // Far out on one side, one point more carries less.
        let lopsided = [&square[..], &[Vector::new(8.0, 0.0)]].concat();
        let loads = carries(&lopsided).expect("inside");
        assert!(loads[4] < loads[0] && loads[0] < loads[1], "{loads:?}");
    }
}
