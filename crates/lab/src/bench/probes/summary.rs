//! Many scenes in a few numbers.

use pushplan_act::judge::{mean, percentile};
use serde::{Deserialize, Serialize};

use super::suite::{Learnt, ProbeCase, ProbeRecord};

/// A case after a number of probes, in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeSummary {
    /// The case.
    pub case: ProbeCase,
    /// Probes made.
    pub probes: usize,
    /// Scenes.
    pub scenes: usize,
    /// Pairs that stood near each other.
    pub pairs: usize,
    /// Share of them whose likeliest type is the true one.
    pub right: f64,
    /// The mean negative logarithm of the probability of their true type.
    pub surprise: f64,
    /// Error of the mean object in the median and in the mean test push, metres.
    pub error_median: f64,
    /// See there.
    pub error_mean: f64,
    /// The median with the true joints, metres.
    pub known_median: f64,
}

/// One line for every case and number of probes.
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
