//! Accuracy of estimated masses, as a table.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table};
use serde_json::json;

use crate::bench::MassSummary;

/// Explanation of the columns.
const LEGEND: &str = "Masses are 0.2 to 0.5, 1 to 2 or 8 to 10 kg, so that chance is right in a third. \
    Counted are objects that another object touched; *unknown* is the share of the others, of which \
    nothing can be known, of which nothing is believed. *nll* is the mean negative logarithm of the \
    probability of the true range, 1.10 by chance; *calibration* the expected calibration error. The \
    ratio of two masses that touched is off by the factor given in the median, beside that of taking \
    all for equal; *within* is the share of ratios within 1.645 of their standard deviations. *Heavier* \
    is how often of two of which one is more than twice as heavy that one is believed to be it.";

/// Returns the results of masses.
pub fn masses_document(summaries: &[MassSummary]) -> Document {
    let mut table = Table::new([
        ("scenes", Left),
        ("seen", Left),
        ("objects", Right),
        ("right, %", Right),
        ("nll", Right),
        ("calibration, %", Right),
        ("unknown, %", Right),
        ("ratios", Right),
        ("off by", Right),
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
        title: format!("Masses told from {trajectories} observed trajectories"),
        notes: vec![LEGEND.to_owned()],
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"masses": summaries}),
        ..Document::default()
    }
}
