//! Friction between an object's underside and the table, in the plane.
//!
//! Every point under the object drags with its share of the weight against its own motion
//! (Coulomb). What is so slow that friction would stop it within a step is slowed down in
//! proportion to its speed: friction stops, it does not push.
//!
//! The change is given to rapier as a force, so that it is spread over the small steps inside a
//! step; made at once before the step it would shorten every slide by v dt / 2, four times as
//! much (measured at 0.1 m/s and 1/240 s: 0.21 mm against 0.06).

use std::sync::Arc;

use crate::geometry::{Footprint, Vector, cross, perpendicular};
use crate::scene::{Feet, GRAVITY};

/// The support law of one object.
#[derive(Clone, Debug)]
pub(super) struct Support {
    feet: Arc<Feet>,
    /// mu g, m/s^2.
    deceleration: f64,
    /// m, kg.
    mass: f64,
    /// How much more than a slide friction can slow a turn, one if less: the mean square distance
    /// of the points over that of the mass.
    stiffest: f64,
}

impl Support {
    /// For the points under an object that covers `footprint`, a coefficient of friction and a mass
    /// (kg).
    pub(super) fn new(feet: &Arc<Feet>, footprint: &Footprint, friction: f64, mass: f64) -> Self {
        let stiffest = (feet.mean_square / footprint.gyration_radius().powi(2)).max(1.0);
        Self { feet: Arc::clone(feet), deceleration: friction * GRAVITY, mass, stiffest }
    }

    /// Force (N) and torque (N m) on an object turned by `heading` that slides at `linear` (m/s)
    /// and turns at `angular` (rad/s), during a step of `dt` seconds.
    pub(super) fn drag(
        &self,
        heading: f64,
        linear: Vector,
        angular: f64,
        dt: f64,
    ) -> (Vector, f64) {
        let least = self.deceleration * dt * self.stiffest;
        if least == 0.0 {
            return (Vector::zeros(), 0.0);
        }
        let axis = Vector::new(heading.cos(), heading.sin());
        let drag = self.feet.drag(axis, linear, angular, least);
        let load = self.mass * self.deceleration;
        let force = drag.sum * linear + angular * perpendicular(drag.first);
        let torque = cross(drag.first, linear) + drag.second * angular;
        (-load * force, -load * torque)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    const DISC: Footprint = Footprint::Disc { radius: 0.05 };

    fn support() -> Support {
        let feet = Feet::new(&scene::Support::Even, &DISC);
        Support::new(&Arc::new(feet), &DISC, 0.4, 2.0)
    }

    #[test]
    fn sliding_alone_feels_mu_m_g_until_a_step_would_turn_it_around() {
        let dt = 1e-3;
        let (force, torque) = support().drag(0.7, Vector::new(0.12, -0.16), 0.0, dt);
        let expected = -0.4 * 2.0 * GRAVITY * Vector::new(0.6, -0.8);
        assert!((force - expected).norm() < 1e-12 && torque.abs() < 1e-12, "{force} {torque}");
        let (force, _) = support().drag(0.0, Vector::new(1e-4, 0.0), 0.0, dt);
        assert!((force.x * dt + 2.0 * 1e-4).abs() < 1e-12, "{force}");
        assert_eq!(support().drag(0.0, Vector::zeros(), 0.0, dt), (Vector::zeros(), 0.0));
    }

    #[test]
    fn turning_alone_feels_mu_m_g_times_the_mean_radius() {
        let (force, torque) = support().drag(0.3, Vector::zeros(), 5.0, 1e-3);
        assert!((torque + 0.4 * 2.0 * GRAVITY * DISC.mean_radius()).abs() < 1e-12, "{torque}");
        assert!(force.norm() < 1e-12, "{force}");
    }
}
