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
}

impl Support {
    /// For a footprint and a coefficient of friction.
    pub(super) fn new(footprint: &Footprint, friction: f64) -> Self {
        let (c, rho) = (footprint.mean_radius(), footprint.gyration_radius());
        Self { deceleration: friction * GRAVITY, mean_radius: c, spin_ratio: (c / rho) * (c / rho) }
    }

    /// The factors, 0 to 1, by which a step of `dt` seconds slows sliding at `speed` (m/s) and
    /// turning at `turning` (rad/s).
    pub(super) fn keep(&self, speed: f64, turning: f64, dt: f64) -> (f64, f64) {
        let s = speed.hypot(self.mean_radius * turning);
        if s == 0.0 {
            return (1.0, 1.0);
        }
        let loss = self.deceleration * dt / s;
        ((1.0 - loss).max(0.0), (1.0 - loss * self.spin_ratio).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliding_alone_loses_mu_g_dt_and_never_turns_around() {
        let support = Support::new(&Footprint::Disc { radius: 0.05 }, 0.4);
        let dt = 1e-3;
        let (slide, _) = support.keep(0.2, 0.0, dt);
        assert!((0.2 * (1.0 - slide) - 0.4 * GRAVITY * dt).abs() < 1e-15);
        assert_eq!(support.keep(1e-4, 0.0, dt).0, 0.0);
        assert_eq!(support.keep(0.0, 0.0, dt), (1.0, 1.0));
    }
}
