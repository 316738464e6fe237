//! Errors on held-out pushes.

use pushplan_act::judge::Summary;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table, fine_millimetres, millimetres};
use serde_json::json;

use crate::bench::{ErrorRow, HeldOutReport};

/// Returns the errors of all models on a kind of pushes, and of the first model by shape and by
/// number of objects.
pub fn heldout_document(report: &HeldOutReport) -> Document {
    let motion = report.motion.as_ref();
    let title = format!(
        "{}: {} pushes of seed {}; {} objects moved more than 1 cm, {} on average",
        report.suite.title(),
        report.pushes,
        report.seed,
        motion.map_or(0, |motion| motion.count),
        motion.map_or(NONE.to_owned(), |motion| millimetres(motion.mean))
    );
    let all = report.models.iter().filter_map(|errors| {
        let row = errors.rows.iter().find(|row| row.group == "all")?;
        Some((errors.model.to_string(), row))
    });
    let table = error_table("model", all);
    let mut sections = vec![Section { table, ..Section::default() }];
    // The 2-D spread comes first, then the models in their order.
    sections.extend(report.models.get(1).map(|errors| Section {
        title: format!("{} by shape and number of objects", errors.model),
        table: error_table("objects", errors.rows.iter().map(|row| (row.group.clone(), row))),
        ..Section::default()
    }));
    Document { title, sections, json: json!({"suites": [report]}), ..Document::default() }
}

fn error_table<'a>(first: &str, rows: impl Iterator<Item = (String, &'a ErrorRow)>) -> Table {
    Table::of(
        rows,
        &[
            (first, Left, &|(name, _)| name.clone()),
            ("moved", Right, &|(_, row)| count(&row.position)),
            ("mean", Right, &|(_, row)| length(&row.position, |errors| errors.mean)),
            ("median", Right, &|(_, row)| length(&row.position, |errors| errors.median)),
            ("p95", Right, &|(_, row)| length(&row.position, |errors| errors.p95)),
            ("heading median", Right, &|(_, row)| {
                let heading = row.heading_deg.as_ref();
                heading.map_or(NONE.to_owned(), |heading| format!("{:.2}\u{00b0}", heading.median))
            }),
            ("mean against 3-D", Right, &|(_, row)| length(&row.position_3d, |errors| errors.mean)),
            ("not moved", Right, &|(_, row)| count(&row.unmoved)),
            ("their mean", Right, &|(_, row)| length(&row.unmoved, |errors| errors.mean)),
        ],
    )
}

fn count(summary: &Option<Summary>) -> String {
    summary.as_ref().map_or(0, |summary| summary.count).to_string()
}

/// Returns a length of a summary, if any.
pub(super) fn length(summary: &Option<Summary>, value: impl Fn(&Summary) -> f64) -> String {
    summary.as_ref().map_or(NONE.to_owned(), |summary| fine_millimetres(value(summary)))
}
