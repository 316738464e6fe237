//! How the points that an object stands on drag when it moves.

use std::sync::OnceLock;

use pulp::{Arch, Simd, WithSimd};

use crate::geometry::Vector;

use super::feet::{Feet, MAX_FEET};

/// Points that are summed side by side. All sums are taken in this order whatever the processor,
/// so that their bits are the same.
const LANES: usize = 8;

/// The widest vectors of this processor.
static ARCH: OnceLock<Arch> = OnceLock::new();

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

impl Feet {
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

    /// The same where every point moves by `moved`.
    pub fn even_drag(&self, moved: f64) -> Drag {
        let first = Vector::zeros();
        Drag { sum: 1.0 / moved, first, second: self.mean_square / moved }
    }

    /// [`Self::drag`] in the points' own frame.
    fn drag_along(&self, linear: Vector, angular: f64, least: f64, slope: Vector) -> Drag {
        let moving = Moving { feet: self, linear, angular, least, slope };
        ARCH.get_or_init(Arch::new).dispatch(moving)
    }
}

/// Points that move, in their own frame: see [`Feet::drag`].
struct Moving<'a> {
    feet: &'a Feet,
    linear: Vector,
    angular: f64,
    least: f64,
    /// How much more of its load than at the centre a point carries per metre.
    slope: Vector,
}

impl WithSimd for Moving<'_> {
    type Output = Drag;

    /// Plain loops over lanes, of which the compiler makes the vectors that the processor has;
    /// spare points carry nothing.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Drag {
        let Self { feet, linear, angular, least, slope } = self;
        let mut sums = [[0.0; LANES]; 5];
        for block in 0..feet.count.div_ceil(LANES).min(MAX_FEET / LANES) {
            let mut lanes = [[0.0; LANES]; 3];
            for (lanes, of) in lanes.iter_mut().zip([&feet.x, &feet.y, &feet.load]) {
                lanes.copy_from_slice(&of[block * LANES..(block + 1) * LANES]);
            }
            let [x, y, load] = &lanes;
            for k in 0..LANES {
                let (u, v) = (linear.x - angular * y[k], linear.y + angular * x[k]);
                let load = load[k] * (1.0 + slope.x * x[k] + slope.y * y[k]).max(0.0);
                let weight = load * inverse_root((u * u + v * v).max(least * least));
                sums[0][k] += weight;
                sums[1][k] += weight * x[k];
                sums[2][k] += weight * y[k];
                sums[3][k] += weight * (x[k] * x[k] + y[k] * y[k]);
                sums[4][k] += load;
            }
        }
        let mut totals = [0.0; 5];
        for (total, [a, b, c, d, e, f, g, h]) in totals.iter_mut().zip(sums) {
            *total = ((a + e) + (c + g)) + ((b + f) + (d + h));
        }
        let [sum, x, y, second, whole] = totals;
        let scale = 1.0 / whole;
        Drag { sum: scale * sum, first: scale * Vector::new(x, y), second: scale * second }
    }
}

/// 1 / sqrt(x) to some 14 digits, for x from 1e-30 to 1e30: in single precision, and one step of
/// Newton's method. Processors take a quarter of the time for roots and quotients in single
/// precision, and these took half of the time of a frame in a crowd.
#[inline(always)]
fn inverse_root(x: f64) -> f64 {
    let near = f64::from(1.0 / (x as f32).sqrt());
    near * (1.5 - 0.5 * x * near * near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_root_is_one_to_fourteen_digits() {
        for exponent in -290..=290 {
            let x = 10f64.powf(f64::from(exponent) / 10.0);
            assert!((inverse_root(x) * x.sqrt() - 1.0).abs() < 3e-14, "{x}");
        }
    }
}
