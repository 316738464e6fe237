//! Sensitivity of the end of a rollout to a change of the network's last layer.
//!
//! The output of a frame is linear in the last layer, so its effect on the poses in that frame is
//! exact. The propagation of such a change to the end, including changed contacts, is computed by
//! rollouts of the remaining motion from slightly perturbed poses. With the hidden row z, the poses
//! p after frame t and the final poses e,
//!
//! ```text
//! de/dθ = Σ_t  de/dp_t · dp_t/do_t · z_t         o = z (W + θ), the outputs that a head changes
//! ```

use pushplan::{
    effect::{EffectModel, Network, without_guesses},
    graph::{Batch, Correction, Node, UNIT},
    network::{Buffers, HEAD_OUTPUTS, Head},
    outcome::{Frame, Record, Trajectory},
    rollout::{RollSettings, Roller},
    scene::{Scene, State, Velocity},
    task::{COAST_FRAME, Job, Stroke},
};

/// Perturbation of the poses for finite differences, metres (rotations at the radius of gyration).
///
/// The value is above the width of a contact and below the accuracy of recordings.
const NUDGE: f64 = 2e-4;

/// Rollout with the sensitivity of its end to a change of the last layer.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    /// Rollout, frame by frame.
    pub trajectory: Trajectory,
    /// Jacobian of x, y and heading of all objects at the end, [3 N, 6 h]: metres and radians per
    /// parameter of a [`Head`].
    pub rows: Vec<Vec<f64>>,
}

/// Node of a frame: its object, the change of x, y and heading per head output, and its hidden row.
struct Read {
    object: usize,
    change: [[f64; HEAD_OUTPUTS]; 3],
    /// Hidden row, [2, h].
    hidden: Vec<f32>,
}

impl Sensitivity {
    /// Computes the sensitivity of the end of `job` to the last layer of `network`. The stride is
    /// one frame, independent of the model's stride.
    pub fn of(network: &Network, scene: &Scene, job: &Job) -> Self {
        let job = without_guesses(job);
        let half = network.effect_width();
        let mut buffers = Buffers::default();
        let mut frames: Vec<Vec<Read>> = Vec::new();
        let mut correct = |batch: &Batch, corrections: &mut Vec<Correction>| {
            network.forward().run(batch, &mut buffers, corrections);
            frames.push(nodes(batch, buffers.hidden(), half));
        };
        // Without pruning, nodes have the indices of the scene.
        let settings = RollSettings { stride: 1, pruned: false, ..network.settings() };
        let mut roller = Roller::new(network.spec().clone(), settings);
        let rolled =
            roller.roll(scene, std::slice::from_ref(&job), Record::Frames, Some(&mut correct));
        let trajectory =
            rolled.into_iter().next().unwrap_or_else(|| Trajectory::new(network.spec().clone()));
        let mut rows = vec![vec![0.0; Head::len_of(half)]; 3 * scene.objects.len()];
        for (end, node) in ends(network, (scene, &job), &trajectory, &frames) {
            for (row, end) in rows.iter_mut().zip(&end) {
                for (output, part) in row.chunks_exact_mut(2 * half).enumerate() {
                    let gain: f64 = (0..3).map(|axis| end[axis] * node.change[axis][output]).sum();
                    for (value, hidden) in part.iter_mut().zip(&node.hidden) {
                        *value += gain * f64::from(*hidden);
                    }
                }
            }
        }
        Self { trajectory, rows }
    }
}

