//! Choice of the most informative of several pushes.
//!
//! Let a push be predicted to end a distance d apart in two samples s and t of a belief, with d in
//! standard deviations of the observations. The probability of confusing s and t afterwards is at
//! most exp(-d^2 / 8) (Bhattacharyya's bound). The information gain of a push over N samples is
//! therefore about, in nats,
//!
//! ```text
//! mean over s of  -ln (mean over t of exp(-d^2 / 8))
//! ```
//!
//! (a lower bound, Kolchinsky and Tracey 2017, doi:10.3390/e19070361). If only the choice of a plan
//! matters, the value of a push is how well it separates samples in which different plans work.
//! This is the sum over pairs of samples of the number of plans with R(p, s) != R(p, t), times 1 -
//! exp(-d^2 / 8).

use serde::{Deserialize, Serialize};

use crate::belief::{Belief, generator};
use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::State,
    task::{Job, Noise, ToolMotion},
};

use super::super::judge::{Reach, Samples};

/// Number of probes evaluated in the first round and number of samples used there; then number of
/// finalists, evaluated in all samples.
const RACED: (usize, usize) = (32, 4);
const FINAL: usize = 8;

/// Standard deviation of the final position error of the model, added to the noise, metres.
const MODEL: f64 = 2e-3;

/// Rule for choosing a probe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProbeRule {
    /// Separation of the samples in which different plans work.
    #[default]
    Task,
    /// Information about all samples, independent of the task.
    Information,
    /// Random choice.
    Random,
    /// Random choice among the probes at objects of the pair with the least certain joint.
    Uncertain,
    /// Predicted displacement of the objects.
    Motion,
}

/// Candidate push for exploration.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Index of the pushed object.
    pub object: usize,
    /// Motion of the tool.
    pub motion: ToolMotion,
}

/// Returns the index of the next push for exploring a table without a task.
///
/// `count` samples are drawn from the belief with the generator of draw `index`; `noise` is the
/// noise of the future observations. Returns `None` if no push is feasible. Of equally good pushes
/// the first is returned, and always the first with [`ProbeRule::Random`]. [`ProbeRule::Task`]
/// finds no push because it compares plans.
pub fn choose_probe(
    model: &dyn EffectModel,
    (rule, noise): (ProbeRule, Noise),
    belief: &Belief,
    (count, index): (usize, u64),
    probes: &[Probe],
) -> Option<usize> {
    let mut rng = generator(0x9120_BE5E, index);
    let physics = (0..count).map(|_| belief.sample(&mut rng).into()).collect();
    let samples = Samples { now: belief.situation(), physics };
    choose(model, (rule, noise), (belief, &samples), probes, &[])
}

/// Returns the index of the best probe, given the outcomes of plans in every sample.
pub(super) fn choose(
    model: &dyn EffectModel,
    (rule, noise): (ProbeRule, Noise),
    (belief, samples): (&Belief, &Samples),
    probes: &[Probe],
    reach: &[Vec<Reach>],
) -> Option<usize> {
    let mut order: Vec<usize> = (0..probes.len()).collect();
    if rule == ProbeRule::Uncertain
        && let Some(pair) = least_certain(belief)
    {
        // The sort is stable: probes at objects of the pair come first, in their order.
        order.sort_by_key(|&k| !pair.contains(&probes[k].object));
    }
    order.truncate(RACED.0);
    let few = Samples {
        now: samples.now.clone(),
        physics: samples.physics.iter().take(RACED.1).cloned().collect(),
    };
    let values = |order: &[usize], samples: &Samples| -> Vec<(f64, usize)> {
        let jobs: Vec<Job> = order.iter().flat_map(|&k| samples.jobs(&probes[k].motion)).collect();
        let rolled = model.rollout(&samples.now.scene, &jobs, Record::Outcome);
        let each = rolled.chunks(samples.physics.len().max(1));
        let valued = each.map(|ends| value((rule, noise), samples, ends, reach));
        // A push that fails in a sample is no probe.
        valued.zip(order.iter().copied()).filter(|(value, _)| value.is_finite()).collect()
    };
    let mut raced = values(&order, &few);
    if matches!(rule, ProbeRule::Random | ProbeRule::Uncertain) {
        return raced.first().map(|(_, k)| *k);
    }
    // The sort is stable, so equal probes keep their order.
    raced.sort_by(|a, b| b.0.total_cmp(&a.0));
    raced.truncate(FINAL);
    let last: Vec<usize> = raced.into_iter().map(|(_, k)| k).collect();
    let mut best: Option<(f64, usize)> = None;
    for (value, k) in values(&last, samples) {
        if value > best.map_or(0.0, |(best, _)| best) {
            best = Some((value, k));
        }
    }
    best.map(|(_, k)| k)
}

