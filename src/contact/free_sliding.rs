//! Free sliding: the motion of an object without contacts.
//!
//! The support is the ellipsoidal limit surface with even pressure (Goyal, Ruina and Papadopoulos
//! 1991; Lynch and Howe 1992): dv/dt = -mu g v / s and d(c omega)/dt = -mu g (c / rho)^2 c omega /
//! s with s^2 = |v|^2 + (c omega)^2. Without rotation the object travels v^2 / (2 mu g) in a
//! straight line. With rotation the two speeds decrease together: by d(ln c omega) = k d(ln v) with
//! k = (c / rho)^2 they are v = v0 u and c omega = c omega0 u^k. Here u decreases from one to zero
//! and mu g dt = -s du / u. An object that comes to rest within the frame is computed by integrals
//! over all of u, and any other piece by piece.

use crate::scene::Velocity;
use pushplan_kernel::Motion;

use super::bodies::Movable;

/// Maximum number of pieces of a frame for an object that slides and rotates throughout.
const PIECES: usize = 12;

/// Share of its speed that an object loses in one piece. Together with [`PIECES`] this keeps the
/// distance within 0.1 % of the result with a thousand pieces.
const SHARE: f64 = 0.3;

/// Returns the motion of a free object during `duration` seconds.
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
    let rest = body.fall.come_to_rest(body.deceleration, speed, spin);
    if rest.time <= duration {
        let (shift, turn) = (direction * rest.travel, rest.turn / body.support);
        return Motion { shift, turn, ..Motion::default() };
    }
    let (mut v, mut w) = (speed, spin);
    let (mut travel, mut turn) = (0.0, 0.0);
    let mut left = duration;
    for piece in 0..PIECES {
        let s = (v * v + w * w).sqrt();
        if s < 1e-9 || left <= 0.0 {
            break;
        }
        // The last piece extends to the end, with its initial shares of both speeds.
        let most = if piece + 1 < PIECES { SHARE * s / body.deceleration } else { left };
        let step = left.min(most);
        let half = 0.5 * step.min(SHARE * s / body.deceleration) * body.deceleration;
        // Midpoint rule: the share of each speed in the friction is taken at the middle of the
        // piece.
        let (v_half, w_half) = (v - half * v / s, w - half * body.spin * w / s);
        let s_half = (v_half * v_half + w_half * w_half).sqrt();
        let slow_v = body.deceleration * v_half / s_half;
        let slow_w = body.deceleration * body.spin * w_half.abs() / s_half;
        let (moved, v_next) = slide(v, slow_v, step);
        let (turned, w_next) = slide(w.abs(), slow_w, step);
        travel += moved;
        turn += turned * w.signum();
        (v, w) = (v_next, w_next * w.signum());
        left -= step;
    }
    Motion {
        shift: direction * travel,
        turn: turn / body.support,
        velocity: direction * v,
        spin: w / body.support,
    }
}

/// Returns the distance and remaining speed after `duration` seconds of constant deceleration.
fn slide(speed: f64, deceleration: f64, duration: f64) -> (f64, f64) {
    let left = (speed - deceleration * duration).max(0.0);
    (slid(speed, left, duration, deceleration), left)
}

/// Returns the distance during deceleration from `from` to `to`: over the whole `step`, or less if
/// the body stops.
fn slid(from: f64, to: f64, step: f64, deceleration: f64) -> f64 {
    if to > 0.0 || deceleration <= 0.0 {
        0.5 * (from + to) * step
    } else {
        (from * from / (2.0 * deceleration)).min(0.5 * from * step)
    }
}

#[cfg(test)]
mod tests;
