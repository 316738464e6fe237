//! Integration of one frame's motions.

use crate::{
    contact::{Bodies, Motion, project_joints},
    scene::{State, Velocity},
    task::FrameStep,
};

/// Remaining free slide below which a body is at rest, metres: far below measurement accuracy, and
/// above the noise of a network around zero.
const REMAINING_SLIDE: f64 = 1e-5;

/// Maximum speed of an object after a frame, relative to the tool's, if no object was faster
/// before. Physics without restoring impacts needs a factor of about one, and the rest is a margin
/// for error. The limit bounds a wrong network and does not affect a right one. Displacements are
/// limited accordingly, plus [`OUT_OF_OVERLAP`], metres.
const FASTER: f64 = 1.5;
/// Corresponding factor for objects with joints, whose far ends can be faster than the tool.
const LEVER: f64 = 5.0;
const OUT_OF_OVERLAP: f64 = 0.005;

/// Moves every object of `state` by its entry in `motions`, which belong to the tool's `step`.
///
/// No output of a network makes an object faster than everything around it, and the total
/// kinetic energy cannot grow while the tool stands still.
pub fn integrate(bodies: &Bodies, state: &mut State, motions: &[Motion], step: &FrameStep) {
    let coasting = step.from == step.to;
    let before = if coasting { kinetic_energy(bodies, state) } else { f64::INFINITY };
    let limit = fastest(bodies, state, motions, step);
    for (k, motion) in motions.iter().enumerate() {
        let body = &bodies.objects[k];
        let pose = &mut state.poses[k];
        let held = held(motion, body.support, limit, limit * step.duration + OUT_OF_OVERLAP);
        pose.position += held.shift;
        pose.heading += held.turn;
        state.velocities[k] = Velocity { linear: held.velocity, angular: held.spin };
        let rim = held.spin * body.support;
        let square = held.velocity.norm_squared() + rim * rim;
        if square < 2.0 * body.deceleration * REMAINING_SLIDE {
            state.velocities[k] = Velocity::default();
        }
    }
    project_joints(bodies, state, |object| motions[object] != Motion::default());
    let after = kinetic_energy(bodies, state);
    if coasting && after > before {
        let share = (before / after).sqrt();
        for velocity in &mut state.velocities {
            velocity.linear *= share;
            velocity.angular *= share;
        }
    }
}

/// Returns the speed limit, m/s: the speed of the fastest object, or, if larger, [`FASTER`] times
/// the speed of the tool's fastest part. A moving object with a joint changes the factor to
/// [`LEVER`].
fn fastest(bodies: &Bodies, state: &State, motions: &[Motion], step: &FrameStep) -> f64 {
    let turn = (step.to.heading - step.from.heading).abs();
    let reach = bodies.parts.iter().map(|p| p.pose.position.norm() + p.footprint.bounding_radius());
    let travel = (step.to.position - step.from.position).norm()
        + if turn > 0.0 { turn * reach.fold(0.0, f64::max) } else { 0.0 };
    let moves = |&k: &usize| motions[k] != Motion::default();
    let levers = bodies.joints.iter().any(|joint| joint.between.iter().any(moves))
        || bodies.mounts.iter().any(|mount| moves(&mount.object));
    let factor = if levers { LEVER } else { FASTER };
    bodies
        .objects
        .iter()
        .zip(&state.velocities)
        .map(|(body, v)| v.linear.norm().max(v.angular.abs() * body.support))
        .fold(factor * travel / step.duration, f64::max)
}

/// Limits `motion` to the given speed (m/s) and travel (m), at the centre and, through the
/// support's length, in rotation.
fn held(motion: &Motion, support: f64, speed: f64, travel: f64) -> Motion {
    let share = |value: f64, most: f64| if value > most { most / value } else { 1.0 };
    let mut held = *motion;
    held.shift *= share(motion.shift.norm(), travel);
    held.turn *= share((motion.turn * support).abs(), travel);
    held.velocity *= share(motion.velocity.norm(), speed);
    held.spin *= share((motion.spin * support).abs(), speed);
    held
}

/// Returns the kinetic energy of all objects, joules.
fn kinetic_energy(bodies: &Bodies, state: &State) -> f64 {
    bodies
        .objects
        .iter()
        .zip(&state.velocities)
        .map(|(body, velocity)| {
            let rim = velocity.angular * body.support;
            0.5 * body.mass * (velocity.linear.norm_squared() + rim * rim / body.spin)
        })
        .sum()
}
