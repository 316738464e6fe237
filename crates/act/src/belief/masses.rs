//! Belief about the mass range of every object, from contacts between pushed objects.
//!
//! Without force measurements all dynamics scale with mass, so a push identifies only mass ratios
//! in a group of touching objects. Ranges that are far apart sometimes also identify the scale
//! because not every ratio fits all of them (Tekden 2020, section 8.3).
//!
//! Whole assignments of ranges to objects are therefore weighed: the ratio of two masses is known
//! long before either mass. The mass of an object without contact to others stays undetermined.

use rand::Rng;
use serde::{Deserialize, Serialize};

use pushplan::{
    outcome::Trajectory,
    scene::{Body, Physics, Span},
};

use super::{
    density::log_sum,
    distributions::{generator, weighted},
};

/// Maximum number of assignments kept: all assignments of four objects and three ranges.
const KEPT: usize = 81;

/// Maximum number of touching objects for which all evidence counts. With more objects the evidence
/// is scaled down because one wrong contact misleads the rest of a rollout.
const FEW: f64 = 4.0;

/// Probability that the true assignment was discarded when not all are kept; all ranges are then
/// equally probable.
///
/// Measured with `pushplan-lab masses --touching --controlled rows wedges --count 20 --seed 5`:
/// without it, nearly all masses were certain but only 62 to 71 % were correct. Of the values 0 to
/// 0.3 in steps of 0.05, this was best calibrated over these and 225 masses in crowds of nine.
const LOST: f64 = 0.2;

/// Belief about masses with discrete ranges.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MassShares {
    /// Probabilities of the ranges for every object; `None` if the object touched no other object.
    pub objects: Vec<Option<Vec<f64>>>,
    /// Pairs that touched each other, in the order of their indices.
    pub ratios: Vec<MassRatio>,
}

/// Belief about the mass ratio of two objects, assuming that a kept assignment is true.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassRatio {
    /// Indices of the objects, the lower one first.
    pub between: [usize; 2],
    /// Mean and standard deviation of the natural logarithm of the mass ratio.
    pub log: [f64; 2],
}

/// Assignment of a range to every object that has touched another.
#[derive(Clone, Debug, PartialEq)]
struct Assignment {
    ranges: Vec<usize>,
    /// Log-probabilities before the current push and now.
    before: f64,
    now: f64,
}

/// Observed push that can be replayed from several possible initial states.
pub(super) struct Replay<'a> {
    /// Number of initial states.
    pub starts: usize,
    /// Rolls out the push from each initial state with these physics.
    pub play: &'a dyn Fn(Physics) -> Vec<Trajectory>,
    /// Returns the log-likelihoods of the observations, given physics for the first initial states.
    pub score: &'a dyn Fn(Vec<Vec<Physics>>) -> Vec<f64>,
}

/// Assignments of ranges to objects.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Masses {
    /// Geometric means of the ranges, kg.
    middles: Vec<f64>,
    /// Logarithmic widths of the ranges; masses are log-uniform within a range.
    widths: Vec<f64>,
    /// Number of objects in the scene.
    count: usize,
    /// Objects that have touched another, in the order of first contact.
    objects: Vec<usize>,
    /// Pairs that touched each other, the lower index first.
    met: Vec<[usize; 2]>,
    /// Assignments in descending order of probability.
    all: Vec<Assignment>,
}

impl Masses {
    /// Creates the prior for `count` objects.
    pub fn new(count: usize, ranges: &[Span]) -> Self {
        Self {
            middles: ranges.iter().map(|range| (range.low * range.high).sqrt()).collect(),
            widths: ranges.iter().map(|range| (range.high / range.low).ln()).collect(),
            count,
            objects: Vec::new(),
            met: Vec::new(),
            all: vec![Assignment { ranges: Vec::new(), before: 0.0, now: 0.0 }],
        }
    }

