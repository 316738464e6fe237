//! Small differences between the world and the task as written, for plans that are replayed in space.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::{Pose, Vector};
use crate::scene::LeverScene;

/// Largest shift of everything that is seen against where the blade goes, along each axis, metres.
const SHIFT: f64 = 0.5e-3;

/// Largest turn of it, about the object, radians (one degree).
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
const FRICTION: f64 = 0.1;

/// The scene as it really is: all of it a little aside of where it was seen, rubbing a little
/// otherwise. What lies in a pocket lies aside with its pocket.
pub(super) fn disturbed(scene: &LeverScene, about: usize, seed: u64, draw: usize) -> LeverScene {
    let mut random = Pcg64::new(u128::from(seed), draw as u128);
    // A fresh stream's first numbers resemble those of its neighbours.
    let mut random = Pcg64::seed_from_u64(random.random());
    let mut within = |range: f64| random.random_range(-range..=range);
    let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
    let about = scene.plates[about].pose.position;
    let moved = |pose: &mut Pose| {
        let arm = Pose { position: pose.position - about, ..*pose };
        *pose = Pose { position: about + shift, heading: turn } * arm;
    };
    let mut scene = scene.clone();
    scene.plates.iter_mut().for_each(|plate| moved(&mut plate.pose));
    scene.blocks.iter_mut().for_each(|block| moved(&mut block.pose));
    let own = scene.plates.iter_mut().map(|plate| &mut plate.friction);
    let fixed = scene.blocks.iter_mut().map(|block| &mut block.friction);
    let others = [&mut scene.table_friction, &mut scene.blade.friction];
    for friction in own.chain(fixed).chain(others) {
        *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
    }
    scene
}
