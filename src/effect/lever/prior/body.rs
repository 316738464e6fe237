//! The plate as a moving rigid body.

use crate::geometry::{Matrix3, Pose, Turn3, Vector3};
use crate::scene::Weight;

/// Inverse mass and inertia.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    /// Inverse of the mass, 1/kg.
    pub mass: f64,
    /// Inverse of the inertia about the centre of mass, body axes, 1/(kg m^2).
    pub inertia: Matrix3,
}

impl Spread {
    /// Creates the inverse of `weight` in the view whose inverse planar frame is `own`; `side` is
    /// -1 if y is mirrored.
    pub fn new(weight: &Weight, own: &Pose, side: f64) -> Self {
        let [xx, yy, zz, xy, xz, yz] = weight.inertia;
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let turn = Turn3::from_axis_angle(&Vector3::z_axis(), own.heading).to_rotation_matrix();
        let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, side, 1.0));
        let seen = mirror * turn * inertia * turn.inverse() * mirror;
        Self {
            mass: 1.0 / weight.mass,
            // A plate without extent is invalid; zero prevents its rotation.
            inertia: seen.try_inverse().unwrap_or_else(Matrix3::zeros),
        }
    }
}

/// Pose and velocity of the plate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// Position of the centre of mass, metres.
    pub centre: Vector3,
    /// Rotation since the start.
    pub turn: Turn3,
    /// Rotation as a matrix.
    pub axes: Matrix3,
    /// Velocity of the centre of mass, m/s.
    pub speed: Vector3,
    /// Angular velocity, rad/s.
    pub spin: Vector3,
}

impl Body {
    /// Creates a body at rest at this position.
    pub fn at(centre: Vector3) -> Self {
        Self {
            centre,
            turn: Turn3::identity(),
            axes: Matrix3::identity(),
            speed: Vector3::zeros(),
            spin: Vector3::zeros(),
        }
    }

    /// Integrates the velocities over `step` seconds.
    pub fn advance(&mut self, step: f64) {
        self.centre += self.speed * step;
        self.turn = Turn3::from_scaled_axis(self.spin * step) * self.turn;
        self.turn.renormalize();
        self.axes = self.turn.to_rotation_matrix().into_inner();
    }

    /// Returns an upper bound on the speed of any point within `reach` metres of the centre, m/s.
    pub fn fastest(&self, reach: f64) -> f64 {
        self.speed.norm() + self.spin.norm() * reach
    }
}
