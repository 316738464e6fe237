//! The plate as a rigid body on its way.

use crate::geometry::{Matrix3, Pose, Turn3, Vector3};
use crate::scene::Weight;

/// Mass and inertia, inverted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spread {
    /// One over the mass, 1/kg.
    pub mass: f64,
    /// Inverse of the inertia about the centre of mass, body axes, 1/(kg m^2).
    pub inertia: Matrix3,
}

impl Spread {
    /// That of `weight` as seen from the planar frame `own` is the inverse of; `side` is -1 if y
    /// is mirrored.
    pub fn new(weight: &Weight, own: &Pose, side: f64) -> Self {
        let [xx, yy, zz, xy, xz, yz] = weight.inertia;
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let turn = Turn3::from_axis_angle(&Vector3::z_axis(), own.heading).to_rotation_matrix();
        let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, side, 1.0));
        let seen = mirror * turn * inertia * turn.inverse() * mirror;
        Self {
            mass: 1.0 / weight.mass,
            // A plate without extent is no plate; zero keeps it from turning.
            inertia: seen.try_inverse().unwrap_or_else(Matrix3::zeros),
        }
    }
}

/// Where the plate is and how it moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// Centre of mass, metres.
    pub centre: Vector3,
    /// Turn since the start.
    pub turn: Turn3,
    /// The same as a matrix.
    pub axes: Matrix3,
    /// Speed of the centre of mass, m/s.
    pub speed: Vector3,
    /// Angular speed, rad/s.
    pub spin: Vector3,
}

impl Body {
    /// At rest there.
    pub fn at(centre: Vector3) -> Self {
        Self {
            centre,
            turn: Turn3::identity(),
            axes: Matrix3::identity(),
            speed: Vector3::zeros(),
            spin: Vector3::zeros(),
        }
    }

    /// Moves on for `step` seconds.
    pub fn advance(&mut self, step: f64) {
        self.centre += self.speed * step;
        self.turn = Turn3::from_scaled_axis(self.spin * step) * self.turn;
        self.turn.renormalize();
        self.axes = self.turn.to_rotation_matrix().into_inner();
    }

    /// Speed that no point within `reach` metres of the centre exceeds, m/s.
    pub fn fastest(&self, reach: f64) -> f64 {
        self.speed.norm() + self.spin.norm() * reach
    }
}
