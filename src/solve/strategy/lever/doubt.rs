//! Small errors under which the planner looks at its candidates; verification has its own.

use crate::geometry::{Pose, Vector};
use crate::scene::LeverScene;

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

/// The scene as it may be instead, everything moved as one about the plate that is levered.
pub(super) fn doubted(scene: &LeverScene, plate: usize, draw: usize) -> LeverScene {
    let [x, y, turn, friction] = SIGNS[draw % SIGNS.len()];
    let about = scene.plates[plate].pose.position;
    let shift = Vector::new(x * SHIFT, y * SHIFT);
    let moved = |pose: &mut Pose| {
        let arm = Pose { position: pose.position - about, ..*pose };
        *pose = Pose { position: about + shift, heading: turn * TURN } * arm;
    };
    let mut scene = scene.clone();
    let factor = 1.0 + friction * FRICTION;
    for plate in &mut scene.plates {
        moved(&mut plate.pose);
        plate.friction *= factor;
    }
    for block in &mut scene.blocks {
        moved(&mut block.pose);
        block.friction *= factor;
    }
    scene.blade.friction *= factor;
    scene
}
