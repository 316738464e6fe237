//! Pushes that are made to learn something.
//!
//! Learning pays where samples of the belief want different plans. With R(p, s) whether plan p reaches
//! the goal in sample s, knowing which sample is true is worth
//!
//! ```text
//! mean over s of max over p of R(p, s)  -  max over p of mean over s of R(p, s)
//! ```
//!
//! (Howard 1966, doi:10.1109/TSSC.1966.300074). A probe is as good as it tells those samples apart in
//! which different plans work: the sum over pairs of samples (s, t) of the share of plans with
//! R(p, s) != R(p, t), times how sure one is afterwards which of the two it was, 1 - exp(-d^2 / 8), d
//! being the distance of their predicted ends in standard deviations of what is seen (Bhattacharyya's
//! bound).

use std::sync::Arc;

use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

use crate::belief::{Belief, generator};
use crate::effect::EffectModel;
use crate::scene::{
    DisjointSets, Plan, PushForm, Record, State, Task, Tool, Trajectory, near_pairs,
};
use crate::solve::{AskedPush, AskedStart, asked_plan};

use super::judge::{Reach, Samples};
use super::settings::RunSettings;

/// Knowing everything must gain at least this share of samples.
const WORTH: f64 = 0.1;

/// Travel of a probe, metres.
const LENGTH: f64 = 0.10;

/// Offsets of a probe, as shares of the object's inner radius.
const OFFSETS: [f64; 3] = [0.0, 0.8, -0.8];

/// Probes that are rolled out in a few samples, and those of them that are in all.
const RACED: (usize, usize) = (32, 4);
const FINAL: usize = 8;

/// Error of a predicted end beside the noise, metres.
const MODEL: f64 = 2e-3;

/// How a probe is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProbeRule {
    /// By what it tells of the samples in which different plans work.
    #[default]
    Task,
    /// By chance.
    Random,
    /// By chance among those at an object of the pair whose joint is least certain.
    Uncertain,
    /// By how far things are predicted to move.
    Motion,
}

/// Whether it pays to learn which sample is true, by what plans do in each.
pub(super) fn pays(reach: &[Vec<Reach>]) -> bool {
    let Some(samples) = reach.first().map(Vec::len).filter(|count| *count > 0) else {
        return false;
    };
    let one = |reached: bool| f64::from(u8::from(reached));
    let known: f64 = (0..samples).map(|s| one(reach.iter().any(|plan| plan[s].reached))).sum();
    let best = |plan: &Vec<Reach>| plan.iter().map(|reach| one(reach.reached)).sum::<f64>();
    let unknown = reach.iter().map(best).fold(0.0, f64::max);
    known - unknown > WORTH * samples as f64
}

/// The probe to make, chosen with the numbers of draw `index`; `None` if none can be made.
pub(super) fn probe(
    model: &dyn EffectModel,
    task: &Task,
    settings: &RunSettings,
    (belief, samples): (&Belief, &Samples),
    (tools, reach): (&[Arc<Tool>], &[Vec<Reach>]),
    index: u64,
) -> Option<(Plan, Arc<Tool>)> {
    let mut rng = generator(settings.seed ^ 0x9120_BE5E, index);
    let mut probes = candidates(task, samples, tools);
    probes.shuffle(&mut rng);
    if settings.rule == ProbeRule::Uncertain {
        let pair = least_certain(belief);
        let (mut at, others): (Vec<_>, Vec<_>) = probes
            .into_iter()
            .partition(|(object, ..)| pair.is_some_and(|pair| pair.contains(object)));
        at.extend(others);
        probes = at;
    }
    let few = Samples {
        now: samples.now.clone(),
        physics: samples.physics.iter().take(RACED.1).cloned().collect(),
    };
    let values = |probes: &[Probe], samples: &Samples| -> Vec<f64> {
        let jobs: Vec<_> =
            probes.iter().flat_map(|(_, plan, tool)| samples.jobs(plan, tool)).collect();
        let rolled = model.rollout(&samples.now.scene, &jobs, Record::Outcome);
        let each = rolled.chunks(samples.physics.len().max(1));
        each.map(|ends| value(settings, samples, ends, reach)).collect()
    };
    probes.truncate(RACED.0);
    let raced = values(&probes, &few);
    // What goes wrong in a sample is no probe.
    let mut raced: Vec<(f64, Probe)> =
        raced.into_iter().zip(probes).filter(|(value, _)| value.is_finite()).collect();
    if matches!(settings.rule, ProbeRule::Random | ProbeRule::Uncertain) {
        return raced.into_iter().next().map(|(_, (_, plan, tool))| (plan, tool));
    }
    // Stable, so equal ones keep their order.
    raced.sort_by(|a, b| b.0.total_cmp(&a.0));
    raced.truncate(FINAL);
    let last: Vec<Probe> = raced.into_iter().map(|(_, probe)| probe).collect();
    let values = values(&last, samples);
    let mut best: Option<(f64, Probe)> = None;
    for (value, probe) in values.into_iter().zip(last) {
        if value.is_finite() && value > best.as_ref().map_or(0.0, |(best, _)| *best) {
            best = Some((value, probe));
        }
    }
    best.map(|(_, (_, plan, tool))| (plan, tool))
}

