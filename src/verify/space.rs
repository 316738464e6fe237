//! Perturbations of plans that are replayed in 3-D: small differences between the world and the
//! task.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::Vector;
use crate::scene::{Situation, Tool};
use crate::task::Motion;

/// Largest shift of the observed scene relative to the blade along each axis, metres.
const SHIFT: f64 = 0.5e-3;

/// Largest rotation of the scene about the object, radians (one degree).
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
const FRICTION: f64 = 0.1;

/// Returns the perturbed situation: the whole scene is slightly displaced from its observed pose
/// and all frictions differ slightly, also for the blades of `motions`. Objects in pockets move
/// together with their pockets.
pub(super) fn perturbed(
    situation: &Situation,
    motions: &mut [Motion],
    about: usize,
    (seed, draw): (u64, usize),
) -> Situation {
    let mut random = Pcg64::new(u128::from(seed), draw as u128);
    // The first numbers of a new stream resemble those in neighbouring streams.
    let mut random = Pcg64::seed_from_u64(random.random());
    let mut within = |range: f64| random.random_range(-range..=range);
    let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
    let about = situation.scene.objects[about].pose.position;
    let mut really = situation.moved_as_one(about, shift, turn);
    let mut rub = |friction: &mut f64| {
        *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
    };
    let scene = Arc::make_mut(&mut really.scene);
    let physics = Arc::make_mut(&mut really.physics);
    for (thing, _) in situation.scene.things() {
        let mut factor = 1.0;
        rub(&mut factor);
        let solids = scene.parts_of(thing).chain([thing]);
        solids.for_each(|solid| physics.frictions[solid] *= factor);
    }
    scene.obstacles.iter_mut().for_each(|obstacle| rub(&mut obstacle.friction));
    rub(&mut physics.table_friction);
    // Friction factor common to all blades.
    let mut blades = 1.0;
    rub(&mut blades);
    for motion in motions.iter_mut().filter(|motion| motion.is_lever()) {
        let hand = motion.slide_mut();
        let tool = Tool::clone(&hand.tool);
        let friction = blades * tool.friction;
        hand.tool = Arc::new(tool.friction(friction));
    }
    physics.pairs.iter_mut().for_each(|pair| rub(&mut pair.coefficient));
    really
}
