//! Accuracy of inferred lever points.

use pushplan_act::judge::Summary;
use pushplan_report::Align::Right;
use pushplan_report::{Document, NONE, Section, Table, degrees};
use serde_json::json;

use crate::bench::{PointReport, PointRow};
use crate::report::length;

/// Returns a table for each family.
pub fn lever_points_document(reports: &[PointReport]) -> Document {
    Document {
        title: "lever points inferred from the first frames".to_owned(),
        notes: vec![
            "`angle` is how far the inferred place on the outline is from the true one, as seen from \
             the centre of mass. `rest` is the root mean square distance of the centre of mass over \
             the frames that follow, predicted from there and from what was last seen, `end` that at \
             the end of the turn. `place known` is the error of the model alone over the same frames."
                .to_owned(),
        ],
        sections: reports.iter().map(section).collect(),
        json: json!({"lever_points": reports}),
        ..Document::default()
    }
}

fn section(report: &PointReport) -> Section {
    let PointReport { preset, seed, cases, model, .. } = report;
    let angle = |row: &PointRow, of: &dyn Fn(&Summary) -> f64| {
        row.angle.as_ref().map_or(NONE.to_owned(), |angle| degrees(of(angle)))
    };
    let table = Table::of(
        &report.rows,
        &[
            ("frames seen", Right, &|row: &&PointRow| row.seen.to_string()),
            ("angle, mean", Right, &|row| angle(row, &|angle| angle.mean)),
            ("median", Right, &|row| angle(row, &|angle| angle.median)),
            ("p95", Right, &|row| angle(row, &|angle| angle.p95)),
            ("rest, mean", Right, &|row| length(&row.rest, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.rest, |errors| errors.median)),
            ("end, mean", Right, &|row| length(&row.last, |errors| errors.mean)),
            ("place known", Right, &|row| length(&row.known, |errors| errors.mean)),
        ],
    );
    Section {
        title: format!("{preset}: {cases} lever-ups of seed {seed}, by the model {model}"),
        table,
        ..Section::default()
    }
}