/// The object that it is made at, and what is done.
type Probe = (usize, Plan, Arc<Tool>);

/// Every probe that a task allows at the object of its goal and those that may hang on it.
fn candidates(task: &Task, samples: &Samples, tools: &[Arc<Tool>]) -> Vec<Probe> {
    let scene = &samples.now.scene;
    let mut sets = DisjointSets::new(scene.objects.len());
    // As they stand now; those that hung together from the start still stand near each other.
    for (between, _) in near_pairs(scene) {
        sets.join(between);
    }
    let placed = task.pushes.form == PushForm::Placed;
    let mut found = Vec::new();
    for (object, body) in scene.objects.iter().enumerate() {
        if sets.lowest(object) != sets.lowest(task.goal.object) {
            continue;
        }
        let inner = body.shape.footprint().inner_radius();
        for tool in tools {
            for direction in task.pushes.directions.headings() {
                for offset in OFFSETS {
                    let start = match placed {
                        true => {
                            AskedStart::Before { object: body.name.clone(), offset: offset * inner }
                        }
                        false => AskedStart::Last,
                    };
                    let length = Some(LENGTH.min(task.pushes.length));
                    let push = [AskedPush { start, direction, length, speed: None }];
                    let yaws = &task.pushes.grip_yaws;
                    if let Ok(asked) = asked_plan(task, &samples.now, tool, yaws, &push)
                        && asked.broken.is_empty()
                    {
                        found.push((object, asked.plan, Arc::clone(tool)));
                    }
                }
            }
        }
    }
    found
}

/// What a probe is worth that ends so in every sample; infinitely little if something goes wrong.
fn value(
    settings: &RunSettings,
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
    if settings.rule == ProbeRule::Motion {
        let start = &samples.now.start;
        return states.iter().map(|end| square(end, start).sqrt()).sum();
    }
    let noise = settings.noise.position.hypot(MODEL);
    let mut sum = 0.0;
    for (s, one) in states.iter().enumerate() {
        for (t, other) in states.iter().enumerate().skip(s + 1) {
            let differ = reach.iter().filter(|plan| plan[s].reached != plan[t].reached).count();
            let apart = square(one, other) / (noise * noise);
            sum += differ as f64 * (1.0 - (-apart / 8.0).exp());
        }
    }
    sum
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

    fn reach(rows: &[&[u8]]) -> Vec<Vec<Reach>> {
        let one = |reached: &u8| Reach { reached: *reached == 1, score: 0.0 };
        rows.iter().map(|row| row.iter().map(one).collect()).collect()
    }

    #[test]
    fn learning_pays_where_samples_want_different_plans_and_only_there() {
        assert!(pays(&reach(&[&[1, 1, 0, 0], &[0, 0, 1, 1]])));
        assert!(!pays(&reach(&[&[1, 1, 1, 0], &[0, 1, 1, 0]])), "one plan is best in all");
        assert!(!pays(&reach(&[&[0, 0], &[0, 0]])), "nothing works anyway");
        assert!(!pays(&[]) && !pays(&reach(&[&[]])));
    }
}