    /// Updates the assignments with a push; all parameters except masses are taken from `physics`.
    pub fn weigh(&mut self, physics: &Physics, replay: &Replay<'_>) {
        let met = met(&(replay.play)(self.likeliest(physics.clone())));
        if met.is_empty() {
            return;
        }
        for object in met.iter().flatten() {
            if self.objects.contains(object) {
                continue;
            }
            // The most probable initial state decides which assignments are kept.
            self.objects.push(*object);
            let each = std::mem::take(&mut self.all);
            let middles = 0..self.middles.len();
            let with = |one: &Assignment, range| Assignment {
                ranges: [&one.ranges[..], &[range]].concat(),
                ..*one
            };
            self.all = each
                .iter()
                .flat_map(|one| middles.clone().map(move |range| with(one, range)))
                .collect();
            self.play(physics, &met, replay, 1);
        }
        self.play(physics, &met, replay, replay.starts);
        let all = log_sum(self.all.iter().map(|one| one.now));
        for one in &mut self.all {
            one.now -= all;
            one.before = one.now;
        }
        self.met.extend(met);
        self.met.sort_unstable();
        self.met.dedup();
    }

    /// Replays a push with the contacts `met` from the first `starts` initial states under all
    /// assignments, and keeps the most probable ones.
    fn play(&mut self, physics: &Physics, met: &[[usize; 2]], replay: &Replay<'_>, starts: usize) {
        // Assignments that differ only in uninvolved objects yield equal replays.
        let part = |k: &usize| met.as_flattened().contains(k);
        let key = |one: &Assignment| -> Vec<usize> {
            let both = self.objects.iter().zip(&one.ranges);
            both.filter(|(k, _)| part(k)).map(|(_, range)| *range).collect()
        };
        let keys: Vec<Vec<usize>> = self.all.iter().map(key).collect();
        let mut different = keys.clone();
        different.sort_unstable();
        different.dedup();
        let place = |key: &Vec<usize>| different.binary_search(key).unwrap_or_default();
        let mut of = vec![Vec::new(); different.len()];
        for (one, key) in self.all.iter().zip(&keys) {
            let at = &mut of[place(key)];
            if at.is_empty() {
                let start =
                    |start| self.within(self.assigned(physics.clone(), &one.ranges), one, start);
                *at = (0..starts).map(start).collect();
            }
        }
        let scores = (replay.score)(of);
        let among = self.objects.iter().filter(|k| part(k)).count();
        let trust = (FEW / among.max(1) as f64).min(1.0);
        for (one, key) in self.all.iter_mut().zip(&keys) {
            // A failed rollout has zero likelihood.
            let score = scores.get(place(key)).copied().filter(|score| !score.is_nan());
            one.now = one.before + trust * score.unwrap_or(f64::NEG_INFINITY);
        }
        if self.all.iter().all(|one| one.now == f64::NEG_INFINITY) {
            self.all.iter_mut().for_each(|one| one.now = one.before);
        }
        self.all.sort_by(|a, b| b.now.total_cmp(&a.now));
        self.all.truncate(KEPT);
    }

    /// Returns `physics` with the most probable masses; objects without contact get the middle
    /// range.
    pub fn likeliest(&self, physics: Physics) -> Physics {
        self.assigned(physics, self.all.first().map_or(&[][..], |best| &best.ranges))
    }

    /// Returns `physics` with sampled masses.
    pub fn sample(&self, physics: Physics, rng: &mut impl Rng) -> Physics {
        let drawn = self.all.get(weighted(rng, &self.weights()));
        let mut physics = self.assigned(physics, drawn.map_or(&[][..], |one| &one.ranges));
        let lost = self.lost();
        for k in 0..self.count {
            if !self.objects.contains(&k) || rng.random_bool(lost) {
                physics.masses[k] = self.middles[rng.random_range(0..self.middles.len())];
            }
        }
        physics
    }

