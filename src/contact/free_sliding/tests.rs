//! Tests of `coast`.

use super::*;
use crate::{
    contact::{fall::Fall, index::SceneIndex},
    geometry::{Footprint, Vector},
};

fn body() -> Movable {
    let footprint = Footprint::Disc { radius: 0.05 };
    let support = footprint.mean_radius();
    let spin = (support / footprint.gyration_radius()).powi(2);
    Movable {
        index: SceneIndex(0),
        footprint,
        radius: 0.05,
        support,
        spin,
        fall: Fall::new(spin),
        deceleration: 4.0,
        mass: 1.0,
        friction: 0.4,
        height: 0.1,
        span: (0.0, 0.1),
        carried: 1.0,
        lean: 0.0,
        face_height: 0.0,
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
    for duration in [0.02, 0.05] {
        agrees_with_a_fine_integration(duration, 1e-3);
    }
    // A duration long enough to come to rest.
    agrees_with_a_fine_integration(0.4, 1e-4);
}

fn agrees_with_a_fine_integration(duration: f64, share: f64) {
    let body = body();
    let start = Velocity { linear: Vector::new(0.25, 0.0), angular: 6.0 };
    let (mut v, mut w, mut x, mut a) = (0.25, 6.0 * body.support, 0.0, 0.0);
    let n = 200_000;
    for _ in 0..n {
        let h = duration / n as f64;
        let s = f64::hypot(v, w).max(1e-9);
        x += v * h;
        a += w * h;
        v = (v - h * body.deceleration * v / s).max(0.0);
        w = (w - h * body.deceleration * body.spin * w / s).max(0.0);
    }
    let motion = coast(&body, &start, duration);
    assert!((motion.shift.x - x).abs() < share * x, "{} {x}", motion.shift.x);
    assert!(
        (motion.turn * body.support - a).abs() < share * a,
        "{} {a}",
        motion.turn * body.support
    );
    assert!((motion.velocity.x - v).abs() < share * 0.25, "{} {v}", motion.velocity.x);
}

#[test]
fn nothing_jumps_where_an_object_just_comes_to_rest() {
    let body = body();
    let start = Velocity { linear: Vector::new(0.25, 0.0), angular: 6.0 };
    let time = body.fall.come_to_rest(body.deceleration, 0.25, 6.0 * body.support).time;
    let [before, after] = [0.999, 1.001].map(|share| coast(&body, &start, share * time));
    assert!((before.shift - after.shift).norm() < 1e-3 * after.shift.norm());
    assert!((before.turn - after.turn).abs() < 1e-3 * after.turn);
    assert!(before.velocity.norm() < 0.02 * 0.25, "{}", before.velocity);
}
