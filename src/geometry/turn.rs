//! A turn in the plane whose sine and cosine are taken once.

use super::Vector;

/// Angle below which five terms of a Taylor series are exact, radians.
const SMALL: f64 = 0.1;

/// A turn, for vectors that are turned by the same angle.
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
    /// Turns nothing.
    pub const NONE: Self = Self { sin: 0.0, cos: 1.0 };

    /// By `angle`, radians, to the left.
    pub fn by(angle: f64) -> Self {
        // Nearly all turns of a frame are small, and most tools never turn.
        if angle == 0.0 {
            return Self::NONE;
        }
        if angle.abs() < SMALL {
            return Self::small(angle);
        }
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    /// By less than [`SMALL`]: Taylor series, exact to rounding.
    fn small(angle: f64) -> Self {
        let x = angle * angle;
        let sin =
            [1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0, -1.0 / 39_916_800.0];
        let cos = [1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0];
        let sum = |terms: [f64; 6]| terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
        Self { sin: angle * sum(sin), cos: sum(cos) }
    }

    /// `v`, turned.
    pub fn of(&self, v: Vector) -> Vector {
        Vector::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// `v`, turned the other way.
    pub fn back(&self, v: Vector) -> Vector {
        Vector::new(self.cos * v.x + self.sin * v.y, -self.sin * v.x + self.cos * v.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_turns_are_those_of_sine_and_cosine() {
        for k in -100..=100 {
            let angle = SMALL * f64::from(k) / 100.0;
            let Turn { sin, cos } = Turn::small(angle);
            assert!((sin - angle.sin()).abs() < 2e-17 && (cos - angle.cos()).abs() < 2e-16);
        }
        assert_eq!(Turn::by(0.0), Turn::NONE);
    }
}
