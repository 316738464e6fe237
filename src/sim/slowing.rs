//! Deceleration of a body by friction with the table in a step.
//!
//! Friction is evaluated at the end of the step. Evaluated at the beginning, it could only slow
//! bodies in proportion to their speed if it would stop them within a step. At 0.1 m/s, 1/240 s and
//! a coefficient of 0.5 this applies to anything below a fifth of the tool's speed, such as the
//! corner about which a box rotates. The applied forces are only known after the step, so the
//! forces of the previous step are used.
//!
//! The analytic model has similar equations ([`crate::contact`]). They are not shared, because this
//! engine verifies the analytic model, and a common mistake would stay hidden.

use crate::geometry::{Vector, cross, perpendicular};
use crate::scene::Drag;

/// Number of iterations for the velocity at the end of the step.
const ROUNDS: usize = 4;

/// A velocity of a body's centre of mass, m/s, and its angular velocity, rad/s; or a force and a
/// torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Twist {
    pub linear: Vector,
    pub angular: f64,
}

/// The resistance to a body's motion: force and torque for each m/s and rad/s.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Resistance {
    sum: f64,
    first: Vector,
    second: f64,
}

impl Resistance {
    /// Adds an object with the load `load` (N) on the table, whose centre is `arm` away from the
    /// body's.
    pub fn add(&mut self, load: f64, drag: &Drag, arm: Vector) {
        self.sum += load * drag.sum;
        self.first += load * (drag.first + drag.sum * arm);
        let second = drag.second + 2.0 * drag.first.dot(&arm) + drag.sum * arm.norm_squared();
        self.second += load * second;
    }

    /// Returns the resisting force and torque of a motion.
    pub fn against(&self, twist: &Twist) -> Twist {
        let Twist { linear, angular } = *twist;
        Twist {
            linear: -(self.sum * linear + angular * perpendicular(self.first)),
            angular: -(cross(self.first, linear) + self.second * angular),
        }
    }
}

/// Mass of a body, kg, and moment of inertia about its centre of mass, kg m^2.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Inertia {
    pub mass: f64,
    pub spin: f64,
}

impl Inertia {
    /// Returns the force and torque that change the velocity from `before` to `after` in `dt`
    /// seconds.
    pub fn force(&self, before: &Twist, after: &Twist, dt: f64) -> Twist {
        Twist {
            linear: self.mass / dt * (after.linear - before.linear),
            angular: self.spin / dt * (after.angular - before.angular),
        }
    }

    /// Returns the friction in a step of `dt` seconds that begins at `velocity`. All other forces
    /// are assumed equal to `pressed`, the forces of the previous step; `resistance` depends on the
    /// motion.
    pub fn friction(
        &self,
        velocity: &Twist,
        pressed: &Twist,
        dt: f64,
        resistance: impl Fn(&Twist) -> Resistance,
    ) -> Twist {
        let (mut end, mut friction) = (*velocity, Twist::default());
        for _ in 0..ROUNDS {
            let against = resistance(&end);
            end = self.end(velocity, pressed, dt, &against);
            friction = against.against(&end);
        }
        friction
    }

    /// Returns the velocity at the end of the step: (M + dt K) end = M velocity + dt pressed.
    fn end(&self, velocity: &Twist, pressed: &Twist, dt: f64, against: &Resistance) -> Twist {
        let Resistance { sum, first, second } = *against;
        let (sum, first, second) = (self.mass + dt * sum, dt * first, self.spin + dt * second);
        let linear = self.mass * velocity.linear + dt * pressed.linear;
        let angular = self.spin * velocity.angular + dt * pressed.angular;
        let angular =
            (angular - cross(first, linear) / sum) / (second - first.norm_squared() / sum);
        Twist { linear: (linear - angular * perpendicular(first)) / sum, angular }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 240.0;

    /// A block of 2 kg on a single point with a coefficient of friction of 0.4.
    fn point(twist: &Twist) -> Resistance {
        let mut resistance = Resistance::default();
        let sum = 1.0 / twist.linear.norm().max(1e-4);
        resistance.add(
            8.0,
            &Drag { sum, first: Vector::zeros(), second: 1e-3 * sum },
            Vector::zeros(),
        );
        resistance
    }

    #[test]
    fn sliding_objects_have_full_friction_and_nearly_resting_objects_stop() {
        let body = Inertia { mass: 2.0, spin: 0.01 };
        let friction = |speed: f64, pressed: f64| {
            let velocity = Twist { linear: Vector::new(speed, 0.0), angular: 0.0 };
            let pressed = Twist { linear: Vector::new(pressed, 0.0), angular: 0.0 };
            body.friction(&velocity, &pressed, DT, point).linear.x
        };
        assert!((friction(0.2, 0.0) + 8.0).abs() < 0.01, "{}", friction(0.2, 0.0));
        // Pushed along by a tool, and held by less force than friction can supply.
        assert!((friction(0.05, 8.0) + 8.0).abs() < 1e-9);
        assert!((friction(0.0, 3.0) + 3.0).abs() < 0.1, "{}", friction(0.0, 3.0));
        let slow = 0.2 * 4.0 * DT;
        let left = slow + friction(slow, 0.0) * DT / 2.0;
        assert!((0.0..0.1 * slow).contains(&left), "{left} of {slow}");
    }

    #[test]
    fn a_turn_on_the_spot_and_a_slide_resist_each_other_through_an_arm() {
        let mut resistance = Resistance::default();
        let drag = Drag { sum: 2.0, first: Vector::zeros(), second: 0.1 };
        resistance.add(3.0, &drag, Vector::new(0.5, 0.0));
        let twist = Twist { linear: Vector::new(0.0, 1.0), angular: -2.0 };
        // The object's own centre stands still, so only its rotation is resisted.
        let against = resistance.against(&twist);
        assert!(against.linear.norm() < 1e-12 && (against.angular - 0.6).abs() < 1e-12);
    }
}
