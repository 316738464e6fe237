//! Whole pushes as training examples: analytic rollouts, the graphs that the network reads, and the
//! changes that lead to the true poses.
//!
//! States and features of a rollout do not depend on the weights, because corrections are not fed
//! back. They are therefore computed once.

use std::ops::Range;
use std::sync::Arc;

use pushplan::internals::geometry::wrap_angle;
use pushplan::internals::graph::{
    Batch, GIVEN, GIVEN_EVEN, GIVEN_ODD, NOBODY, NODE_EVEN, READOUTS,
};
use pushplan::internals::rollout::{Read, RollSettings, Roller};
use pushplan::internals::{
    outcome::Record,
    scene::{CORRECTED, ModelKind, State, Support},
    task::Job,
};
use rand::Rng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::dataset::{Dataset, Episode, Truth};

/// Weight of a pose in the middle of a push, relative to its final pose.
const MIDWAY: f32 = 0.5;

/// Weight of headings. The heading of a cylinder is unobservable.
const TURN: f32 = 0.5;
const CYLINDER: f32 = 0.05;

/// Share of pushes with the size and form of another push's tool.
///
/// The end effector moves a tool, so that only its faces at the contacts affect a push. Without
/// exchanges the network learns chance dependences on the rest: with a hook, the predicted end of a
/// push differs by up to 2 mm from the end with the hook's face alone.
const OTHER_TOOLS: f64 = 0.5;

/// Columns with size and form of a tool in the tables of bodies with prescribed motion.
const FORM_EVEN: Range<usize> = 2..5;
const FORM_ODD: Range<usize> = 2..3;

/// Path of an object in a usual push, metres.
const USUAL_PATH: f64 = 0.1;

/// Millimetres in a metre: the unit of targets and losses.
const MILLIMETRES: f64 = 1e3;

/// Share of a node's output in the change of a pose, millimetres.
#[derive(Clone, Copy, Debug)]
struct Contribution {
    node: u32,
    target: u32,
    /// Components of the tool's motion, and the length, times the length of the object's motion.
    scales: [f32; 3],
}

/// Required change of a pose.
#[derive(Clone, Copy, Debug)]
struct Target {
    /// Change of x, y, and of the heading at the support's length, millimetres.
    change: [f32; 3],
    /// Weights of position and heading in the loss.
    weights: [f32; 2],
    /// Weights of the readouts that are compared with it.
    readouts: [f32; READOUTS],
}

/// A push with its graphs.
struct Push {
    batch: Batch,
    contributions: Vec<Contribution>,
    targets: Vec<Target>,
}

/// Pushes of several sets of episodes.
pub struct Examples {
    sets: Vec<(Vec<Push>, f64)>,
}

/// Graphs of several pushes with their targets: C contributions, T targets.
#[derive(Default)]
pub(super) struct Supervised {
    pub batch: Batch,
    /// Node of every contribution, `[C]`.
    pub nodes: Vec<u32>,
    /// Target of every contribution, `[C]`.
    pub targets: Vec<u32>,
    /// Scales of every contribution, [C, 3].
    pub scales: Vec<f32>,
    /// Required changes, [T, 3].
    pub changes: Vec<f32>,
    /// Weights of position and heading, [T, 2].
    pub weights: Vec<f32>,
    /// Weights of the readouts, [T, READOUTS].
    pub readouts: Vec<f32>,
}

impl Examples {
    /// Rolls out every episode of these sets, which are drawn with their weights.
    pub fn new<'a>(sets: impl IntoIterator<Item = (&'a Dataset, f64)>) -> Self {
        let pushes = |(set, weight): (&Dataset, f64)| {
            let readouts = readouts(set.config().truth, set.config().preset.is_crowd());
            let episodes = set.episodes().par_iter();
            let pushes: Vec<Push> =
                episodes.filter_map(|episode| push(episode, readouts)).collect();
            (pushes, weight)
        };
        let sets = sets.into_iter().map(pushes).filter(|(pushes, _)| !pushes.is_empty());
        Self { sets: sets.collect() }
    }

    /// Returns the number of pushes.
    pub fn count(&self) -> usize {
        self.sets.iter().map(|(pushes, _)| pushes.len()).sum()
    }

    /// Draws `count` pushes with the random numbers of (`seed`, `step`, `part`).
    pub(super) fn draw(&self, (seed, step, part): (u64, u64, u64), count: usize) -> Supervised {
        let mut random = Pcg64::new(
            (u128::from(seed) << 64) | u128::from(step),
            0xa02b_dbf7_bb3c_00a7_u128 ^ (u128::from(part) << 8),
        );
        let whole: f64 = self.sets.iter().map(|(_, weight)| weight).sum();
        let mut drawn = Supervised::default();
        for _ in 0..count {
            let mut left = random.random::<f64>() * whole;
            let chosen = self.sets.iter().find(|(_, weight)| {
                left -= weight;
                left < 0.0
            });
            if let Some((pushes, _)) = chosen.or(self.sets.last()) {
                let first = drawn.batch.given_count();
                drawn.add(&pushes[random.random_range(0..pushes.len())]);
                if random.random_bool(OTHER_TOOLS) {
                    let other = &pushes[random.random_range(0..pushes.len())];
                    drawn.exchange_tool(first, &other.batch);
                }
            }
        }
        drawn
    }
}

