//! Random joints between near neighbours.

use pushplan::internals::geometry::Vector;
use pushplan::internals::scene::{Joint, JointKind, Scene, Span, near_pairs};
use rand::Rng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use super::curriculum::Block;
use super::distributions::{heading, uniform, weighted};

/// Share of revolute anchors midway between the closest points of the objects, and of prismatic
/// axes along the line of centres.
const REGULAR: f64 = 0.7;

/// Share of revolute and prismatic joints with limits.
const LIMITED: f64 = 0.3;

/// Range of a revolute joint's limits on either side, radians.
const TURN: Span = Span::new(0.1, 1.0);

/// Range of a prismatic joint's limits on either side, metres.
const SHIFT: Span = Span::new(0.02, 0.15);

/// Joins near neighbours of a scene without closing a loop.
///
/// The joints form a forest; a group has at most twelve objects because a scene has at most twelve.
pub(super) fn join_neighbours(rng: &mut Pcg64, scene: &mut Scene, block: &Block) {
    let mut pairs = near_pairs(scene);
    pairs.shuffle(rng);
    let mut group: Vec<usize> = (0..scene.objects.len()).collect();
    for ([a, b], between) in pairs {
        if !rng.random_bool(block.joined) || group[a] == group[b] {
            continue;
        }
        let (kept, gone) = (group[a], group[b]);
        group.iter_mut().filter(|g| **g == gone).for_each(|g| *g = kept);
        let kind = random_kind(rng, scene, [a, b], between, &block.kinds);
        let between = if rng.random::<bool>() { [a, b] } else { [b, a] };
        scene.joints.push(Joint::new(between, kind));
    }
}

fn random_kind(
    rng: &mut Pcg64,
    scene: &Scene,
    ends: [usize; 2],
    midway: Vector,
    kinds: &[f64; 3],
) -> JointKind {
    let objects = ends.map(|end| &scene.objects[end]);
    match weighted(rng, kinds) {
        0 => JointKind::Fixed,
        1 => {
            let reach = objects
                .map(|object| object.shape.footprint().bounding_radius())
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            let (turn, far) = (heading(rng), reach * rng.random::<f64>().sqrt());
            let off = Vector::new(turn.cos(), turn.sin()) * far;
            let at = if rng.random_bool(REGULAR) { midway } else { midway + off };
            JointKind::Revolute { at, limits: limits(rng, TURN) }
        }
        _ => {
            let line = objects[1].pose.position - objects[0].pose.position;
            let turn = heading(rng);
            let axis = if rng.random_bool(REGULAR) {
                line.normalize()
            } else {
                Vector::new(turn.cos(), turn.sin())
            };
            JointKind::Prismatic { axis, limits: limits(rng, SHIFT) }
        }
    }
}

/// Draws limits around zero, or none in most cases.
fn limits(rng: &mut Pcg64, span: Span) -> Option<Span> {
    let (low, high) = (uniform(rng, span.low, span.high), uniform(rng, span.low, span.high));
    rng.random_bool(LIMITED).then_some(Span::new(-low, high))
}
