//! The pose and motion of a levered body.

use pushplan::internals::geometry::{Turn3, Vector3};

/// Units of the network's output for a step: metres for displacements, radians for rotations. A
/// point 5 cm from the centre of mass then has equal weight in both.
const UNITS: [f64; 2] = [0.005, 0.1];

/// State of the levered body in the lever frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartState {
    /// Centre of mass, metres.
    pub centre: Vector3,
    /// Rotation of its own axes.
    pub turn: Turn3,
    /// Displacement of the centre of mass in the last step, metres.
    pub way: Vector3,
    /// Rotation in the last step, about its axis, radians.
    pub spin: Vector3,
}

impl PartState {
    /// Returns the state at rest at this pose.
    pub fn at((centre, turn): (Vector3, Turn3)) -> Self {
        Self { centre, turn, way: Vector3::zeros(), spin: Vector3::zeros() }
    }

    /// Returns the state at this pose, a step after the present one.
    #[must_use]
    pub fn then(&self, (centre, turn): (Vector3, Turn3)) -> Self {
        let spin = (turn * self.turn.inverse()).scaled_axis();
        Self { centre, turn, way: centre - self.centre, spin }
    }

    /// Returns the state after a step: the motion `base` plus the network's correction. Even
    /// numbers are `x, z, rotation about y`, odd ones `y, rotations about x and z`.
    #[must_use]
    pub(super) fn moved(&self, base: &Motion, even: &[f32], odd: &[f32]) -> Self {
        let [ways, turns] = UNITS;
        let way = Vector3::new(even[0].into(), odd[0].into(), even[1].into()) * ways;
        let spin = Vector3::new(odd[1].into(), even[2].into(), odd[2].into()) * turns;
        let mut turn = Turn3::from_scaled_axis(spin) * base.turn * self.turn;
        turn.renormalize();
        self.then((self.centre + base.way + way, turn))
    }

    /// Returns the network output for which [`PartState::moved`] ends at the given pose.
    pub(super) fn wanted(&self, base: &Motion, (centre, turn): (Vector3, Turn3)) -> [f32; 6] {
        let [ways, turns] = UNITS;
        let way = (centre - self.centre - base.way) / ways;
        let spin = (turn * (base.turn * self.turn).inverse()).scaled_axis() / turns;
        [way.x, way.z, spin.y, way.y, spin.x, spin.z].map(|value| value as f32)
    }

    /// Returns the distance to the given pose, metres: of the centre of mass or of a point 4 cm
    /// from it, whichever is larger.
    pub fn apart(&self, (centre, turn): (Vector3, Turn3)) -> f64 {
        (self.centre - centre).norm().max(0.04 * self.turn.angle_to(&turn))
    }

    /// Returns an upper bound on the displacement in the last step of a point within `reach` metres
    /// of the centre of mass, metres.
    pub(super) fn fastest(&self, reach: f64) -> f64 {
        self.way.norm() + self.spin.norm() * reach
    }

    pub(super) fn is_finite(&self) -> bool {
        self.centre.iter().chain(self.turn.coords.iter()).all(|value| value.is_finite())
    }
}

/// Motion of a body in a step without the network: none, or the analytic model's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// Displacement of the centre of mass, metres.
    pub way: Vector3,
    /// Rotation.
    pub turn: Turn3,
}

impl Motion {
    /// Returns no motion.
    pub fn none() -> Self {
        Self { way: Vector3::zeros(), turn: Turn3::identity() }
    }

    /// Returns the motion from one pose to the next.
    pub fn between(from: (Vector3, Turn3), to: (Vector3, Turn3)) -> Self {
        Self { way: to.0 - from.0, turn: to.1 * from.1.inverse() }
    }
}