    /// Returns the probabilities of the ranges and the mass ratios.
    pub fn shares(&self) -> MassShares {
        let (weights, lost) = (self.weights(), self.lost());
        let place = |object: usize| self.objects.iter().position(|k| *k == object);
        let objects = (0..self.count).map(|object| {
            let place = place(object)?;
            let mut shares = vec![0.0; self.middles.len()];
            for (one, weight) in self.all.iter().zip(&weights) {
                shares[one.ranges[place]] += weight;
            }
            let even = lost / shares.len() as f64;
            Some(shares.iter().map(|share| even + (1.0 - lost) * share).collect())
        });
        let ratios = self.met.iter().filter_map(|&between| {
            let [first, second] = between.map(place);
            let (first, second) = (first?, second?);
            let log = |one: &Assignment| {
                (self.middles[one.ranges[first]] / self.middles[one.ranges[second]]).ln()
            };
            let wide = |one: &Assignment| {
                [first, second].map(|k| self.widths[one.ranges[k]].powi(2) / 12.0)
            };
            let both = || self.all.iter().zip(&weights);
            let mean: f64 = both().map(|(one, weight)| weight * log(one)).sum();
            let square = |one| (log(one) - mean).powi(2) + wide(one).iter().sum::<f64>();
            let variance: f64 = both().map(|(one, weight)| weight * square(one)).sum();
            Some(MassRatio { between, log: [mean, variance.sqrt()] })
        });
        MassShares { objects: objects.collect(), ratios: ratios.collect() }
    }

    /// Returns the probability that the true assignment is not among the kept ones.
    fn lost(&self) -> f64 {
        let every = self.middles.len().checked_pow(self.objects.len() as u32);
        if every.is_some_and(|every| every <= self.all.len()) { 0.0 } else { LOST }
    }

    fn weights(&self) -> Vec<f64> {
        let all = log_sum(self.all.iter().map(|one| one.now));
        self.all.iter().map(|one| (one.now - all).exp()).collect()
    }

    /// Returns `physics` with masses sampled within the ranges of an assignment. Start 0 uses the
    /// middles of the ranges.
    fn within(&self, mut physics: Physics, one: &Assignment, start: usize) -> Physics {
        if start > 0 {
            let mut rng = generator(start as u64, 0);
            let shares: Vec<f64> = (0..self.count).map(|_| rng.random::<f64>() - 0.5).collect();
            for (object, range) in self.objects.iter().zip(&one.ranges) {
                physics.masses[*object] *= (shares[*object] * self.widths[*range]).exp();
            }
        }
        physics
    }

    /// Returns `physics` with masses in the middle of these ranges. Objects without contact get the
    /// middle range.
    fn assigned(&self, mut physics: Physics, ranges: &[usize]) -> Physics {
        physics.masses.fill(self.middles[self.middles.len() / 2]);
        for (object, range) in self.objects.iter().zip(ranges) {
            physics.masses[*object] = self.middles[*range];
        }
        physics
    }
}

/// Returns the pairs in contact in at least half of the rollouts, in the order of the first.
fn met(played: &[Trajectory]) -> Vec<[usize; 2]> {
    let each: Vec<Vec<[usize; 2]>> = played.iter().map(|one| pairs(one).collect()).collect();
    let mut met: Vec<[usize; 2]> = Vec::new();
    for pair in each.iter().flatten() {
        let in_many = 2 * each.iter().filter(|pairs| pairs.contains(pair)).count() >= each.len();
        if in_many && !met.contains(pair) {
            met.push(*pair);
        }
    }
    met
}

/// Returns the pairs of objects in contact, the lower index first, in chronological order.
fn pairs(trajectory: &Trajectory) -> impl Iterator<Item = [usize; 2]> {
    trajectory.contacts.iter().filter_map(|contact| match contact.with {
        Body::Object(other) => Some([contact.object.min(other), contact.object.max(other)]),
        _ => None,
    })
}

#[cfg(test)]
mod tests;
