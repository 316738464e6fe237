//! Table of the accuracy of estimated masses.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table};
use serde_json::json;

use crate::bench::MassSummary;

/// Explanation of the columns.
const LEGEND: &str = "Masses are 0.2 to 0.5, 1 to 2 or 8 to 10 kg; a random guess is correct in a \
    third of the cases. The objects are those touched by another object; *unknown* is the share \
    of unobservable masses correctly left undetermined. *nll* is the mean negative log \
    probability of the true range (random: 1.10), *calibration* the expected calibration error. \
    *Ratio error* is the median factor between the inferred and the true ratio of two touching \
    masses; *equal masses* is its value for a guess of equal masses. *Heavier* counts pairs with \
    a true ratio above 2: the share in which the heavier object is identified. *Within* is the \
    share of ratios within 1.645 standard deviations.";

/// Returns the results of masses.
pub fn masses_document(summaries: &[MassSummary]) -> Document {
    let mut table = Table::new([
        ("scenes", Left),
        ("seen", Left),
        ("objects", Right),
        ("correct, %", Right),
        ("nll", Right),
        ("calibration, %", Right),
        ("unknown, %", Right),
        ("ratios", Right),
        ("ratio error", Right),
        ("equal masses", Right),
        ("heavier, %", Right),
        ("within, %", Right),
    ]);
    let percent = |share: f64| format!("{:.1}", 1e2 * share);
    for one in summaries {
        table.row([
            one.case.scenes(),
            one.case.sight.title().to_owned(),
            one.touched.to_string(),
            percent(one.right),
            format!("{:.3}", one.surprise),
            percent(one.calibration),
            if one.untouched == 0 { NONE.to_owned() } else { percent(one.unknown) },
            one.ratios.to_string(),
            format!("{:.2} times", one.ratio_error),
            format!("{:.2} times", one.ratio_blind),
            percent(one.heavier),
            percent(one.within),
        ]);
    }
    let trajectories: usize = summaries.iter().map(|one| one.trajectories).sum();
    Document {
        title: format!("Masses inferred from {trajectories} observed trajectories"),
        notes: vec![LEGEND.to_owned()],
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"masses": summaries}),
        ..Document::default()
    }
}
