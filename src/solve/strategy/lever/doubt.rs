//! Perturbations used by the planner for candidates, independent of the perturbations of
//! verification.

use std::sync::Arc;

use crate::geometry::Vector;
use crate::scene::Situation;

/// Shift of the scene along each axis, metres.
const SHIFT: f64 = 0.5e-3;

/// Rotation of the scene, radians.
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Relative change of frictions.
const FRICTION: f64 = 0.1;

/// Signs of the shifts, rotation and change of friction; consecutive draws differ in at least two.
const SIGNS: [[f64; 4]; 8] = [
    [1.0, 1.0, 1.0, 1.0],
    [-1.0, -1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0, -1.0],
    [-1.0, -1.0, 1.0, 1.0],
    [1.0, -1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0, 1.0],
];

/// Returns the perturbed situation, with the scene moved as one body about the levered object, and
/// the friction of the blade.
pub(super) fn doubted(
    situation: &Situation,
    plate: usize,
    (blade, draw): (f64, usize),
) -> (Situation, f64) {
    let [x, y, turn, friction] = SIGNS[draw % SIGNS.len()];
    let about = situation.scene.objects[plate].pose.position;
    let shift = Vector::new(x * SHIFT, y * SHIFT);
    let mut situation = situation.moved_as_one(about, shift, turn * TURN);
    let factor = 1.0 + friction * FRICTION;
    let scene = Arc::make_mut(&mut situation.scene);
    scene.obstacles.iter_mut().for_each(|obstacle| obstacle.friction *= factor);
    let physics = Arc::make_mut(&mut situation.physics);
    physics.frictions.iter_mut().for_each(|own| *own *= factor);
    (situation, blade * factor)
}
