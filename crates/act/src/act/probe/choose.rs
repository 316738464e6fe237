//! Which of several pushes is the most informative.
//!
//! Two samples s and t of a belief, in which a push is predicted to end the distance d apart, in
//! standard deviations of what is seen, are still confused with a probability of at most exp(-d^2 /
//! 8) afterwards (Bhattacharyya's bound). Of N samples the end of a push therefore tells, in nats,
//! about
//!
//! ```text
//! mean over s of  -ln (mean over t of exp(-d^2 / 8))
//! ```
//!
//! (a lower bound, Kolchinsky and Tracey 2017, doi:10.3390/e19070361). Where it only matters which
//! plan reaches the goal, a push is as good as it tells those samples apart in which different plans
//! work: the sum over pairs of samples of the share of plans with R(p, s) != R(p, t), times
//! 1 - exp(-d^2 / 8).

use serde::{Deserialize, Serialize};

use crate::belief::{Belief, generator};
use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::State,
    task::{Job, Noise, ToolMotion},
};

use super::super::judge::{Reach, Samples};

/// How many probes are rolled out in a few samples, and how many of them in all.
const RACED: (usize, usize) = (32, 4);
const FINAL: usize = 8;

/// Error of a predicted end on top of the noise, metres.
const MODEL: f64 = 2e-3;

/// How a probe is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProbeRule {
    /// By what it tells about the samples in which different plans work.
    #[default]
    Task,
    /// By what it tells about all samples, whatever the task.
    Information,
    /// By chance.
    Random,
    /// By chance among those at an object of the pair whose joint is least certain.
    Uncertain,
    /// By how far things are predicted to move.
    Motion,
}

/// A push that could be made to learn something.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The object that it is made at.
    pub object: usize,
    /// What the tool does.
    pub motion: ToolMotion,
}

/// The index of the push to make next to learn what is not known of a table, no task given; `None`
/// if none of them can be made. The belief is drawn from `count` times with the numbers of draw
/// `index`; `noise` is that of what will be seen. Where several are as good the first is taken, and by
/// [`ProbeRule::Random`] always; [`ProbeRule::Task`], which asks what plans need, finds none.
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

/// The index of the probe to make, with what comes of plans in every sample.
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
        // Stable, so those at its objects come first, in their order.
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
        // A push that goes wrong in a sample is not a probe.
        valued.zip(order.iter().copied()).filter(|(value, _)| value.is_finite()).collect()
    };
    let mut raced = values(&order, &few);
    if matches!(rule, ProbeRule::Random | ProbeRule::Uncertain) {
        return raced.first().map(|(_, k)| *k);
    }
    // Stable, so equal ones keep their order.
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

/// What a probe is worth that ends so in every sample; infinitely little if something goes wrong.
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
        ProbeRule::Information => told(states.len(), |s, t| alike(states[s], states[t])),
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

/// What the end of a push tells of `count` samples, nats, of which two are confused with the
/// probability `alike`.
fn told(count: usize, alike: impl Fn(usize, usize) -> f64) -> f64 {
    let one = |s: usize| {
        let taken: f64 = (0..count).map(|t| alike(s, t)).sum();
        -(taken / count as f64).ln()
    };
    (0..count).map(one).sum::<f64>() / count.max(1) as f64
}

/// Sum of the squared distances of all objects, square metres.
fn square(one: &State, other: &State) -> f64 {
    let pairs = one.poses.iter().zip(&other.poses);
    pairs.map(|(a, b)| (a.position - b.position).norm_squared()).sum()
}

/// The pair with the largest entropy of its types of joints.
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
    fn a_push_tells_as_much_as_there_are_samples_to_tell_apart() {
        assert_eq!(told(8, |_, _| 1.0), 0.0);
        let same = |s: usize, t: usize| f64::from(u8::from(s == t));
        assert!((told(8, same) - 8f64.ln()).abs() < 1e-12);
        let halves = |s: usize, t: usize| f64::from(u8::from(s / 4 == t / 4));
        assert!((told(8, halves) - 2f64.ln()).abs() < 1e-12);
        assert_eq!(told(0, same), 0.0);
    }
}
