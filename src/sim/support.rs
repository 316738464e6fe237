//! Friction between an object's underside and the table, in the plane.
//!
//! Every point under the object drags with its share of the weight against its own motion
//! (Coulomb). What is pressed leans: its load moves ahead, see [`crate::scene::Physics::lean`].

use std::sync::Arc;

use crate::geometry::{Footprint, Vector};
use crate::scene::{Drag, Feet, GRAVITY, MAX_FEET};

use super::slowing::{Inertia, Twist};

/// Points slower than this share of the speed that friction takes from a free body in a step drag
/// in proportion to their speed, so that resting can be told from creeping. The larger it is, the
/// more a step matters: `tests/it/simulation/steps.rs` has the ends of pushes at 1/240 and 1/3840
/// s.
const STUCK: f64 = 0.05;

/// The same where objects are connected by joints that move: friction knows what presses only from
/// the last step, and a row of twelve would creep for seconds.
const STUCK_IN_JOINTS: f64 = 1.0;

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
    /// How much more than a slide friction can slow a turn: the mean square distance of the points
    /// over that of the mass, one if less.
    stiffest: f64,
    /// [`STUCK`] or [`STUCK_IN_JOINTS`].
    stuck: f64,
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
        Self { feet, deceleration, mass, lean, stiffest, stuck: STUCK }
    }

    /// The same among objects that are connected by joints that move.
    pub(super) fn in_joints(self) -> Self {
        Self { stuck: STUCK_IN_JOINTS, ..self }
    }

    /// How the points under an object turned by `heading` drag when it slides at `linear` (m/s) and
    /// turns at `angular` (rad/s), in a step of `dt` seconds; [`Self::load`] is what they bear.
    /// What presses is given as a share of the largest friction, see [`Pressed`].
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

    /// Shares of the weight on the points, where the object is turned by `heading`.
    pub(super) fn loads(&self, heading: f64, pressed: Vector) -> [f64; MAX_FEET] {
        let (sin, cos) = heading.sin_cos();
        let lean = self.lean * pressed;
        self.feet.leaning(Vector::new(cos * lean.x + sin * lean.y, cos * lean.y - sin * lean.x))
    }

    /// What the points carry as a share of the object's own weight.
    pub(super) fn share(&self) -> f64 {
        self.feet.share
    }

    /// Largest friction, N; none of a part above the table.
    pub(super) fn load(&self) -> f64 {
        self.mass * self.deceleration * self.feet.share
    }
}

/// What other bodies do to one, found from how its velocity changes.
#[derive(Clone, Debug, Default)]
pub(super) struct Pressed {
    load: f64,
    /// Its velocity and its friction at the last step.
    last: Option<(Twist, Twist)>,
}

impl Pressed {
    /// Makes one more object part of the body.
    pub(super) fn add(&mut self, support: &Support) {
        self.load += support.load();
    }

    /// What has pressed during the last `dt` seconds, after which a body of this inertia moves at
    /// `velocity`.
    pub(super) fn look(&mut self, inertia: &Inertia, velocity: &Twist, dt: f64) -> Twist {
        let pressed = self.last.map_or(Twist::default(), |(before, friction)| {
            let all = inertia.force(&before, velocity, dt);
            Twist { linear: all.linear - friction.linear, angular: all.angular - friction.angular }
        });
        self.last = Some((*velocity, Twist::default()));
        pressed
    }

    /// A force as a share of the largest friction, at most one.
    pub(super) fn share(&self, force: Vector) -> Vector {
        force / force.norm().max(self.load).max(f64::MIN_POSITIVE)
    }

    /// Takes friction in the step to come.
    pub(super) fn rub(&mut self, friction: &Twist) {
        if let Some((_, sum)) = &mut self.last {
            sum.linear += friction.linear;
            sum.angular += friction.angular;
        }
    }

    /// Multiplies the velocity it had by `factor`.
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
