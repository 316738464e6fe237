//! Benefit of fitting a network to a table.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, Section, Table};
use serde_json::json;

use crate::bench::{AdaptedRow, Ratio};

/// Returns ratios of mean final errors, over `draws` random draws of `seed`.
pub fn adapted_document(rows: &[AdaptedRow], draws: u32, seed: u64) -> Document {
    let ratio =
        |of: &Ratio| format!("{:.3} ({:.3} to {:.3})", of.value, of.interval.low, of.interval.high);
    let table = Table::of(
        rows,
        &[
            ("predicted", Left, &|row: &&AdaptedRow| row.title.clone()),
            ("training pushes", Right, &|row| row.learnt.to_string()),
            ("pushes", Right, &|row| row.predicted.to_string()),
            ("with a head", Right, &|row| format!("{:.0} %", 100.0 * row.heads)),
            ("shipped analytic model", Right, &|row| format!("{:.3} mm", 1e3 * row.shipped)),
            ("ratio to it", Right, &|row| ratio(&row.against_shipped)),
            ("ratio to the fitted analytic model", Right, &|row| ratio(&row.against_prior)),
            ("without head", Right, &|row| ratio(&row.network)),
            ("rotation", Right, &|row| ratio(&row.turn)),
            ("inside 90 %", Right, &|row| format!("{:.1} %", 100.0 * row.inside)),
        ],
    );
    Document {
        title: format!(
            "Mean final error of the network fitted to a table, {draws} draws of seed {seed}, \
             95 % confidence intervals"
        ),
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"adapted": rows}),
        ..Document::default()
    }
}
