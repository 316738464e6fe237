//! A planar rotation with its sine and cosine.

use crate::Vector;

/// Angle below which five terms of a Taylor series are exact, radians.
const SMALL: f64 = 0.1;

/// A planar rotation, stored as sine and cosine to rotate many vectors by one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    sin: f64,
    cos: f64,
}

impl Default for Turn {
    fn default() -> Self {
        Self::NONE
    }
}

impl Turn {
    /// The identity.
    pub const NONE: Self = Self { sin: 0.0, cos: 1.0 };

    /// Returns the rotation by `angle`, radians, counter-clockwise.
    #[inline]
    pub fn by(angle: f64) -> Self {
        let [[sin], [cos]] = sines([angle]);
        Self { sin, cos }
    }

    /// Returns the composition of `first` and this rotation.
    #[inline]
    pub fn after(&self, first: &Self) -> Self {
        Self {
            sin: self.sin * first.cos + self.cos * first.sin,
            cos: self.cos * first.cos - self.sin * first.sin,
        }
    }

    /// Returns the rotation from `other` to this one.
    #[inline]
    pub fn from(&self, other: &Self) -> Self {
        Self {
            sin: self.sin * other.cos - self.cos * other.sin,
            cos: self.cos * other.cos + self.sin * other.sin,
        }
    }

    /// Returns the rotated x axis, a unit vector.
    #[inline]
    pub fn axis(&self) -> Vector {
        Vector::new(self.cos, self.sin)
    }

    /// Returns `v`, rotated.
    #[inline]
    pub fn of(&self, v: Vector) -> Vector {
        Vector::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// Returns `v`, rotated by the inverse.
    #[inline]
    pub fn back(&self, v: Vector) -> Vector {
        Vector::new(self.cos * v.x + self.sin * v.y, -self.sin * v.x + self.cos * v.y)
    }
}

/// Computes sines and cosines of angles, radians. The bits of each do not depend on the other
/// angles.
#[inline(always)]
pub fn sines<const N: usize>(angles: [f64; N]) -> [[f64; N]; 2] {
    // Nearly all rotations of a frame are small, and most tools never rotate.
    let [mut sin, mut cos] = [[0.0; N], [1.0; N]];
    let (mut none, mut large) = (true, false);
    for angle in angles {
        none &= angle == 0.0;
        large |= angle.abs() >= SMALL;
    }
    if large {
        for k in 0..N {
            let small = angles[k].abs() < SMALL;
            (sin[k], cos[k]) = if small { series(angles[k]) } else { angles[k].sin_cos() };
        }
    } else if !none {
        for k in 0..N {
            (sin[k], cos[k]) = series(angles[k]);
        }
    }
    for k in 0..N {
        // Avoids minus zero.
        sin[k] = if angles[k] == 0.0 { 0.0 } else { sin[k] };
    }
    [sin, cos]
}

/// Computes sine and cosine of an angle below [`SMALL`] by Taylor series, exact to rounding.
#[inline(always)]
fn series(angle: f64) -> (f64, f64) {
    let x = angle * angle;
    let sin = [1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0, -1.0 / 39_916_800.0];
    let cos = [1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0];
    let (mut s, mut c) = (0.0, 0.0);
    for k in (0..6).rev() {
        (s, c) = (s * x + sin[k], c * x + cos[k]);
    }
    (angle * s, c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_turns_are_those_of_sine_and_cosine() {
        for k in -100..=100 {
            let angle = SMALL * f64::from(k) / 100.0;
            let (sin, cos) = series(angle);
            assert!((sin - angle.sin()).abs() < 2e-17 && (cos - angle.cos()).abs() < 2e-16);
        }
        assert_eq!(Turn::by(0.0), Turn::NONE);
    }

    #[test]
    fn turns_add_up_and_lead_from_one_to_another() {
        for (a, b) in [(0.3, 2.9), (-2.0, -1.7), (3.1, 0.02)] {
            let (first, second) = (Turn::by(a), Turn::by(b));
            for (turn, angle) in [(second.after(&first), a + b), (second.from(&first), b - a)] {
                let off = turn.axis() - Vector::new(f64::cos(angle), f64::sin(angle));
                assert!(off.norm() < 1e-15, "{a} {b}: {off}");
            }
        }
        assert_eq!(Turn::by(0.7).from(&Turn::by(0.7)).sin, 0.0);
    }
}
