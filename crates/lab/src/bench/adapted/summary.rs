//! Summary of the splits of a kind: ratios of mean errors, and their confidence.

use std::collections::BTreeMap;

use pushplan::internals::scene::Span;
use pushplan::internals::seeded::generator;
use pushplan_act::judge::{mean, percentile};
use rand::Rng;
use serde::{Deserialize, Serialize};

use super::AdaptedPush;

/// Number of bootstrap resamples: the ends of a 95 % interval are then the 25th of a thousand.
const RESAMPLES: u32 = 1000;

/// A ratio of mean errors with its 95 % interval, by bootstrap over recordings. Repeated
/// predictions of a recording stay together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// The ratio.
    pub value: f64,
    /// Its interval.
    pub interval: Span,
}

/// Summary of the splits of a kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptedRow {
    /// Name of the test set.
    pub title: String,
    /// Number of training pushes.
    pub learnt: usize,
    /// Number of predictions.
    pub predicted: usize,
    /// Share of the splits in which a head was learned.
    pub heads: f64,
    /// Mean position error of the analytic model as shipped, metres.
    pub shipped: f64,
    /// Ratio of position errors: network with its head to the analytic model as shipped.
    pub against_shipped: Ratio,
    /// Ratio of position errors: network with its head to the analytic model after the fit.
    pub against_prior: Ratio,
    /// Ratio of position errors: network without its head to the analytic model after the fit.
    pub network: Ratio,
    /// Ratio of rotation errors: network with its head to the analytic model after the fit.
    pub turn: Ratio,
    /// Share of values inside the stated 90 %.
    pub inside: f64,
}

/// Returns a row for each title and number, in order of first occurrence.
pub fn adapted_rows(splits: &[(String, usize, bool, Vec<AdaptedPush>)]) -> Vec<AdaptedRow> {
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for (title, asked, ..) in splits {
        if !kinds.contains(&(title, *asked)) {
            kinds.push((title, *asked));
        }
    }
    let row = |(title, learnt): (&str, usize)| {
        let own: Vec<_> =
            splits.iter().filter(|split| split.0 == title && split.1 == learnt).collect();
        let pushes: Vec<&AdaptedPush> = own.iter().flat_map(|split| &split.3).collect();
        let heads = own.iter().filter(|split| split.2).count() as f64 / own.len() as f64;
        let position = |of: fn(&AdaptedPush) -> [f64; 2]| move |push: &AdaptedPush| of(push)[0];
        let shipped: Vec<f64> = pushes.iter().map(|push| push.shipped[0]).collect();
        let [inside, of] =
            [0, 1].map(|k| pushes.iter().map(|push| push.inside[k]).sum::<usize>() as f64);
        AdaptedRow {
            title: title.to_owned(),
            learnt,
            predicted: pushes.len(),
            heads,
            shipped: mean(&shipped),
            against_shipped: ratio(&pushes, position(|p| p.adapted), position(|p| p.shipped)),
            against_prior: ratio(&pushes, position(|p| p.adapted), position(|p| p.prior)),
            network: ratio(&pushes, position(|p| p.network), position(|p| p.prior)),
            turn: ratio(&pushes, |push| push.adapted[1], |push| push.prior[1]),
            inside: inside / of,
        }
    };
    kinds.into_iter().map(row).collect()
}

fn ratio(
    pushes: &[&AdaptedPush],
    above: impl Fn(&AdaptedPush) -> f64,
    below: impl Fn(&AdaptedPush) -> f64,
) -> Ratio {
    let mut by_recording: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for push in pushes {
        let sums = by_recording.entry(push.recording).or_default();
        sums[0] += above(push);
        sums[1] += below(push);
    }
    let sums: Vec<[f64; 2]> = by_recording.into_values().collect();
    let of = |sums: &mut dyn Iterator<Item = [f64; 2]>| {
        let [above, below] = sums.fold([0.0; 2], |all, one| [all[0] + one[0], all[1] + one[1]]);
        above / below
    };
    let mut random = generator(0, 0);
    let mut resampled: Vec<f64> = (0..RESAMPLES)
        .map(|_| of(&mut (0..sums.len()).map(|_| sums[random.random_range(0..sums.len())])))
        .collect();
    resampled.sort_by(f64::total_cmp);
    let interval = Span::new(percentile(&resampled, 2.5), percentile(&resampled, 97.5));
    Ratio { value: of(&mut sums.iter().copied()), interval }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_that_of_sums_and_repeats_of_one_recording_make_it_no_surer() {
        let push = |recording: usize, adapted: f64| AdaptedPush {
            recording,
            shipped: [2.0, 1.0],
            prior: [1.0, 1.0],
            network: [1.0, 1.0],
            adapted: [adapted, 0.5],
            inside: [2, 3],
        };
        let once: Vec<AdaptedPush> = (0..10).map(|k| push(k, 0.5 + 0.1 * k as f64)).collect();
        let split = |pushes: Vec<AdaptedPush>| ("new pushes".to_owned(), 20, true, pushes);
        let row = adapted_rows(&[split(once.clone())]).remove(0);
        assert!((row.against_prior.value - 0.95).abs() < 1e-12);
        assert!((row.against_shipped.value - 0.475).abs() < 1e-12 && row.turn.value == 0.5);
        let twice = adapted_rows(&[split(once.clone()), split(once)]).remove(0);
        assert_eq!((twice.against_prior, twice.predicted), (row.against_prior, 20));
    }
}
