//! Summary of many trajectories.

use pushplan_act::judge::{mean, percentile};
use pushplan_learn::dataset::{MASS_RANGES, Touched};
use serde::{Deserialize, Serialize};

use crate::bench::Calibration;

use super::suite::{MassCase, MassRecord, SeenMass, SeenRatio};

/// Number of standard deviations that contain nine in ten normal numbers.
const NINE_IN_TEN: f64 = 1.645;

/// Summary of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassSummary {
    /// The case.
    pub case: MassCase,
    /// Number of trajectories.
    pub trajectories: usize,
    /// Number of objects touched by another object.
    pub touched: usize,
    /// Share of these objects whose most likely range is the true one; an object without a belief
    /// counts by chance.
    pub right: f64,
    /// Mean negative logarithm of the probability of their true range.
    pub surprise: f64,
    /// [`Calibration::error`] of their probabilities.
    pub calibration: f64,
    /// Share of objects without a belief, among the objects that no other object touched.
    pub unknown: f64,
    /// Number of objects that no other object touched.
    pub untouched: usize,
    /// Number of pairs with a believed ratio.
    pub ratios: usize,
    /// Factor by which the median ratio is wrong.
    pub ratio_error: f64,
    /// Factor by which the median ratio would be wrong if every mass were the middle one.
    pub ratio_blind: f64,
    /// Share of pairs with the heavier object correctly identified, among pairs with a ratio above
    /// two.
    pub heavier: f64,
    /// Share of ratios within 1.645 standard deviations: nine in ten, if errors are normal.
    pub within: f64,
}

/// Returns a row for every case.
pub fn summarise_masses(cases: &[MassCase], records: &[&MassRecord]) -> Vec<MassSummary> {
    let of = |(index, case): (usize, &MassCase)| {
        let records: Vec<&MassRecord> =
            records.iter().copied().filter(|record| record.case == index).collect();
        summary(*case, &records)
    };
    cases.iter().enumerate().map(of).collect()
}

fn summary(case: MassCase, records: &[&MassRecord]) -> MassSummary {
    let objects = || records.iter().flat_map(|record| &record.objects);
    let (touched, others): (Vec<&SeenMass>, Vec<&SeenMass>) =
        objects().partition(|object| object.touched == Touched::Object);
    let mut calibration = Calibration::default();
    let (mut right, mut surprise) = (Vec::new(), Vec::new());
    for object in &touched {
        let shares = object
            .believed
            .clone()
            .unwrap_or_else(|| vec![1.0 / MASS_RANGES.len() as f64; MASS_RANGES.len()]);
        let most = shares.iter().copied().fold(0.0, f64::max);
        let likeliest = shares.iter().filter(|share| **share == most).count();
        right.push(if shares[object.range] == most { 1.0 / likeliest as f64 } else { 0.0 });
        surprise.push(-shares[object.range].max(1e-9).ln());
        calibration.count(&shares, object.range);
    }
    let unknown = others.iter().filter(|object| object.believed.is_none()).count();
    let ratios: Vec<&SeenRatio> = records.iter().flat_map(|record| &record.ratios).collect();
    let off = |ratio: &SeenRatio| (ratio.believed[0] - ratio.truth).abs();
    let apart: Vec<&&SeenRatio> =
        ratios.iter().filter(|ratio| ratio.truth.abs() > 2f64.ln()).collect();
    let heavier = apart.iter().filter(|ratio| ratio.believed[0] * ratio.truth > 0.0).count();
    let within = ratios.iter().filter(|ratio| off(ratio) <= NINE_IN_TEN * ratio.believed[1]);
    MassSummary {
        case,
        trajectories: records.len(),
        touched: touched.len(),
        right: mean(&right),
        surprise: mean(&surprise),
        calibration: calibration.error(),
        untouched: others.len(),
        unknown: share(unknown, others.len()),
        ratios: ratios.len(),
        ratio_error: median(ratios.iter().map(|ratio| off(ratio)).collect()).exp(),
        ratio_blind: median(ratios.iter().map(|ratio| ratio.truth.abs()).collect()).exp(),
        heavier: share(heavier, apart.len()),
        within: share(within.count(), ratios.len()),
    }
}

fn share(part: usize, all: usize) -> f64 {
    if all == 0 { 0.0 } else { part as f64 / all as f64 }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    if values.is_empty() { 0.0 } else { percentile(&values, 50.0) }
}
