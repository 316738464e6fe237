//! Error predicted by the network itself, fitted to its own rollouts after training, see [`Doubt`].

use pushplan::internals::effect::Network;
use pushplan::internals::geometry::{Pose, wrap_angle};
use pushplan::internals::graph::{Corrections, READOUTS};
use pushplan::internals::network::{Buffers, Doubt, Forward, PredictorWeights};
use pushplan::internals::rollout::{Read, RollSettings, Roller};
use pushplan::internals::{
    contact::Bodies,
    outcome::Record,
    scene::{CORRECTED, ModelKind, ModelSpec},
    task::Job,
};
use rayon::prelude::*;

use crate::dataset::{Dataset, Episode};

/// Maximum number of rolled-out episodes per set, for tools and for crowds, which have more
/// objects.
const EPISODES: [usize; 2] = [1500, 150];

/// Minimum displacement of an object that counts, metres.
const MOVED: f64 = 0.01;

/// Number of optimiser steps and initial step size.
const STEPS: usize = 400;
const RATE: f64 = 0.03;

/// Weight decay.
const DECAY: f64 = 1e-4;

/// Lower bounds of errors, metres and radians: the accuracy of recordings.
const LEAST: [f64; 2] = [2e-5, 2e-4];

/// Object of an episode with its final errors and hidden rows.
struct Case {
    /// Error of the position, metres, and of the heading, radians, unless the object is round.
    errors: [Option<f64>; 2],
    /// Lengths of the motion in each frame, metres and radians, `[T]` each.
    lengths: [Vec<f64>; 2],
    /// Even half of the propagated state in each frame, [T, h].
    rows: Vec<f32>,
    /// Distances of the readouts from their mean, metres and radians.
    apart: [f64; 2],
    /// Weight of the case.
    weight: f64,
}

/// Scales the rows of these weights to a mean square of one over rollouts of `sets`, and fits the
/// predicted error to them.
pub(super) fn fit_doubt(weights: &mut PredictorWeights, sets: &[Dataset]) {
    let network = Network::new(weights.clone());
    let mut cases: Vec<Case> = sets.iter().flat_map(|set| cases(&network, set)).collect();
    let values = cases.iter().flat_map(|case| &case.rows);
    let squares: f64 = values.clone().map(|value| f64::from(*value).powi(2)).sum();
    let mean = squares / values.count().max(1) as f64;
    if mean > 0.0 {
        let factor = mean.sqrt().recip() as f32;
        weights.card.row_scale *= factor;
        let rows = cases.iter_mut().flat_map(|case| &mut case.rows);
        rows.for_each(|value| *value *= factor);
    }
    weights.card.doubt = Some(fitted(&cases, weights.card.config.half()));
}

fn fitted(cases: &[Case], half: usize) -> Doubt {
    let [position, heading] = [0, 1].map(|k| fit(cases, k, half));
    Doubt {
        bias: [position.bias as f32, heading.bias as f32],
        floor: [position.floor() as f32, heading.floor() as f32],
        apart: [position.apart.exp() as f32, heading.apart.exp() as f32],
        weights: [position, heading]
            .map(|fitted| fitted.weights.iter().map(|w| *w as f32).collect()),
    }
}

/// Returns the cases of a set, with equal total weights for all sets.
fn cases(network: &Network, set: &Dataset) -> Vec<Case> {
    let most = EPISODES[usize::from(set.config().preset.is_crowd())];
    let episodes = &set.episodes()[..set.episodes().len().min(most)];
    let forward = Forward::new(network.weights());
    let mut cases: Vec<Case> =
        episodes.par_iter().flat_map_iter(|episode| rolled(&forward, episode)).collect();
    let weight = 1.0 / cases.len().max(1) as f64;
    cases.iter_mut().for_each(|case| case.weight = weight);
    cases
}

fn rolled(forward: &Forward, episode: &Episode) -> Vec<Case> {
    let half = forward.half();
    let scene = &episode.scene;
    let job = Job::stated(scene, episode.motion.clone());
    let settings = RollSettings { corrected: CORRECTED, ..RollSettings::default() };
    let mut roller = Roller::new(ModelSpec::from(ModelKind::NETWORK), settings);
    let (readings, batch) = roller.read(scene, std::slice::from_ref(&job), Record::Outcome);
    let (mut buffers, mut corrections) = (Buffers::default(), Corrections::default());
    forward.run(batch, &mut buffers, &mut corrections);
    let Some(reading) = readings.into_iter().next() else { return Vec::new() };
    let Some(truth) = episode.frames.last() else { return Vec::new() };
    let reads = reading.reads.clone();
    let bodies = Bodies::new(scene, &episode.motion.tool, episode.motion.lift, &job.physics);
    let predicted = reading.corrected(&bodies, &corrections);
    let (start, end) = (&episode.frames[0].state, predicted.outcome());
    let case = |k: usize| {
        let own: Vec<&Read> = reads.iter().filter(|read| read.object as usize == k).collect();
        let [start, end, truth] = [start, end, &truth.state].map(|state| state.poses[k]);
        let travel = |pose: &Pose| (pose.position - start.position).norm();
        let moved = travel(&truth).max(travel(&end)) > MOVED;
        if own.is_empty() || !moved {
            return None;
        }
        let mut sums = [[0.0; 3]; READOUTS];
        let mut rows = Vec::with_capacity(own.len() * half);
        for read in &own {
            let node = read.node as usize;
            rows.extend_from_slice(&buffers.rows()[node * half..(node + 1) * half]);
            for (sum, readout) in sums.iter_mut().zip(corrections.nodes[node].readouts) {
                let change = read.change(readout);
                (0..3).for_each(|k| sum[k] += change[k]);
            }
        }
        let [a, b] = sums;
        let round = scene.objects[k].shape.is_cylinder();
        let turned = wrap_angle(end.heading - truth.heading).abs();
        let lengths = own.iter().map(|read| read.length);
        let turns = own.iter().map(|read| read.length / read.support);
        Some(Case {
            errors: [Some((end.position - truth.position).norm()), (!round).then_some(turned)],
            lengths: [lengths.collect(), turns.collect()],
            rows,
            apart: [(a[0] - b[0]).hypot(a[1] - b[1]) / 2.0, (a[2] - b[2]).abs() / 2.0],
            weight: 1.0,
        })
    };
    (0..scene.objects.len()).filter_map(case).collect()
}