/// Returns the value of a probe with these final states; minus infinity if it fails in a sample.
fn value(
    (rule, noise): (ProbeRule, Noise),
    samples: &Samples,
    ends: &[Trajectory],
    reach: &[Vec<Reach>],
) -> f64 {
    let wrong = |end: &Trajectory| {
        !end.outcome().is_finite() || end.warnings.iter().any(|warning| warning.forbids_success())
    };
    if ends.iter().any(wrong) {
        return f64::NEG_INFINITY;
    }
    let states: Vec<&State> = ends.iter().map(Trajectory::outcome).collect();
    let variance = noise.position.powi(2) + MODEL.powi(2);
    let alike = |one: &State, other: &State| (-square(one, other) / variance / 8.0).exp();
    match rule {
        ProbeRule::Motion => {
            let start = &samples.now.start;
            states.iter().map(|end| square(end, start).sqrt()).sum()
        }
        ProbeRule::Information => information(states.len(), |s, t| alike(states[s], states[t])),
        ProbeRule::Task | ProbeRule::Random | ProbeRule::Uncertain => {
            let mut sum = 0.0;
            for (s, one) in states.iter().enumerate() {
                for (t, other) in states.iter().enumerate().skip(s + 1) {
                    let differ = reach.iter().filter(|plan| plan[s].reached != plan[t].reached);
                    sum += differ.count() as f64 * (1.0 - alike(one, other));
                }
            }
            sum
        }
    }
}

/// Returns the information about `count` samples from the final state of a push, nats. Samples s
/// and t are confused with probability `alike(s, t)`.
fn information(count: usize, alike: impl Fn(usize, usize) -> f64) -> f64 {
    let one = |s: usize| {
        let taken: f64 = (0..count).map(|t| alike(s, t)).sum();
        -(taken / count as f64).ln()
    };
    (0..count).map(one).sum::<f64>() / count.max(1) as f64
}

/// Returns the sum of the squared displacements of all objects, square metres.
fn square(one: &State, other: &State) -> f64 {
    let pairs = one.poses.iter().zip(&other.poses);
    pairs.map(|(a, b)| (a.position - b.position).norm_squared()).sum()
}

/// Returns the pair with the largest entropy over joint types.
fn least_certain(belief: &Belief) -> Option<[usize; 2]> {
    let entropy = |shares: &[f64; 4]| -> f64 {
        shares.iter().filter(|share| **share > 0.0).map(|share| -share * share.ln()).sum()
    };
    let shares = belief.probabilities();
    let pairs = belief.pairs().zip(shares.iter().map(entropy));
    pairs.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(pair, _)| pair)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_information_of_a_push_is_limited_by_the_number_of_distinct_samples() {
        assert_eq!(information(8, |_, _| 1.0), 0.0);
        let same = |s: usize, t: usize| f64::from(u8::from(s == t));
        assert!((information(8, same) - 8f64.ln()).abs() < 1e-12);
        let halves = |s: usize, t: usize| f64::from(u8::from(s / 4 == t / 4));
        assert!((information(8, halves) - 2f64.ln()).abs() < 1e-12);
        assert_eq!(information(0, same), 0.0);
    }
}
