//! Friction between an object's underside and the table, in the plane.
//!
//! Every point under the object drags with its share of the weight against its own motion
//! (Coulomb). Under a push the load moves ahead, see [`crate::scene::Physics::lean`].

use std::sync::Arc;

use crate::geometry::{Footprint, Vector};
use crate::scene::{Drag, Feet, GRAVITY, MAX_FEET};

use super::slowing::{Inertia, Twist};

/// Share of the speed that friction takes from a free body in a step, below which points drag in
/// proportion to their speed. It separates resting from creeping. The larger it is, the more the
/// result depends on the step: `tests/it/simulation/steps.rs` has the ends of pushes at 1/240 and
/// 1/3840 s.
const STUCK: f64 = 0.05;

/// Value in place of [`STUCK`] for objects connected by moving joints. Friction uses the forces of
/// the previous step, and a row of twelve would creep for seconds.
const STUCK_IN_JOINTS: f64 = 1.0;

/// The support law of an object.
#[derive(Clone, Debug)]
pub(super) struct Support {
    feet: Arc<Feet>,
    /// Deceleration mu g, m/s^2.
    deceleration: f64,
    /// Mass m, kg.
    mass: f64,
    /// Shift of the load when the object is pushed against full friction, metres.
    lean: f64,
    /// Ratio of the decelerations of rotations and slides: the mean square distance of the points
    /// over the mean square distance of the mass, at least one.
    stiffest: f64,
    /// Share of the speed: [`STUCK`] or [`STUCK_IN_JOINTS`].
    stuck: f64,
}

impl Support {
    /// Creates the law from the points under an object that covers `footprint`, a coefficient of
    /// friction, a mass (kg) and the shift of the load under full friction (metres).
    pub(super) fn new(
        feet: &Arc<Feet>,
        footprint: &Footprint,
        friction: f64,
        mass: f64,
        lean: f64,
    ) -> Self {
        let stiffest = (feet.mean_square / footprint.gyration_radius().powi(2)).max(1.0);
        let (feet, deceleration) = (Arc::clone(feet), friction * GRAVITY);
        Self { feet, deceleration, mass, lean, stiffest, stuck: STUCK }
    }

    /// Returns the law for objects connected by moving joints.
    pub(super) fn in_joints(self) -> Self {
        Self { stuck: STUCK_IN_JOINTS, ..self }
    }

    /// Returns the drag of the points under an object at `heading` with velocity `linear` (m/s) and
    /// `angular` (rad/s), in a step of `dt` seconds. Multiply by [`Self::load`] for forces. The
    /// pushing force is given as a share of the largest friction, see [`Pressed`].
    pub(super) fn drag(
        &self,
        heading: f64,
        (linear, angular): (Vector, f64),
        pressed: Vector,
        dt: f64,
    ) -> Drag {
        let least = self.stuck * self.stiffest * self.deceleration * dt;
        if least == 0.0 {
            return Drag::default();
        }
        let axis = Vector::new(heading.cos(), heading.sin());
        self.feet.drag(axis, (linear, angular), least, self.lean * pressed)
    }

    /// Returns the shares of the weight on the points of an object at `heading`.
    pub(super) fn loads(&self, heading: f64, pressed: Vector) -> [f64; MAX_FEET] {
        let (sin, cos) = heading.sin_cos();
        let lean = self.lean * pressed;
        self.feet.leaning(Vector::new(cos * lean.x + sin * lean.y, cos * lean.y - sin * lean.x))
    }

    /// Returns the load on the points as a share of the object's own weight.
    pub(super) fn share(&self) -> f64 {
        self.feet.share
    }

    /// Returns the largest friction, N; zero for a part above the table.
    pub(super) fn load(&self) -> f64 {
        self.mass * self.deceleration * self.feet.share
    }
}

/// Forces of other bodies on a body, estimated from its change of velocity.
#[derive(Clone, Debug, Default)]
pub(super) struct Pressed {
    load: f64,
    /// Velocity and friction at the last step.
    last: Option<(Twist, Twist)>,
}

impl Pressed {
    /// Adds an object to the body.
    pub(super) fn add(&mut self, support: &Support) {
        self.load += support.load();
    }

    /// Returns the force of other bodies during the last `dt` seconds on a body with this inertia,
    /// which now moves at `velocity`.
    pub(super) fn look(&mut self, inertia: &Inertia, velocity: &Twist, dt: f64) -> Twist {
        let pressed = self.last.map_or(Twist::default(), |(before, friction)| {
            let all = inertia.force(&before, velocity, dt);
            Twist { linear: all.linear - friction.linear, angular: all.angular - friction.angular }
        });
        self.last = Some((*velocity, Twist::default()));
        pressed
    }

    /// Returns a force as a share of the largest friction, at most one.
    pub(super) fn share(&self, force: Vector) -> Vector {
        force / force.norm().max(self.load).max(f64::MIN_POSITIVE)
    }

    /// Adds the friction of the coming step.
    pub(super) fn rub(&mut self, friction: &Twist) {
        if let Some((_, sum)) = &mut self.last {
            sum.linear += friction.linear;
            sum.angular += friction.angular;
        }
    }

    /// Multiplies the previous velocity by `factor`.
    pub(super) fn hurry(&mut self, factor: f64) {
        if let Some((before, _)) = &mut self.last {
            before.linear *= factor;
            before.angular *= factor;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    const DISC: Footprint = Footprint::Disc { radius: 0.05 };

    fn support() -> Support {
        let feet = scene::Support::Even.feet(&DISC);
        Support::new(&Arc::new(feet), &DISC, 0.4, 2.0, 0.0)
    }

    #[test]
    fn sliding_and_turning_alone_feel_mu_m_g_and_that_times_the_mean_radius() {
        let (support, dt) = (support(), 1e-3);
        let load = 0.4 * 2.0 * GRAVITY;
        let drag = support.drag(0.7, (Vector::new(0.12, -0.16), 0.0), Vector::zeros(), dt);
        assert!((support.load() * drag.sum * 0.2 - load).abs() < 1e-12, "{drag:?}");
        assert!(drag.first.norm() < 1e-12);
        let drag = support.drag(0.3, (Vector::zeros(), 5.0), Vector::zeros(), dt);
        let torque = support.load() * drag.second * 5.0;
        assert!((torque - load * DISC.mean_radius()).abs() < 1e-12, "{torque}");
        let smooth = Support { deceleration: 0.0, ..support };
        let drag = smooth.drag(0.0, (Vector::zeros(), 0.0), Vector::zeros(), dt);
        assert_eq!((drag.sum, drag.second), (0.0, 0.0));
    }
}
