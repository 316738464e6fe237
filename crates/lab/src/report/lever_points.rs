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
        title: "Lever points inferred from the first frames".to_owned(),
        notes: vec![
            "`angle` is the angle between the inferred and the true lever point at the centre of \
             mass. `rest` is the root mean square distance of the centre of mass over the later \
             frames, predicted with the inferred point from the last observed pose. `end` is the \
             distance at the end of the rotation. `point known` is the error of the model over the \
             same frames with the true lever point."
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
            ("point known", Right, &|row| length(&row.known, |errors| errors.mean)),
        ],
    );
    Section {
        title: format!("{preset}: {cases} lever-ups of seed {seed}, with the model {model}"),
        table,
        ..Section::default()
    }
}