/// Returns the Jacobian of all final poses, [3 N], with respect to the pose of every node in every
/// frame.
fn ends<'a>(
    network: &Network,
    (scene, job): (&Scene, &Job),
    trajectory: &Trajectory,
    frames: &'a [Vec<Read>],
) -> Vec<(Vec<[f64; 3]>, &'a Read)> {
    let mut jobs = Vec::new();
    let mut nodes = Vec::new();
    let mut stroke_frames = (0, 0);
    for (after, read) in trajectory.frames.iter().skip(1).zip(frames) {
        stroke_frames = match stroke_frames {
            (stroke, count) if stroke == after.stroke => (stroke, count + 1),
            _ => (after.stroke, 1),
        };
        let rest = rest_of(job, after, stroke_frames.1);
        for node in read {
            let first = jobs.len();
            if let Some(rest) = &rest {
                for axis in 0..3 {
                    for sign in [1.0, -1.0] {
                        let mut job = rest.clone();
                        nudge(&mut job.start, node.object, axis, sign * size(scene, node, axis));
                        jobs.push(job);
                    }
                }
            }
            nodes.push((node, rest.is_some().then_some(first)));
        }
    }
    let ended = network.rollout(scene, &jobs, Record::Outcome);
    let follows = |(node, first): (&'a Read, Option<usize>)| {
        let mut end = vec![[0.0; 3]; 3 * scene.objects.len()];
        let Some(first) = first else {
            (0..3).for_each(|axis| end[3 * node.object + axis][axis] = 1.0);
            return (end, node);
        };
        for axis in 0..3 {
            let [plus, minus] = [0, 1].map(|side| ended[first + 2 * axis + side].outcome());
            let apart = 2.0 * size(scene, node, axis);
            for (object, (plus, minus)) in plus.poses.iter().zip(&minus.poses).enumerate() {
                let moved = plus.position - minus.position;
                let moved = [moved.x, moved.y, plus.heading - minus.heading];
                (0..3).for_each(|k| end[3 * object + k][axis] = moved[k] / apart);
            }
        }
        (end, node)
    };
    nodes.into_iter().map(follows).collect()
}

/// Returns the nodes of a frame, whose hidden rows are [2, N, h].
fn nodes(batch: &Batch, hidden: &[f32], half: usize) -> Vec<Read> {
    let count = batch.node_count();
    let read = |(k, node): (usize, &Node)| {
        let half_of = |parity: usize| {
            let from = (parity * count + k) * half;
            &hidden[from..from + half]
        };
        let (x, y) = (node.axis.x * UNIT, node.axis.y * UNIT);
        let change = [[x, -y, 0.0], [y, x, 0.0], [0.0, 0.0, UNIT / node.support]];
        Read { object: node.object.0, change, hidden: [half_of(0), half_of(1)].concat() }
    };
    batch.nodes.iter().enumerate().map(read).collect()
}

/// Returns the rest of `job` after frame `count` of the current stroke; `None` at its end.
fn rest_of(job: &Job, after: &Frame, count: usize) -> Option<Job> {
    let mut rest = Job { start: after.state.clone(), ..job.clone() };
    let strokes = &mut rest.motion.slide_mut().strokes;
    strokes.drain(..after.stroke);
    let stroke = *strokes.first()?;
    let moving = stroke.frames();
    if count < moving {
        let step = stroke.frames_from(count, moving - count);
        strokes[0] = Stroke { from: step.from, duration: step.duration, ..stroke };
    } else if stroke.settle && after.state.velocities.iter().any(|v| *v != Velocity::default()) {
        strokes[0] = Stroke { from: stroke.to, duration: COAST_FRAME, ..stroke };
    } else {
        strokes.remove(0);
    }
    (!strokes.is_empty()).then_some(rest)
}

/// Returns the perturbation of a node's object along a pose axis, metres or radians.
fn size(scene: &Scene, node: &Read, axis: usize) -> f64 {
    let arm = scene.objects[node.object].shape.footprint().gyration_radius();
    if axis < 2 { NUDGE } else { NUDGE / arm }
}

fn nudge(state: &mut State, object: usize, axis: usize, by: f64) {
    let pose = &mut state.poses[object];
    match axis {
        0 => pose.position.x += by,
        1 => pose.position.y += by,
        _ => pose.heading += by,
    }
}
