//! Free sliding: what an object does that nothing touches.
//!
//! The support is the ellipsoidal limit surface with even pressure (Goyal, Ruina and
//! Papadopoulos 1991; Lynch and Howe 1992): dv/dt = -mu g v / s and
//! d(c omega)/dt = -mu g (c / rho)^2 c omega / s with s^2 = |v|^2 + (c omega)^2. Without spin
//! that is v^2 / (2 mu g) of travel in a straight line; with spin it is integrated.

use crate::scene::Velocity;

use super::bodies::{Motion, Movable};

/// Pieces that a frame is cut into while an object slides and spins. Eight keep the distance
/// within 0.1 % of a thousand pieces.
const PIECES: usize = 8;

/// The motion of a free object during `duration` seconds.
pub fn coast(body: &Movable, velocity: &Velocity, duration: f64) -> Motion {
    let speed = velocity.linear.norm();
    let spin = velocity.angular * body.support;
    if speed == 0.0 && spin == 0.0 {
        return Motion::default();
    }
    if spin == 0.0 {
        let (share, left) = slide(speed, body.deceleration, duration);
        return Motion {
            shift: velocity.linear / speed * share,
            velocity: velocity.linear * (left / speed),
            ..Motion::default()
        };
    }
    // The direction of travel never changes; only the two speeds do.
    let direction = if speed > 0.0 { velocity.linear / speed } else { velocity.linear };
    let (mut v, mut w) = (speed, spin);
    let (mut travel, mut turn) = (0.0, 0.0);
    let mut left = duration;
    for piece in 0..PIECES {
        let step = left / (PIECES - piece) as f64;
        let s = v.hypot(w);
        if s < 1e-9 {
            break;
        }
        // Midpoint rule: the share of each speed in the friction is taken half a piece on.
        let braking = step * body.deceleration;
        let v_half = v - 0.5 * braking * v / s;
        let w_half = w - 0.5 * braking * body.spin * w / s;
        let s_half = v_half.hypot(w_half).max(1e-9);
        let (slow_v, slow_w) = (v_half / s_half, body.spin * w_half.abs() / s_half);
        let v_next = (v - braking * slow_v.max(0.0)).max(0.0);
        let w_next = (w.abs() - braking * slow_w).max(0.0) * w.signum();
        travel += slid(v, v_next, step, body.deceleration * slow_v.max(0.0));
        turn += w.signum() * slid(w.abs(), w_next.abs(), step, body.deceleration * slow_w);
        (v, w) = (v_next, w_next);
        left -= step;
    }
    Motion {
        shift: direction * travel,
        turn: turn / body.support,
        velocity: direction * v,
        spin: w / body.support,
    }
}

/// Distance and remaining speed after `duration` seconds of steady deceleration.
fn slide(speed: f64, deceleration: f64, duration: f64) -> (f64, f64) {
    let left = (speed - deceleration * duration).max(0.0);
    (slid(speed, left, duration, deceleration), left)
}

/// Distance covered while slowing from `from` to `to`: the whole `step`, or less if it stops.
fn slid(from: f64, to: f64, step: f64, deceleration: f64) -> f64 {
    if to > 0.0 || deceleration <= 0.0 {
        0.5 * (from + to) * step
    } else {
        (from * from / (2.0 * deceleration)).min(0.5 * from * step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Footprint, Vector};

    fn body() -> Movable {
        let footprint = Footprint::Disc { radius: 0.05 };
        let support = footprint.mean_radius();
        Movable {
            footprint,
            radius: 0.05,
            support,
            spin: (support / footprint.gyration_radius()).powi(2),
            deceleration: 4.0,
            mass: 1.0,
            friction: 0.4,
            height: 0.1,
        }
    }

    #[test]
    fn without_spin_it_slides_v_squared_over_two_mu_g() {
        let velocity = Velocity { linear: Vector::new(0.3, -0.4), angular: 0.0 };
        let motion = coast(&body(), &velocity, 1.0);
        assert!((motion.shift - Vector::new(0.6, -0.8) * (0.25 / 8.0)).norm() < 1e-12);
        assert_eq!(motion.velocity, Vector::zeros());
    }

    #[test]
    fn with_spin_it_agrees_with_a_fine_integration() {
        let body = body();
        let start = Velocity { linear: Vector::new(0.25, 0.0), angular: 6.0 };
        let duration = 0.05;
        let (mut v, mut w, mut x, mut a) = (0.25, 6.0 * body.support, 0.0, 0.0);
        let n = 200_000;
        for _ in 0..n {
            let h = duration / n as f64;
            let s = f64::hypot(v, w);
            x += v * h;
            a += w * h;
            v -= h * body.deceleration * v / s;
            w -= h * body.deceleration * body.spin * w / s;
        }
        let motion = coast(&body, &start, duration);
        assert!((motion.shift.x - x).abs() < 1e-3 * x, "{} {x}", motion.shift.x);
        assert!((motion.turn * body.support - a).abs() < 1e-3 * a);
        assert!((motion.velocity.x - v).abs() < 2e-3 * 0.25, "{} {v}", motion.velocity.x);
    }
}
