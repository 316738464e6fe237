//! A rigid group as the unknown of a frame's equations, and how it resists being moved.
//!
//! For an object of mass m whose motion xi = (shift, c turn) has the length s = |xi|, support
//! friction of an ellipsoidal limit surface answers with mu m g xi / s. Inertia adds, with
//! velocities v0 at the start of the frame of T seconds,
//!
//! ```text
//! (mu m g / s + 2 m / T^2) xi     = 2 m v0 / T + f      for the displacement
//! (mu m g / s +   m / T^2) (v T)  =   m v0 / T + f      for the velocity at the end
//! ```
//!
//! the first because displacements are the mean of both velocities times T, which keeps their
//! errors of second order in T. A free object must coast exactly as [`super::coast`] says, even if
//! it comes to rest within the frame; so 2 m v0 / T is written as what makes it so.

use nalgebra::{Matrix3, Vector3};

use crate::{
    geometry::{Turn, Vector},
    scene::State,
};

use super::{
    bodies::{Bodies, Movable},
    motion::Motion,
    twist::{along, shift},
};

/// What the unknowns are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Quantity {
    /// Displacements in the frame.
    #[default]
    Displacement,
    /// Velocities at its end, times its duration.
    Velocity,
}

impl Quantity {
    /// Smallest length s, metres: what moves less in a frame counts as stuck. Velocities need a
    /// finer one, as what is left of them must count as rest.
    fn stuck(self) -> f64 {
        match self {
            Self::Displacement => 1e-4,
            Self::Velocity => 1e-5,
        }
    }

    /// What inertia adds to the resistance of `body` in a frame of that duration, N/m.
    fn inertia_of(self, body: &Movable, duration: f64) -> f64 {
        let inertia = body.mass / (duration * duration);
        match self {
            Self::Displacement => 2.0 * inertia,
            Self::Velocity => inertia,
        }
    }
}

/// A rigid group and its motion.
#[derive(Clone, Debug, Default)]
pub(super) struct Unknown {
    /// Mean position of its members at the start of the frame.
    pub centre: Vector,
    /// Displacement per force and torque, the inverse of the resistance.
    pub inverse: Matrix3<f64>,
    /// What pulls it without contacts and joints, force and torque.
    pull: Vector3<f64>,
    /// What it does without contacts and joints.
    pub free: Vector3<f64>,
    /// Shift of the centre, metres, and turn, radians.
    pub twist: Vector3<f64>,
    /// Force and torque of all contacts and joints.
    pub pressed: Vector3<f64>,
    /// The share of its motion that is looked at, see [`Self::look`], and the turn then.
    pub share: f64,
    pub turn: Turn,
}

impl Unknown {
    /// Puts the group where its `members` are; it has not moved yet.
    pub fn place(&mut self, members: &[usize], state: &State) {
        let positions = members.iter().map(|&k| state.poses[k].position);
        self.centre = positions.sum::<Vector>() / members.len() as f64;
        (self.share, self.turn) = (0.0, Turn::NONE);
    }

    /// Looks at the group when `share` of its present motion is done.
    pub fn look(&mut self, share: f64) {
        self.share = share;
        self.turn = Turn::by(share * self.twist.z);
    }

    /// Where a point of the group has come to then.
    pub fn moved(&self, point: Vector) -> Vector {
        self.centre + self.share * self.twist.xy() + self.turn.of(point - self.centre)
    }

    /// Takes what pulls the group in a frame of this kind and duration: friction and inertia of
    /// members that coast.
    pub fn pull(
        &mut self,
        (bodies, members): (&Bodies, &[usize]),
        state: &State,
        (quantity, duration): (Quantity, f64),
        coasts: &[Motion],
    ) {
        self.pull = Vector3::zeros();
        for &k in members {
            let body = &bodies.objects[k];
            let inertia = quantity.inertia_of(body, duration);
            let (pull, spin) = match quantity {
                Quantity::Displacement => {
                    let coast = &coasts[k];
                    let moved = length(coast.shift, body.support * coast.turn);
                    let (slide, turn) = resistance(body, inertia, moved.max(quantity.stuck()));
                    (slide * coast.shift, turn * coast.turn)
                }
                Quantity::Velocity => {
                    let start = &state.velocities[k];
                    let (slide, turn) = inertias(body, inertia);
                    (slide * duration * start.linear, turn * duration * start.angular)
                }
            };
            let arm = state.poses[k].position - self.centre;
            self.pull += along(pull, arm) + Vector3::new(0.0, 0.0, spin);
        }
    }

    /// Takes resistance and free motion when its members move as they do now, or by `reach`
    /// metres each.
    pub fn weigh(
        &mut self,
        (bodies, members): (&Bodies, &[usize]),
        state: &State,
        (quantity, duration): (Quantity, f64),
        reach: Option<f64>,
    ) {
        let weights = |body: &Movable, arm: Vector| {
            let moved = reach
                .unwrap_or_else(|| length(shift(&self.twist, arm), body.support * self.twist.z));
            resistance(body, quantity.inertia_of(body, duration), moved.max(quantity.stuck()))
        };
        self.inverse = if let [k] = *members {
            let (slide, turn) = weights(&bodies.objects[k], Vector::zeros());
            Matrix3::from_diagonal(&Vector3::new(1.0 / slide, 1.0 / slide, 1.0 / turn))
        } else {
            let mut weight = Matrix3::zeros();
            for &k in members {
                let arm = state.poses[k].position - self.centre;
                let (slide, turn) = weights(&bodies.objects[k], arm);
                let (x, y) = (arm.x, arm.y);
                weight += slide * Matrix3::new(1.0, 0.0, -y, 0.0, 1.0, x, -y, x, x * x + y * y);
                weight.m33 += turn;
            }
            weight.try_inverse().unwrap_or_else(Matrix3::identity)
        };
        self.free = self.inverse * self.pull;
    }
}

/// Length of a motion that shifts and turns, the turn times the support's length, metres.
fn length(shift: Vector, turn: f64) -> f64 {
    (shift.norm_squared() + turn * turn).sqrt()
}

/// Resistance of an object that moves by `moved` metres in all: to shifts, N/m, and to turns,
/// N m; `inertia` in N/m.
fn resistance(body: &Movable, inertia: f64, moved: f64) -> (f64, f64) {
    let rub = body.mass * body.deceleration / moved;
    let (slide, turn) = inertias(body, inertia);
    (slide + rub, turn + rub * body.support * body.support)
}

/// The part of it that inertia makes.
fn inertias(body: &Movable, inertia: f64) -> (f64, f64) {
    (inertia, inertia * body.support * body.support / body.spin)
}