impl Supervised {
    /// Replaces the size and form of the tool in the rows from `first` on.
    fn exchange_tool(&mut self, first: usize, other: &Batch) {
        let is_tool = |even: &[f32]| even[0] == 1.0;
        let rows = other.given_even.chunks_exact(GIVEN_EVEN);
        let mut rows = rows.zip(other.given_odd.chunks_exact(GIVEN_ODD));
        let Some((even, odd)) = rows.find(|(even, _)| is_tool(even)) else { return };
        let own = self.batch.given_even[first * GIVEN_EVEN..].chunks_exact_mut(GIVEN_EVEN);
        let own = own.zip(self.batch.given_odd[first * GIVEN_ODD..].chunks_exact_mut(GIVEN_ODD));
        for (own_even, own_odd) in own.filter(|(even, _)| is_tool(even)) {
            own_even[FORM_EVEN].copy_from_slice(&even[FORM_EVEN]);
            own_odd[FORM_ODD].copy_from_slice(&odd[FORM_ODD]);
        }
    }

    fn add(&mut self, push: &Push) {
        let nodes = (self.batch.node_even.len() / NODE_EVEN) as u32;
        let given = self.batch.given_count() as u32;
        let targets = (self.changes.len() / 3) as u32;
        let Self { batch, .. } = self;
        batch.node_even.extend_from_slice(&push.batch.node_even);
        batch.node_odd.extend_from_slice(&push.batch.node_odd);
        batch.given_even.extend_from_slice(&push.batch.given_even);
        batch.given_odd.extend_from_slice(&push.batch.given_odd);
        batch.relation_even.extend_from_slice(&push.batch.relation_even);
        batch.relation_odd.extend_from_slice(&push.batch.relation_odd);
        batch.receivers.extend(push.batch.receivers.iter().map(|node| node + nodes));
        batch.senders.extend(push.batch.senders.iter().map(|&sender| match sender {
            NOBODY => NOBODY,
            row if row >= GIVEN => row + given,
            node => node + nodes,
        }));
        for Contribution { node, target, scales } in &push.contributions {
            self.nodes.push(node + nodes);
            self.targets.push(target + targets);
            self.scales.extend(scales);
        }
        for Target { change, weights, readouts } in &push.targets {
            self.changes.extend(change);
            self.weights.extend(weights);
            self.readouts.extend(readouts);
        }
    }
}

/// Returns the weights of the readouts that an engine trains: its own, or all of them for the 2-D
/// engine.
fn readouts(truth: Truth, crowd: bool) -> [f32; READOUTS] {
    match truth {
        _ if crowd => [0.5, 0.5],
        Truth::Both | Truth::Spatial => [1.0, 0.0],
        Truth::Planar => [0.5, 0.5],
        Truth::Mujoco => [0.0, 1.0],
    }
}

/// Returns the push of an episode; `None` if nothing moves in the analytic rollout.
fn push(episode: &Episode, readouts: [f32; READOUTS]) -> Option<Push> {
    let scene = &episode.scene;
    let mut job = Job::stated(scene, episode.motion.clone());
    // Uniform supports are often an assumption: every second of them counts as unknown.
    let even = scene.objects.iter().all(|object| object.support == Support::Even);
    Arc::make_mut(&mut job.physics).supports_known = !even || episode.index.is_multiple_of(2);
    let settings = RollSettings { corrected: CORRECTED, ..RollSettings::default() };
    let mut roller = Roller::new(ModelKind::PRIOR.into(), settings);
    let (readings, batch) = roller.read(scene, std::slice::from_ref(&job), Record::Frames);
    let reading = readings.into_iter().next()?;
    let frames = &reading.trajectory.frames;
    let (end, true_end) = (frames.len() - 1, episode.frames.len() - 1);
    let mut batch = batch.clone();
    (batch.nodes, batch.pairs) = (Vec::new(), Vec::new());
    let mut push = Push { batch, contributions: Vec::new(), targets: Vec::new() };
    let mut aim = |n: usize, predicted: &State, truth: &State, weight: f32| {
        let complete = |read: &&Read| n == end || read.frames[1] as usize <= n;
        let reads: Vec<&Read> = reading.reads.iter().filter(complete).collect();
        for (k, object) in scene.objects.iter().enumerate() {
            let own: Vec<&&Read> = reads.iter().filter(|read| read.object as usize == k).collect();
            let Some(first) = own.first() else { continue };
            let (pose, true_pose) = (predicted.poses[k], truth.poses[k]);
            let shift = MILLIMETRES * (true_pose.position - pose.position);
            let turn = wrap_angle(true_pose.heading - pose.heading);
            let turn = MILLIMETRES * first.support * turn;
            let heading = if object.shape.is_cylinder() { CYLINDER } else { TURN };
            let target = push.targets.len() as u32;
            // Errors grow with the path.
            let path: f64 = own.iter().map(|read| read.length).sum();
            let weight = weight / (1.0 + path / USUAL_PATH) as f32;
            push.targets.push(Target {
                change: [shift.x, shift.y, turn].map(|value| value as f32),
                weights: [weight, weight * heading],
                readouts,
            });
            push.contributions.extend(own.iter().map(|read| {
                let length = MILLIMETRES * read.length;
                let scales = [length * read.axis.x, length * read.axis.y, length];
                let scales = scales.map(|scale| scale as f32);
                Contribution { node: read.node, target, scales }
            }));
        }
    };
    aim(end, &frames[end].state, &episode.frames[true_end].state, 1.0);
    if let [stroke] = &episode.motion.strokes[..] {
        let middle = stroke.frames() / 2;
        if middle > 0 && middle < end.min(true_end) {
            aim(middle, &frames[middle].state, &episode.frames[middle].state, MIDWAY);
        }
    }
    // A push counts once, whatever the number of its objects.
    let share = 1.0 / push.targets.len() as f32;
    let weights = push.targets.iter_mut().flat_map(|target| &mut target.weights);
    weights.for_each(|weight| *weight *= share);
    (!push.targets.is_empty()).then_some(push)
}
