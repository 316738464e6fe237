//! The motion of a body in a frame.

use crate::Vector;

/// A planar displacement and the velocity at its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacement of the centre, metres.
    pub shift: Vector,
    /// Rotation, radians.
    pub turn: f64,
    /// Velocity of the centre at the end, m/s.
    pub velocity: Vector,
    /// Angular velocity at the end, rad/s.
    pub spin: f64,
}

impl Motion {
    /// Returns the displacement of the point `arm` metres from the body's centre, to first order,
    /// metres.
    #[inline]
    pub fn at(&self, arm: Vector) -> Vector {
        self.shift + self.turn * Vector::new(-arm.y, arm.x)
    }
}
