//! Summary of many scenes.

use pushplan_act::judge::{mean, percentile};
use serde::{Deserialize, Serialize};

use super::suite::{Learnt, ProbeCase, ProbeRecord};

/// Summary of a case after a number of probes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeSummary {
    /// The case.
    pub case: ProbeCase,
    /// Number of probes.
    pub probes: usize,
    /// Number of scenes.
    pub scenes: usize,
    /// Number of near pairs.
    pub pairs: usize,
    /// Share of these pairs whose most likely type is the true one.
    pub right: f64,
    /// Mean negative logarithm of the probability of their true type.
    pub surprise: f64,
    /// Median over test pushes of the mean error over objects, metres.
    pub error_median: f64,
    /// Mean over test pushes of the mean error over objects, metres.
    pub error_mean: f64,
    /// Median with the true joints, metres.
    pub known_median: f64,
}

/// Returns a row for every case and number of probes.
pub fn summarise_probes(cases: &[ProbeCase], records: &[&ProbeRecord]) -> Vec<ProbeSummary> {
    let mut summaries = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let of: Vec<&ProbeRecord> =
            records.iter().copied().filter(|record| record.case == index).collect();
        let most = of.iter().map(|record| record.learnt.len()).max().unwrap_or(0);
        for probes in 0..most {
            let learnt = || of.iter().filter_map(|record| record.learnt.get(probes));
            let pairs: usize = of.iter().map(|record| record.pairs).sum();
            let right: usize = learnt().map(|learnt| learnt.right).sum();
            let surprise: f64 = learnt().map(|learnt| learnt.surprise).sum();
            let all = |errors: fn(&Learnt) -> &Vec<f64>| -> Vec<f64> {
                let mut all: Vec<f64> = learnt().flat_map(errors).copied().collect();
                all.sort_by(f64::total_cmp);
                all
            };
            let (errors, known) = (all(|one| &one.errors), all(|one| &one.known));
            let each = |sum: f64| if pairs == 0 { 0.0 } else { sum / pairs as f64 };
            summaries.push(ProbeSummary {
                case: *case,
                probes,
                scenes: of.len(),
                pairs,
                right: each(right as f64),
                surprise: each(surprise),
                error_median: percentile(&errors, 50.0),
                error_mean: mean(&errors),
                known_median: percentile(&known, 50.0),
            });
        }
    }
    summaries
}
