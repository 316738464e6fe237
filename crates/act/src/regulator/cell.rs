//! Inference of the regulator on plain numbers, without candle.

use pushplan::network::{Parameters, Statistics};

use super::{
    card::RegulatorWeights,
    layout::{OUTPUTS, TYPES},
};

/// Bound of the normalised features, in standard deviations, which limits extrapolation to scenes
/// unlike the training data.
const BOUND: f32 = 10.0;

/// Regulator with its weights, shared between beliefs.
#[derive(Clone, Debug)]
pub struct Regulator {
    features: usize,
    width: usize,
    scales: Statistics,
    parameters: Parameters,
}

/// Hidden state of every pair: [P, H].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Memory {
    hidden: Vec<f32>,
}

/// Correction for a pair: logarithms of the filter are multiplied by `trust`, then `logits` are
/// added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Logit of every type.
    pub logits: [f64; TYPES],
    /// Factor between 0 and 2; 1 if untrained.
    pub trust: f64,
}

/// Lower bound of the filter's probabilities.
pub const LEAST: f64 = 1e-12;

impl Correction {
    fn of(outputs: &[f32; OUTPUTS]) -> Self {
        let [logits @ .., trust] = outputs;
        Self { logits: logits.map(f64::from), trust: f64::from(2.0 * sigmoid(*trust)) }
    }

    /// Returns the corrected probabilities of the filter.
    pub fn of_filtered(&self, filtered: &[f64; TYPES]) -> [f64; TYPES] {
        let mut logs = self.logits;
        for (log, share) in logs.iter_mut().zip(filtered) {
            *log += self.trust * share.max(LEAST).ln();
        }
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let shares = logs.map(|log| (log - most).exp());
        let all: f64 = shares.iter().sum();
        shares.map(|share| share / all)
    }
}

impl Regulator {
    /// Creates a regulator with these weights.
    pub fn new(weights: &RegulatorWeights) -> Self {
        Self {
            features: weights.card.features,
            width: weights.card.width,
            scales: weights.card.scales.clone(),
            parameters: weights.parameters.clone(),
        }
    }

    /// Updates the hidden state with a window and returns the corrections.
    ///
    /// `features` are [P, F] for `pairs` of this many `objects`. Pairs for which `informative` is
    /// `false` are neither updated nor corrected (`None`).
    pub fn step(
        &self,
        features: &[f32],
        informative: &[bool],
        (pairs, objects): (&[[usize; 2]], usize),
        memory: &mut Memory,
    ) -> Vec<Option<Correction>> {
        let (f, h) = (self.features, self.width);
        memory.hidden.resize(pairs.len() * h, 0.0);
        let before = memory.hidden.clone();
        let messages = messages(&before, (pairs, objects), h);
        for p in (0..pairs.len()).filter(|p| informative[*p]) {
            let row: Vec<f32> = features[p * f..][..f]
                .iter()
                .enumerate()
                .map(|(k, x)| (x - self.scales.mean[k]) / self.scales.deviation[k])
                .map(|x| x.clamp(-BOUND, BOUND))
                .collect();
            let own = &before[p * h..][..h];
            let mut given = self.get("gates.bias").to_vec();
            multiply(&row, self.get("gates.input"), &mut given);
            multiply(&messages[p * h..][..h], self.get("gates.message"), &mut given);
            let mut held = vec![0.0; 3 * h];
            multiply(own, self.get("gates.hidden"), &mut held);
            let bias = self.get("gates.candidate_bias");
            for k in 0..h {
                let reset = sigmoid(given[k] + held[k]);
                let update = sigmoid(given[h + k] + held[h + k]);
                let candidate = (given[2 * h + k] + reset * (held[2 * h + k] + bias[k])).tanh();
                memory.hidden[p * h + k] = (1.0 - update) * candidate + update * own[k];
            }
        }
        let messages = super::cell::messages(&memory.hidden, (pairs, objects), h);
        let correction = |p: usize| {
            let mut hidden = self.get("head.bias").to_vec();
            multiply(&memory.hidden[p * h..][..h], self.get("head.hidden"), &mut hidden);
            multiply(&messages[p * h..][..h], self.get("head.message"), &mut hidden);
            hidden.iter_mut().for_each(|value| *value = value.max(0.0));
            let mut outputs = [0.0; OUTPUTS];
            outputs.copy_from_slice(self.get("head.logits_bias"));
            multiply(&hidden, self.get("head.logits"), &mut outputs);
            Correction::of(&outputs)
        };
        (0..pairs.len()).map(|p| informative[p].then(|| correction(p))).collect()
    }

    /// Returns a parameter whose presence was checked when the weights were read.
    fn get(&self, name: &str) -> &[f32] {
        &self.parameters.values[name]
    }
}

/// Returns for every pair the sum of the hidden rows of pairs that share an object with it.
fn messages(hidden: &[f32], (pairs, objects): (&[[usize; 2]], usize), h: usize) -> Vec<f32> {
    let mut sums = vec![0.0; objects * h];
    for (pair, row) in pairs.iter().zip(hidden.chunks_exact(h)) {
        for object in pair {
            add(&mut sums[object * h..][..h], row, 1.0);
        }
    }
    let mut messages = vec![0.0; hidden.len()];
    for ((pair, row), message) in
        pairs.iter().zip(hidden.chunks_exact(h)).zip(messages.chunks_exact_mut(h))
    {
        for object in pair {
            add(message, &sums[object * h..][..h], 1.0);
            add(message, row, -1.0);
        }
    }
    messages
}

fn add(into: &mut [f32], row: &[f32], factor: f32) {
    into.iter_mut().zip(row).for_each(|(into, value)| *into += factor * value);
}

/// Adds x [n] times `matrix` [n, m] to `into` [m].
fn multiply(x: &[f32], matrix: &[f32], into: &mut [f32]) {
    for (x, row) in x.iter().zip(matrix.chunks_exact(into.len())) {
        add(into, row, *x);
    }
}

fn sigmoid(x: f32) -> f32 {
    0.5 + 0.5 * (0.5 * x).tanh()
}
