//! Friction of the support points of a moving object.

use std::sync::OnceLock;

use pulp::{Arch, Simd, WithSimd};

use crate::Vector;

use crate::feet::{Feet, MAX_FEET};

/// Number of points summed side by side. All sums are taken in this order on every processor, so
/// that their bits are the same.
const LANES: usize = 8;

/// Widest vectors of this processor.
static ARCH: OnceLock<Arch> = OnceLock::new();

/// Moments of the weights of points that drag, see [`Feet::drag`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Drag {
    /// Sum of the weights.
    pub sum: f64,
    /// Sum of weight times position relative to the centre, in world axes.
    pub first: Vector,
    /// Sum of weight times squared distance from the centre.
    pub second: f64,
}

impl Feet {
    /// Computes the resistance to a planar motion of the object, whose own x axis points along the
    /// unit vector `axis`. Every point drags with its load against its own motion; points slower
    /// than `least` drag as if they moved at that speed. With d the motion of a point, its weight
    /// is load / max(|d|, `least`). The centre of the load is displaced by `lean`, metres.
    pub fn drag(&self, axis: Vector, motion: (Vector, f64), least: f64, lean: Vector) -> Drag {
        ARCH.get_or_init(Arch::new).dispatch(Moving { feet: self, axis, motion, least, lean })
    }

    /// Computes [`Self::drag`] inlined into its caller, which is already compiled for wide vectors.
    #[inline(always)]
    pub fn drag_here(
        &self,
        axis: Vector,
        (linear, angular): (Vector, f64),
        least: f64,
        lean: Vector,
    ) -> Drag {
        let speed = (linear.x * linear.x + linear.y * linear.y).sqrt();
        // The points of a round object represent all of its rotations, so they rotate with the
        // motion.
        let (cos, sin) = match self.round {
            true if speed > 0.0 => (linear.x / speed, linear.y / speed),
            true => (1.0, 0.0),
            false => (axis.x, axis.y),
        };
        let (u, v) = (cos * linear.x + sin * linear.y, cos * linear.y - sin * linear.x);
        let (along, across) = (cos * lean.x + sin * lean.y, cos * lean.y - sin * lean.x);
        let slope = self.slope(Vector::new(along, across));
        let [sum, x, y, second] = self.moments([u, v], angular, least, [slope.x, slope.y]);
        let first = Vector::new(cos * x - sin * y, sin * x + cos * y);
        Drag { sum, first, second }
    }

    /// Computes [`Self::drag`] for a translation of every point by `moved`.
    #[inline]
    pub fn even_drag(&self, axis: Vector, moved: f64) -> Drag {
        let (x, y) = (self.centre.x, self.centre.y);
        let first = Vector::new(axis.x * x - axis.y * y, axis.y * x + axis.x * y) / moved;
        Drag { sum: 1.0 / moved, first, second: self.mean_square / moved }
    }

    /// Computes the moments in the points' own frame. The compiler turns the plain loops over lanes
    /// into the processor's vectors, in which spare points carry no load. `slope` is the relative
    /// increase of a point's load per metre from the centre.
    #[inline(always)]
    fn moments(&self, linear: [f64; 2], angular: f64, least: f64, slope: [f64; 2]) -> [f64; 4] {
        let mut sums = [[0.0; LANES]; 5];
        for block in 0..self.count.div_ceil(LANES).min(MAX_FEET / LANES) {
            let mut lanes = [[0.0; LANES]; 3];
            for (lanes, of) in lanes.iter_mut().zip([&self.x, &self.y, &self.load]) {
                lanes.copy_from_slice(&of[block * LANES..(block + 1) * LANES]);
            }
            let [x, y, load] = &lanes;
            for k in 0..LANES {
                let (u, v) = (linear[0] - angular * y[k], linear[1] + angular * x[k]);
                let load = load[k] * (1.0 + slope[0] * x[k] + slope[1] * y[k]).max(0.0);
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
        [scale * sum, scale * x, scale * y, scale * second]
    }
}

/// Arguments of [`Feet::drag`].
struct Moving<'a> {
    feet: &'a Feet,
    axis: Vector,
    motion: (Vector, f64),
    least: f64,
    lean: Vector,
}

impl WithSimd for Moving<'_> {
    type Output = Drag;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Drag {
        self.feet.drag_here(self.axis, self.motion, self.least, self.lean)
    }
}

/// Computes 1 / sqrt(x) to about 14 digits for x from 1e-30 to 1e30, in single precision with one
/// step of Newton's method. Processors take a quarter of the time for roots and quotients in single
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
