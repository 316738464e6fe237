//! Applying one frame's motions to a state.

use crate::{
    graph::{Bodies, Motion},
    scene::{State, Velocity},
};

/// A body whose remaining free slide is shorter than this is at rest, metres: far below what
/// anyone can measure, and above the noise of a network around zero.
const REMAINING_SLIDE: f64 = 1e-5;

/// Moves every object of `state` by its entry in `motions`. While the tool stands still
/// (`coasting`) the total kinetic energy cannot grow, whatever a network says.
pub fn integrate(bodies: &Bodies, state: &mut State, motions: &[Motion], coasting: bool) {
    let before = if coasting { kinetic_energy(bodies, state) } else { f64::INFINITY };
    for (k, motion) in motions.iter().enumerate() {
        let body = &bodies.objects[k];
        let pose = &mut state.poses[k];
        pose.position += motion.shift;
        pose.heading += motion.turn;
        state.velocities[k] = Velocity { linear: motion.velocity, angular: motion.spin };
        let rim = motion.spin * body.support;
        let square = motion.velocity.norm_squared() + rim * rim;
        if square < 2.0 * body.deceleration * REMAINING_SLIDE {
            state.velocities[k] = Velocity::default();
        }
    }
    let after = kinetic_energy(bodies, state);
    if coasting && after > before {
        let share = (before / after).sqrt();
        for velocity in &mut state.velocities {
            velocity.linear *= share;
            velocity.angular *= share;
        }
    }
}

/// Of all objects, joules.
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
