//! Friction between an object's underside and the table, in the plane.
//!
//! Ellipsoidal limit surface with uniform pressure (Goyal, Ruina and Papadopoulos 1991, Wear 143,
//! 307; Lynch and Howe 1992): with s = sqrt(|v|^2 + c^2 w^2) the force is -mu m g v / s and the
//! torque -mu m g c^2 w / s, so over a step dt
//!
//! ```text
//! dv = -mu g dt v / s        dw = -mu g dt (c / rho)^2 w / s
//! ```
//!
//! where c is the footprint's mean radius and rho its radius of gyration. Neither change may
//! turn its velocity around: friction stops, it does not push.
//!
//! The change is given to rapier as a force, so that it is spread over the small steps inside a
//! step; made at once before the step it would shorten every slide by v dt / 2, four times as
//! much (measured at 0.1 m/s and 1/240 s: 0.21 mm against 0.06).

use crate::geometry::Footprint;
use crate::scene::GRAVITY;

/// The support law of one object.
#[derive(Clone, Copy, Debug)]
pub(super) struct Support {
    /// mu g, m/s^2.
    deceleration: f64,
    /// c, metres.
    mean_radius: f64,
    /// (c / rho)^2.
    spin_ratio: f64,
    /// m, kg.
    mass: f64,
    /// m rho^2, kg m^2.
    inertia: f64,
}

impl Support {
    /// For a footprint, a coefficient of friction and a mass (kg).
    pub(super) fn new(footprint: &Footprint, friction: f64, mass: f64) -> Self {
        let (c, rho) = (footprint.mean_radius(), footprint.gyration_radius());
        Self {
            deceleration: friction * GRAVITY,
            mean_radius: c,
            spin_ratio: (c / rho) * (c / rho),
            mass,
            inertia: mass * rho * rho,
        }
    }

    /// Resistance during a step of `dt` seconds to sliding at `speed` (m/s) while turning at
    /// `turning` (rad/s): force per velocity (N s/m) and torque per turning (N m s/rad).
    pub(super) fn drag(&self, speed: f64, turning: f64, dt: f64) -> (f64, f64) {
        let s = speed.hypot(self.mean_radius * turning);
        if s == 0.0 {
            return (0.0, 0.0);
        }
        let loss = self.deceleration * dt / s;
        let (slide, turn) = (loss.min(1.0), (loss * self.spin_ratio).min(1.0));
        (self.mass * slide / dt, self.inertia * turn / dt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliding_alone_feels_mu_m_g_until_a_step_would_turn_it_around() {
        let support = Support::new(&Footprint::Disc { radius: 0.05 }, 0.4, 2.0);
        let dt = 1e-3;
        assert!((support.drag(0.2, 0.0, dt).0 * 0.2 - 0.4 * 2.0 * GRAVITY).abs() < 1e-12);
        assert_eq!(support.drag(1e-4, 0.0, dt).0 * dt, 2.0);
        assert_eq!(support.drag(0.0, 0.0, dt), (0.0, 0.0));
    }

    #[test]
    fn turning_alone_feels_mu_m_g_times_the_mean_radius() {
        let footprint = Footprint::Disc { radius: 0.05 };
        let support = Support::new(&footprint, 0.4, 2.0);
        let torque = support.drag(0.0, 5.0, 1e-3).1 * 5.0;
        assert!((torque - 0.4 * 2.0 * GRAVITY * footprint.mean_radius()).abs() < 1e-12);
    }
}
