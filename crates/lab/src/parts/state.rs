//! Where a levered body is, and how it moves.

use pushplan::internals::geometry::{Turn3, Vector3};

/// Units of what the network says of a step: of ways, metres, and of turns, radians. A point 5 cm from the
/// centre of mass then counts alike however it moves.
const UNITS: [f64; 2] = [0.005, 0.1];

/// The levered body in the lever frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartState {
    /// Centre of mass, metres.
    pub centre: Vector3,
    /// Turn of its own axes.
    pub turn: Turn3,
    /// Way of the centre of mass in the last step, metres.
    pub way: Vector3,
    /// Turn in the last step, about its axis, radians.
    pub spin: Vector3,
}

impl PartState {
    /// At rest there.
    pub fn at((centre, turn): (Vector3, Turn3)) -> Self {
        Self { centre, turn, way: Vector3::zeros(), spin: Vector3::zeros() }
    }

    /// The state there, a step after this one.
    #[must_use]
    pub fn then(&self, (centre, turn): (Vector3, Turn3)) -> Self {
        let spin = (turn * self.turn.inverse()).scaled_axis();
        Self { centre, turn, way: centre - self.centre, spin }
    }

    /// The state after a step in which the body moves as `base` and beyond that by what the network
    /// says: even numbers `x, z, turn about y`, odd ones `y, turns about x and z`.
    #[must_use]
    pub(super) fn moved(&self, base: &Motion, even: &[f32], odd: &[f32]) -> Self {
        let [ways, turns] = UNITS;
        let way = Vector3::new(even[0].into(), odd[0].into(), even[1].into()) * ways;
        let spin = Vector3::new(odd[1].into(), even[2].into(), odd[2].into()) * turns;
        let mut turn = Turn3::from_scaled_axis(spin) * base.turn * self.turn;
        turn.renormalize();
        self.then((self.centre + base.way + way, turn))
    }

    /// What the network would have to say so that [`PartState::moved`] ends there.
    pub(super) fn wanted(&self, base: &Motion, (centre, turn): (Vector3, Turn3)) -> [f32; 6] {
        let [ways, turns] = UNITS;
        let way = (centre - self.centre - base.way) / ways;
        let spin = (turn * (base.turn * self.turn).inverse()).scaled_axis() / turns;
        [way.x, way.z, spin.y, way.y, spin.x, spin.z].map(|value| value as f32)
    }

    /// How far from there its centre of mass is, or a point 4 cm from that, metres.
    pub fn apart(&self, (centre, turn): (Vector3, Turn3)) -> f64 {
        (self.centre - centre).norm().max(0.04 * self.turn.angle_to(&turn))
    }

    /// How far at most a point within `reach` metres of the centre of mass moved in the last step, metres.
    pub(super) fn fastest(&self, reach: f64) -> f64 {
        self.way.norm() + self.spin.norm() * reach
    }

    pub(super) fn is_finite(&self) -> bool {
        self.centre.iter().chain(self.turn.coords.iter()).all(|value| value.is_finite())
    }
}

/// How a body moves in a step by what is known without the network: not at all, or as the prior has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// Of the centre of mass, metres.
    pub way: Vector3,
    /// Turn.
    pub turn: Turn3,
}

impl Motion {
    /// None.
    pub fn none() -> Self {
        Self { way: Vector3::zeros(), turn: Turn3::identity() }
    }

    /// From one place to the next.
    pub fn between(from: (Vector3, Turn3), to: (Vector3, Turn3)) -> Self {
        Self { way: to.0 - from.0, turn: to.1 * from.1.inverse() }
    }
}
