//! Summary of the trajectories of a case.

use pushplan_act::belief::JointType;
use pushplan_act::judge::{Summary, mean, percentile};
use pushplan_bench::store::Finished;
use serde::{Deserialize, Serialize};

use crate::bench::Calibration;

use super::record::{BeliefRecord, Checkpoint, JointMethod, When};
use super::suite::BeliefCase;

/// Results of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefSummary {
    /// The case.
    pub case: BeliefCase,
    /// Number of trajectories.
    pub trajectories: usize,
    /// Steps in order of time, the end last.
    pub steps: Vec<BeliefStep>,
    /// Errors of anchors at the end, metres.
    pub anchors: Option<Summary>,
    /// Errors of axes at the end, radians.
    pub axes: Option<Summary>,
}

/// Beliefs at a point of all trajectories of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefStep {
    /// Time of the beliefs.
    pub when: When,
    /// Number of near pairs of which either object had moved.
    pub pairs: usize,
    /// Accuracy of types, by method.
    pub right: Vec<Right>,
    /// Quality of probabilities, by method.
    pub sure: Vec<Sure>,
    /// Predictions of the remaining motion, by method.
    pub rest: Vec<RestOfWay>,
}

/// Shares of pairs with the right type.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Right {
    /// Method of estimation.
    pub by: JointMethod,
    /// Share of near pairs of which either object had moved.
    pub moved: f64,
    /// Share of joined pairs among the moved ones.
    pub joined: f64,
    /// Share of near pairs that had not moved.
    pub unmoved: f64,
    /// Share of all ordered pairs, including those with the hand, as in Tekden (2020).
    pub all: f64,
}

/// Quality of the probabilities of near pairs that moved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sure {
    /// Method of estimation.
    pub by: JointMethod,
    /// Mean negative logarithm of the probability of the true type.
    pub nll: f64,
    /// Expected calibration error over all four probabilities, in ten bins.
    pub calibration: f64,
}

/// Final errors of predictions of the remaining motion, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestOfWay {
    /// Method that estimates the joints.
    pub by: JointMethod,
    /// Mean over trajectories.
    pub mean: f64,
    /// Median over trajectories.
    pub median: f64,
    /// Closed share of the gap between no joints and true joints.
    pub closed: f64,
}

/// Summarises the records of every case; cases without records are left out.
pub fn summarise_beliefs(cases: &[BeliefCase], records: &[&BeliefRecord]) -> Vec<BeliefSummary> {
    let mut summaries = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let of: Vec<&BeliefRecord> =
            records.iter().copied().filter(|record| record.case == index).collect();
        if of.is_empty() {
            continue;
        }
        let gather = |values: &dyn Fn(&BeliefRecord) -> Vec<f64>| {
            Summary::of(&of.iter().flat_map(|record| values(record)).collect::<Vec<f64>>())
        };
        summaries.push(BeliefSummary {
            case: *case,
            trajectories: of.len(),
            steps: belief_steps(&of),
            anchors: gather(&|record| record.anchors.clone()),
            axes: gather(&|record| record.axes.clone()),
        });
    }
    summaries
}

/// Summarises beliefs of several trajectories, in order of time.
pub fn belief_steps(records: &[&BeliefRecord]) -> Vec<BeliefStep> {
    let checkpoints = records.iter().flat_map(|record| &record.checkpoints);
    let mut whens: Vec<When> = checkpoints.map(|checkpoint| checkpoint.when).collect();
    whens.sort_unstable();
    whens.dedup();
    whens.into_iter().map(|when| step(when, records)).collect()
}

