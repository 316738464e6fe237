//! A turn in the plane whose sine and cosine are taken once.

use super::Vector;

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
        // Most tools never turn.
        if angle == 0.0 {
            return Self::NONE;
        }
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
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
