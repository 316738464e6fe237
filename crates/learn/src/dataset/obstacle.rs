//! Obstacles in the path of a pushed object, but not of the tool.

use pushplan::internals::geometry::{
    Footprint, Pose, Vector, clearance, perpendicular, swept_clearance,
};
use pushplan::internals::{
    outcome::Frame,
    scene::{Obstacle, Scene, Span},
    task::ToolMotion,
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::distributions::{heading, log_uniform, sign, uniform};

/// Range of an obstacle's horizontal sides, metres.
const SIDE: Span = Span::new(0.03, 0.30);

/// Minimum distance of obstacles from all bodies at the start and from the tool's path, metres.
const FREE: f64 = 2e-3;

/// Maximum number of attempts to place an obstacle.
const TRIES: usize = 20;

/// Draws a fixed cuboid beside the path of an object that moves in `frames` (recorded without it).
///
/// The cuboid usually reaches into the path. It is clear of the tool's whole motion and of every
/// object's start.
pub(super) fn place_obstacle(
    rng: &mut Pcg64,
    scene: &Scene,
    motion: &ToolMotion,
    frames: &[Frame],
) -> Option<Obstacle> {
    let (first, last) = (frames.first()?, frames.last()?);
    let travel = |index: usize| {
        (last.state.poses[index].position - first.state.poses[index].position).norm()
    };
    let moved: Vec<usize> = (0..scene.objects.len()).filter(|&i| travel(i) > 0.01).collect();
    if moved.is_empty() {
        return None;
    }
    (0..TRIES).find_map(|_| {
        let object = moved[rng.random_range(0..moved.len())];
        let at = frames[rng.random_range(0..frames.len())].state.poses[object];
        let way =
            (last.state.poses[object].position - first.state.poses[object].position).normalize();
        let size = [log_uniform(rng, SIDE), log_uniform(rng, SIDE), uniform(rng, 0.05, 0.15)];
        let half = Vector::new(size[0] / 2.0, size[1] / 2.0);
        let footprint = Footprint::Rectangle { half };
        let turned = Pose::new(0.0, 0.0, heading(rng));
        let body = scene.objects[object].shape.footprint();
        // Beside the path or across it, from just clear to well inside.
        let towards = if rng.random_bool(0.6) { perpendicular(way) * sign(rng) } else { way };
        let apart = footprint.extent(turned.local_vector(towards))
            + body.extent(at.local_vector(towards))
            + uniform(rng, -0.03, 0.005);
        let pose = Pose { position: at.position + towards * apart, heading: turned.heading };

        let clear = scene.objects.iter().all(|other| {
            clearance((&footprint, &pose), (&other.shape.footprint(), &other.pose), 0.01) >= FREE
        }) && scene.obstacles.iter().all(|other| {
            clearance((&footprint, &pose), (&other.shape().footprint(), &other.pose), 0.01) >= FREE
        }) && motion.strokes.iter().all(|stroke| {
            motion.tool.parts().iter().all(|part| {
                let (from, to) = (stroke.from * part.pose, stroke.to * part.pose);
                swept_clearance(&part.footprint(), &from, &to, (&footprint, &pose), 0.01) >= FREE
            })
        });
        clear.then(|| Obstacle {
            name: format!("obstacle-{}", scene.obstacles.len() + 1),
            size,
            pose,
            z: 0.0,
            friction: uniform(rng, 0.1, 1.0),
        })
    })
}
