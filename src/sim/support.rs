//! Friction between an object's underside and the table, in the plane.
//!
//! Every point under the object drags with its share of the weight against its own motion
//! (Coulomb). What is so slow that friction would stop it within a step is slowed down in
//! proportion to its speed: friction stops, it does not push. What is pressed leans: its load
//! moves ahead, see [`crate::scene::Physics::lean`].
//!
//! The change is given to rapier as a force, so that it is spread over the small steps inside a
//! step; made at once before the step it would shorten every slide by v dt / 2, four times as
//! much (measured at 0.1 m/s and 1/240 s: 0.21 mm against 0.06).

use std::sync::Arc;

use crate::geometry::{Footprint, Vector, cross, perpendicular};
use crate::scene::{Feet, GRAVITY, MAX_FEET};

/// The support law of one object.
#[derive(Clone, Debug)]
pub(super) struct Support {
    feet: Arc<Feet>,
    /// mu g, m/s^2.
    deceleration: f64,
    /// m, kg.
    mass: f64,
    /// How far the load moves when the object is pressed as hard as friction resists, metres.
    lean: f64,
    /// How much more than a slide friction can slow a turn, one if less: the mean square distance
    /// of the points over that of the mass.
    stiffest: f64,
}

impl Support {
    /// For the points under an object that covers `footprint`, a coefficient of friction, a mass
    /// (kg) and how far it leans when pressed (metres).
    pub(super) fn new(
        feet: &Arc<Feet>,
        footprint: &Footprint,
        friction: f64,
        mass: f64,
        lean: f64,
    ) -> Self {
        let stiffest = (feet.mean_square / footprint.gyration_radius().powi(2)).max(1.0);
        let (feet, deceleration) = (Arc::clone(feet), friction * GRAVITY);
        Self { feet, deceleration, mass, lean, stiffest }
    }

    /// Force (N) and torque (N m) on an object turned by `heading` that slides at `linear` (m/s)
    /// and turns at `angular` (rad/s), during a step of `dt` seconds.
    /// What presses is given as a share of the largest friction, see [`Pressed`].
    pub(super) fn drag(
        &self,
        heading: f64,
        linear: Vector,
        angular: f64,
        pressed: Vector,
        dt: f64,
    ) -> (Vector, f64) {
        let least = self.deceleration * dt * self.stiffest;
        if least == 0.0 {
            return (Vector::zeros(), 0.0);
        }
        let axis = Vector::new(heading.cos(), heading.sin());
        let drag = self.feet.drag(axis, (linear, angular), least, self.lean * pressed);
        let load = self.load();
        let force = drag.sum * linear + angular * perpendicular(drag.first);
        let torque = cross(drag.first, linear) + drag.second * angular;
        (-load * force, -load * torque)
    }

    /// Shares of the weight on the points, where the object is turned by `heading`.
    pub(super) fn loads(&self, heading: f64, pressed: Vector) -> [f64; MAX_FEET] {
        let (sin, cos) = heading.sin_cos();
        let lean = self.lean * pressed;
        self.feet.leaning(Vector::new(cos * lean.x + sin * lean.y, cos * lean.y - sin * lean.x))
    }

    /// Largest friction, N.
    pub(super) fn load(&self) -> f64 {
        self.mass * self.deceleration
    }
}

/// How hard other bodies press on one, found from how its velocity changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Pressed {
    mass: f64,
    load: f64,
    /// Its velocity (m/s) and its friction (N) at the last step.
    last: Option<(Vector, Vector)>,
}

impl Pressed {
    /// Makes one more object part of the body.
    pub(super) fn add(&mut self, support: &Support) {
        self.mass += support.mass;
        self.load += support.load();
    }

    /// What has pressed during the last `dt` seconds, after which the body's centre moves at
    /// `velocity` (m/s): a share of the largest friction, at most one.
    pub(super) fn look(&mut self, velocity: Vector, dt: f64) -> Vector {
        let pressed = self.last.map_or(Vector::zeros(), |(before, friction)| {
            self.mass * (velocity - before) / dt - friction
        });
        self.last = Some((velocity, Vector::zeros()));
        pressed / pressed.norm().max(self.load).max(f64::MIN_POSITIVE)
    }

    /// Takes the friction (N) of an object in the step to come.
    pub(super) fn rub(&mut self, friction: Vector) {
        if let Some((_, sum)) = &mut self.last {
            *sum += friction;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    const DISC: Footprint = Footprint::Disc { radius: 0.05 };

    fn support() -> Support {
        let feet = Feet::new(&scene::Support::Even, &DISC);
        Support::new(&Arc::new(feet), &DISC, 0.4, 2.0, 0.0)
    }

    #[test]
    fn sliding_alone_feels_mu_m_g_until_a_step_would_turn_it_around() {
        let dt = 1e-3;
        let (force, torque) =
            support().drag(0.7, Vector::new(0.12, -0.16), 0.0, Vector::zeros(), dt);
        let expected = -0.4 * 2.0 * GRAVITY * Vector::new(0.6, -0.8);
        assert!((force - expected).norm() < 1e-12 && torque.abs() < 1e-12, "{force} {torque}");
        let (force, _) = support().drag(0.0, Vector::new(1e-4, 0.0), 0.0, Vector::zeros(), dt);
        assert!((force.x * dt + 2.0 * 1e-4).abs() < 1e-12, "{force}");
        assert_eq!(
            support().drag(0.0, Vector::zeros(), 0.0, Vector::zeros(), dt),
            (Vector::zeros(), 0.0)
        );
    }

    #[test]
    fn turning_alone_feels_mu_m_g_times_the_mean_radius() {
        let (force, torque) = support().drag(0.3, Vector::zeros(), 5.0, Vector::zeros(), 1e-3);
        assert!((torque + 0.4 * 2.0 * GRAVITY * DISC.mean_radius()).abs() < 1e-12, "{torque}");
        assert!(force.norm() < 1e-12, "{force}");
    }
}