fn step(when: When, records: &[&BeliefRecord]) -> BeliefStep {
    let at: Vec<(&BeliefRecord, &Checkpoint)> = records
        .iter()
        .filter_map(|record| {
            Some((*record, record.checkpoints.iter().find(|one| one.when == when)?))
        })
        .collect();
    let methods = |of: &dyn Fn(&Checkpoint) -> Vec<JointMethod>| -> Vec<JointMethod> {
        at.first().map_or_else(Vec::new, |(_, checkpoint)| of(checkpoint))
    };
    let by_types = methods(&|one| one.types.iter().map(|(by, _)| *by).collect());
    let by_shares = methods(&|one| one.probabilities.iter().map(|(by, _)| *by).collect());
    let by_rest = methods(&|one| one.rest.iter().map(|rest| rest.by).collect());
    // Ascending, as required by percentiles.
    let errors = |by: JointMethod| -> Vec<f64> {
        let of = |one: &Checkpoint| one.rest.iter().find(|rest| rest.by == by).map(|r| r.error);
        let mut errors: Vec<f64> = at.iter().filter_map(|(_, one)| of(one)).collect();
        errors.sort_by(f64::total_cmp);
        errors
    };
    let [none, truth] = [JointMethod::None, JointMethod::True].map(|by| mean(&errors(by)));
    let rest = by_rest.into_iter().map(|by| {
        let errors = errors(by);
        let mean = mean(&errors);
        let closed = if none > truth { (none - mean) / (none - truth) } else { 0.0 };
        RestOfWay { by, mean, median: percentile(&errors, 50.0), closed }
    });
    BeliefStep {
        when,
        pairs: at.iter().flat_map(|(_, one)| &one.moved).filter(|moved| **moved).count(),
        right: by_types.into_iter().map(|by| right(by, &at)).collect(),
        sure: by_shares.into_iter().map(|by| sure(by, &at)).collect(),
        rest: rest.collect(),
    }
}

/// Mean time of an update by case and method, seconds per observation.
pub type UpdateTimes = Vec<(BeliefCase, Vec<(JointMethod, f64)>)>;

/// Returns the mean times of updates, for cases that were timed.
pub fn update_times(cases: &[BeliefCase], finished: &[Finished<BeliefRecord>]) -> UpdateTimes {
    let of = |(index, case): (usize, &BeliefCase)| {
        let of: Vec<_> = finished.iter().filter(|one| one.record.case == index).collect();
        let count: usize = of.iter().map(|one| one.record.observations).sum();
        let times: Vec<(JointMethod, f64)> = JointMethod::ALL
            .into_iter()
            .filter_map(|by| {
                let spent: Vec<f64> =
                    of.iter().filter_map(|one| one.seconds.get(by.title()).copied()).collect();
                (!spent.is_empty()).then(|| (by, spent.iter().sum::<f64>() / count.max(1) as f64))
            })
            .collect();
        (!times.is_empty()).then_some((*case, times))
    };
    cases.iter().enumerate().filter_map(of).collect()
}

/// A share with its counts.
#[derive(Default)]
struct Share {
    right: usize,
    all: usize,
}

impl Share {
    fn count(&mut self, right: bool) {
        self.right += usize::from(right);
        self.all += 1;
    }

    fn share(&self) -> f64 {
        if self.all == 0 { 1.0 } else { self.right as f64 / self.all as f64 }
    }
}

fn right(by: JointMethod, at: &[(&BeliefRecord, &Checkpoint)]) -> Right {
    let [mut moved, mut joined, mut unmoved, mut all] = [const { Share { right: 0, all: 0 } }; 4];
    for (record, one) in at {
        let Some((_, types)) = one.types.iter().find(|(method, _)| *method == by) else { continue };
        let bodies = record.objects + 1;
        // Far pairs and pairs of the hand are not joined, and no method joins them.
        all.right += bodies * (bodies - 1) - 2 * types.len();
        all.all += bodies * (bodies - 1) - 2 * types.len();
        for ((found, truth), has_moved) in types.iter().zip(&record.types).zip(&one.moved) {
            let right = found == truth;
            (0..2).for_each(|_| all.count(right));
            if *has_moved {
                moved.count(right);
                if *truth != JointType::None {
                    joined.count(right);
                }
            } else {
                unmoved.count(right);
            }
        }
    }
    Right {
        by,
        moved: moved.share(),
        joined: joined.share(),
        unmoved: unmoved.share(),
        all: all.share(),
    }
}

fn sure(by: JointMethod, at: &[(&BeliefRecord, &Checkpoint)]) -> Sure {
    let mut logs = Vec::new();
    let mut calibration = Calibration::default();
    for (record, one) in at {
        let found = one.probabilities.iter().find(|(method, _)| *method == by);
        let Some((_, shares)) = found else { continue };
        for ((shares, truth), moved) in shares.iter().zip(&record.types).zip(&one.moved) {
            if !moved {
                continue;
            }
            logs.push(-shares[*truth as usize].max(1e-9).ln());
            calibration.count(shares, *truth as usize);
        }
    }
    Sure {
        by,
        nll: if logs.is_empty() { 0.0 } else { mean(&logs) },
        calibration: calibration.error(),
    }
}