/// Parameters fitted for position or heading.
#[derive(Clone)]
struct Fitted {
    weights: Vec<f64>,
    bias: f64,
    /// Logarithm of the lower bound.
    low: f64,
    /// Logarithm of the share of the distance between readouts.
    apart: f64,
}

impl Fitted {
    fn floor(&self) -> f64 {
        self.low.exp()
    }

    fn values(&mut self) -> impl Iterator<Item = &mut f64> {
        self.weights.iter_mut().chain([&mut self.bias, &mut self.low, &mut self.apart])
    }
}

/// Minimises the mean of ln S + r / S with Adam (Kingma and Ba 2015).
fn fit(cases: &[Case], k: usize, half: usize) -> Fitted {
    let cases: Vec<&Case> =
        cases.iter().filter(|case| case.errors[k].is_some() && !case.rows.is_empty()).collect();
    let whole: f64 = cases.iter().map(|case| case.weight).sum();
    let mean = |value: &dyn Fn(&Case) -> f64| {
        cases.iter().map(|case| case.weight * value(case)).sum::<f64>() / whole.max(1e-12)
    };
    let error = mean(&|case| case.errors[k].unwrap_or(0.0)).max(LEAST[k]);
    let length = mean(&|case| case.lengths[k].iter().sum());
    let mut fitted = Fitted {
        weights: vec![0.0; half],
        bias: (error / length.max(1e-12)).ln(),
        low: (0.1 * error).ln(),
        apart: 0.1f64.ln(),
    };
    let mut moments = vec![[0.0f64; 2]; half + 3];
    for step in 1..=STEPS {
        let gradients: Vec<Vec<f64>> = cases
            .par_chunks(256)
            .map(|chunk| {
                let mut sum = vec![0.0; half + 3];
                chunk.iter().for_each(|case| gradient(case, k, &fitted, &mut sum));
                sum
            })
            .collect();
        let rate = RATE * (1.0 - step as f64 / (STEPS + 1) as f64);
        let (old1, old2) = (0.9f64, 0.99f64);
        for (n, value) in fitted.values().enumerate() {
            let decay = if n < half { DECAY * *value } else { 0.0 };
            let slope = gradients.iter().map(|part| part[n]).sum::<f64>() / whole + decay;
            let [first, second] = &mut moments[n];
            *first = old1 * *first + (1.0 - old1) * slope;
            *second = old2 * *second + (1.0 - old2) * slope * slope;
            let up = *first / (1.0 - old1.powi(step as i32));
            let size = (*second / (1.0 - old2.powi(step as i32))).sqrt();
            *value -= rate * up / (size + 1e-9);
        }
    }
    fitted
}

/// Adds the gradient of a case's share of ln S + r / S.
fn gradient(case: &Case, k: usize, fitted: &Fitted, sum: &mut [f64]) {
    let half = fitted.weights.len();
    let frames = case.rows.chunks_exact(half).zip(&case.lengths[k]);
    let added: Vec<f64> = frames
        .map(|(row, length)| {
            let dot: f64 = row.iter().zip(&fitted.weights).map(|(x, w)| f64::from(*x) * w).sum();
            (dot + fitted.bias).min(0.0).exp() * length
        })
        .collect();
    let apart = fitted.apart.exp() * case.apart[k];
    let spread = fitted.floor() + apart + added.iter().sum::<f64>();
    let error = case.errors[k].unwrap_or(0.0).max(LEAST[k]);
    let slope = case.weight * (1.0 / spread - error / (spread * spread));
    for (row, added) in case.rows.chunks_exact(half).zip(&added) {
        for (sum, x) in sum.iter_mut().zip(row) {
            *sum += slope * added * f64::from(*x);
        }
    }
    sum[half] += slope * added.iter().sum::<f64>();
    sum[half + 1] += slope * fitted.floor();
    sum[half + 2] += slope * apart;
}
