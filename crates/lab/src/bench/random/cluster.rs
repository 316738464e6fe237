//! Scenes of close objects, some of them joined.

use std::f64::consts::TAU;

use pushplan::internals::geometry::Vector;
use pushplan::internals::scene::{DisjointSets, JointKind, Ranges, Scene, near_pairs};
use pushplan_learn::dataset::{Crowd, Solids, random_scene};
use rand::Rng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

/// Number of objects of a cluster.
const COUNT: usize = 4;

/// Share of near pairs that are joined, if that closes no loop.
const JOINED: f64 = 0.5;

/// Share of axes along the line of centres; the others have random directions.
const ALONG: f64 = 0.7;

/// Draws a scene in which each object is near another, some of them joined.
pub(super) fn cluster(rng: &mut Pcg64, ranges: &Ranges) -> Scene {
    loop {
        let crowd = Crowd { count: COUNT, solids: Solids::Any, touching: 0.0, polygons: 0.0 };
        let mut scene = random_scene(rng, ranges, crowd);
        let mut near = near_pairs(&scene);
        let mut hang = DisjointSets::new(COUNT);
        near.iter().for_each(|(between, _)| {
            hang.join(*between);
        });
        if (0..COUNT).any(|object| hang.lowest(object) != 0) {
            continue;
        }
        near.shuffle(rng);
        let mut sets = DisjointSets::new(COUNT);
        for (between, midway) in near {
            if !rng.random_bool(JOINED) || !sets.join(between) {
                continue;
            }
            let kind = match rng.random_range(0..3u8) {
                0 => JointKind::Fixed,
                1 => JointKind::Revolute { at: midway, limits: None },
                _ => {
                    let [a, b] = between.map(|k| scene.objects[k].pose.position);
                    let turn = TAU * rng.random::<f64>();
                    let axis = match rng.random_bool(ALONG) {
                        true => b - a,
                        false => Vector::new(turn.cos(), turn.sin()),
                    };
                    JointKind::Prismatic { axis: axis / axis.norm(), limits: None }
                }
            };
            scene = scene.with_joint(between, kind);
        }
        return scene;
    }
}
