//! The quasi-static effect of one contact alone: the prior that the network corrects.
//!
//! A support with an ellipsoidal limit surface of length c moves under a force f at arm r by
//! the twist (f, (r x f) / c^2) up to scale. If the contact sticks, the twist follows from the
//! displacement of the pushing point (Lynch, Maekawa and Tanie 1992, eq. 6-8); its force must
//! then lie in the friction cone. If it does not, the contact slides with the force on the
//! cone's edge, and the twist is scaled to the displacement along the normal.

use crate::geometry::{Vector, cross, perpendicular};

/// Smallest share of a sliding contact's normal displacement that the centre line carries.
/// Below it the contact jams, which quasi-statics cannot answer.
const MIN_COMPLIANCE: f64 = 0.2;

/// A displacement and a turn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Of the centre, metres.
    pub shift: Vector,
    /// Radians.
    pub turn: f64,
}

impl Twist {
    /// Both parts times `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        Self { shift: self.shift * factor, turn: self.turn * factor }
    }
}

/// The motion of a body with limit-surface length `c` (metres) whose point `arm` (metres from
/// its centre) is pushed by `displacement` (metres) through a contact with unit `normal` (into
/// the body) and friction coefficient `mu`. Nothing if the displacement does not push.
pub fn contact_twist(c: f64, arm: Vector, normal: Vector, displacement: Vector, mu: f64) -> Twist {
    let closing = displacement.dot(&normal);
    if closing <= 0.0 {
        return Twist::default();
    }
    let c2 = c * c;
    let scale = 1.0 / (c2 + arm.norm_squared());
    let stick = Vector::new(
        (c2 + arm.x * arm.x) * displacement.x + arm.x * arm.y * displacement.y,
        arm.x * arm.y * displacement.x + (c2 + arm.y * arm.y) * displacement.y,
    ) * scale;
    let tangent = perpendicular(normal);
    let (along, across) = (stick.dot(&normal), stick.dot(&tangent));
    if along > 0.0 && across.abs() <= mu * along {
        return Twist { shift: stick, turn: cross(arm, stick) / c2 };
    }
    let force = normal + tangent * (mu * across.signum());
    let torque = cross(arm, force) / c2;
    let compliance = (1.0 + torque * cross(arm, normal)).max(MIN_COMPLIANCE);
    Twist { shift: force, turn: torque }.scaled(closing / compliance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_through_the_centre_only_shifts() {
        let twist =
            contact_twist(0.03, Vector::new(-0.05, 0.0), Vector::x(), Vector::new(0.01, 0.0), 0.4);
        assert!((twist.shift - Vector::new(0.01, 0.0)).norm() < 1e-15 && twist.turn == 0.0);
    }

    #[test]
    fn a_sticking_point_moves_with_the_pusher_and_a_sliding_one_along_the_normal() {
        let arm = Vector::new(-0.05, 0.02);
        for (displacement, mu, sticks) in
            [(Vector::new(0.01, 0.001), 0.8, true), (Vector::new(0.01, 0.02), 0.1, false)]
        {
            let twist = contact_twist(0.03, arm, Vector::x(), displacement, mu);
            let moved = twist.shift + twist.turn * perpendicular(arm);
            assert!((moved.x - displacement.x).abs() < 1e-12);
            assert_eq!((moved.y - displacement.y).abs() < 1e-12, sticks);
        }
    }
}
