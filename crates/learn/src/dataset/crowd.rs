//! Objects of a crowd: up to twelve, placed one after another.

use pushplan::internals::geometry::{Footprint, Pose};
use pushplan::internals::scene::{Object, Ranges, Scene};
use rand::Rng;
use rand_pcg::Pcg64;

use super::curriculum::Block;
use super::distributions::{log_uniform, uniform};
use super::tabletop::{Solids, mass_span, random_shape};
use super::unseen::{draw_supports, push_height};

/// Draws the number of objects.
pub(super) fn object_count(rng: &mut Pcg64, ranges: &Ranges) -> usize {
    rng.random_range(ranges.objects.low as usize..=ranges.objects.high as usize)
}

/// Draws a table with `count` objects; `place` returns the pose of each, given the objects before
/// it.
pub(super) fn crowd(
    rng: &mut Pcg64,
    ranges: &Ranges,
    block: &Block,
    count: usize,
    mut place: impl FnMut(&mut Pcg64, &[Object], &Footprint) -> Pose,
) -> Scene {
    let friction = |rng: &mut Pcg64| uniform(rng, ranges.friction.low, ranges.friction.high);
    let (_, masses) = mass_span(rng, ranges);
    let mut scene = Scene::new([]).on_table(friction(rng));
    for index in 0..count {
        let cylinder = rng.random_bool(block.cylinders);
        let solids = if cylinder { Solids::Cylinders } else { Solids::Cuboids };
        let shape = random_shape(rng, ranges, solids);
        let pose = place(rng, &scene.objects, &shape.footprint());
        scene.objects.push(Object {
            mass: log_uniform(rng, masses),
            friction: friction(rng),
            pose,
            ..Object::new(format!("object-{}", index + 1), shape)
        });
    }
    draw_supports(rng, &mut scene);
    scene.push_height = Some(push_height(rng));
    scene
}
