//! Small errors under which the planner looks at its candidates; verification has its own.

use std::sync::Arc;

use crate::geometry::Vector;
use crate::scene::Situation;

/// Shift along each axis (metres), turn (radians) and relative change of frictions, in signs of
/// which neighbours differ in two at least.
const SHIFT: f64 = 0.5e-3;
const TURN: f64 = std::f64::consts::PI / 180.0;
const FRICTION: f64 = 0.1;
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

/// The situation as it may be instead, everything moved as one about the object that is levered, and the
/// friction value of the blade.
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
