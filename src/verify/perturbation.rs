//! Perturbations: small differences between the world and the task, such as errors of a camera or a
//! data sheet.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::{Pose, Vector};
use crate::sim::Simulator;
use crate::{
    scene::{Engine, Object, Rate, Scene, Situation, Tool},
    task::{Goal, Job, Task, ToolMotion},
};

/// Largest shift of an object at the start along each axis, metres.
pub(super) const SHIFT: f64 = 1e-3;

/// Largest rotation of an object at the start, radians (one degree).
pub(super) const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
pub(super) const FRICTION: f64 = 0.1;

/// Uncertainty of the table's edge, metres. In MuJoCo, all objects pushed to 1 and 3 mm from the
/// edge fell, and none at 5 mm.
const EDGE: f64 = 0.004;

/// Uncertainty of the height at which a tool is held, metres.
const HAIR: f64 = 1e-3;

/// Returns the 3-D engine of perturbed replays. Joints need its default step.
pub(super) fn perturbed_spatial(situation: &Situation) -> Simulator {
    let jointed = !(situation.physics.joints.is_empty() && situation.scene.mounts.is_empty());
    let rate = if jointed { Rate::DEFAULT } else { Rate::PERTURBED };
    Simulator::new(Engine::Spatial, rate).retreating()
}

/// Returns the jobs of `motions` in order under one draw of perturbations, uniform within their
/// ranges. The result is deterministic for a seed and a draw.
pub(super) fn perturbed(
    situation: &Situation,
    motions: &[ToolMotion],
    seed: u64,
    draw: usize,
) -> Vec<Job> {
    let mut random = Pcg64::new(u128::from(seed), draw as u128);
    // The first numbers of a new stream resemble those in neighbouring streams.
    let mut random = Pcg64::seed_from_u64(random.random());
    let mut situation = situation.clone();
    // Moving only one side of a joint would violate it.
    let groups = situation.physics.groups(|_| true);
    for first in 0..groups.len() {
        let mut within = |range: f64| random.random_range(-range..=range);
        let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
        let group: Vec<usize> = (0..groups.len()).filter(|&k| groups[k] == first).collect();
        // An object joined to the world stays where its joint holds it.
        if group.iter().all(|&k| situation.scene.mount(k).is_none()) {
            perturb(&mut situation.start.poses, &group, first, shift, turn);
        }
    }
    let physics = Arc::make_mut(&mut situation.physics);
    // Friction factor common to all tools.
    let mut tools = 1.0;
    let own = physics.frictions.iter_mut();
    let pairs = physics.pairs.iter_mut().map(|pair| &mut pair.coefficient);
    for friction in own.chain([&mut physics.table_friction, &mut tools]).chain(pairs) {
        *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
    }
    physics.doubt_supports(&situation.scene, draw);
    physics.push_height = Some(random.random_range(0.0..=1.0));
    let job = |motion: &ToolMotion| {
        let tool = Tool::clone(&motion.tool).friction(tools * motion.tool.friction);
        Job::new(&situation, ToolMotion { tool: Arc::new(tool), ..motion.clone() })
    };
    motions.iter().map(job).collect()
}

/// Shifts a group and rotates it about its object `first`, limited so that no object moves by more
/// than [`SHIFT`] through the rotation.
fn perturb(poses: &mut [Pose], group: &[usize], first: usize, shift: Vector, turn: f64) {
    let about = poses[first].position;
    let reach = group.iter().map(|&k| (poses[k].position - about).norm()).fold(0.0, f64::max);
    let turn = if reach * TURN > SHIFT { turn * SHIFT / (reach * TURN) } else { turn };
    let turned = Pose { position: about + shift, heading: turn };
    for &k in group {
        let arm = Pose { position: poses[k].position - about, ..poses[k] };
        poses[k] = turned * arm;
    }
}

/// Returns the scene of perturbed replays: an object within the edge's uncertainty falls, unless a
/// goal requires a fall.
pub(super) fn wary(task: &Task, scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let falls = task.goals.iter().any(Goal::falls);
    if let Some(top) = scene.table_top.as_mut().filter(|_| !falls) {
        top.size = top.size.map(|extent| (extent - 2.0 * EDGE).max(0.0));
    }
    scene
}

/// Returns the motion with the tool held slightly higher, if that changes which objects it meets.
pub(super) fn lifted(scene: &Scene, motion: ToolMotion) -> ToolMotion {
    let more = if misses_by_a_hair(scene, &motion) { HAIR } else { 0.0 };
    ToolMotion { lift: motion.lift + more, ..motion }
}

/// Returns `true` if a tool held slightly higher passes over an object that it meets as planned, or
/// meets one that it passes below.
fn misses_by_a_hair(scene: &Scene, motion: &ToolMotion) -> bool {
    let heights = || motion.tool.parts().iter().map(|part| part.shape.height());
    let meets = |object: &Object, height: f64, more: f64| {
        let lift = motion.lift + more;
        object.meets([lift, lift + height])
    };
    scene.objects.iter().any(|object| {
        heights().any(|height| meets(object, height, 0.0) != meets(object, height, HAIR))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{JointKind, Object, Part, Scene};

    #[test]
    fn a_jointed_group_is_perturbed_as_one_piece_and_by_little() {
        let object =
            |k: usize| Object::cylinder(format!("o{k}"), 0.05, 0.1).at(0.12 * k as f64, 0.0, 0.2);
        let scene = Scene::new((0..5).map(object))
            .with_joint([3, 1], JointKind::Fixed)
            .with_joint([3, 4], JointKind::Fixed);
        let part = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::default());
        let tool = Tool::new("bar", [part]).unwrap();
        let situation = Situation::stated(&scene);
        for draw in 0..20 {
            let motion =
                ToolMotion { tool: Arc::new(tool.clone()), lift: 0.0, strokes: Vec::new() };
            let start = perturbed(&situation, &[motion], 1, draw).remove(0).start;
            let relative = |poses: &[Pose], k: usize| poses[1].inverse() * poses[k];
            let stated: Vec<Pose> = scene.objects.iter().map(|object| object.pose).collect();
            for k in [3, 4] {
                let (now, before) = (relative(&start.poses, k), relative(&stated, k));
                assert!((now.position - before.position).norm() < 1e-12);
                assert!((now.heading - before.heading).abs() < 1e-12);
            }
            for (pose, stated) in start.poses.iter().zip(&stated) {
                let moved = (pose.position - stated.position).norm();
                assert!(moved > 0.0 && moved < 3.0 * SHIFT, "{moved}");
            }
        }
    }
}
