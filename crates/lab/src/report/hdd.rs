//! Errors of models of boards in drives.

use pushplan_act::judge::Summary;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table, degrees, seconds};
use serde_json::json;

use crate::bench::{DriveReport, DriveRow};
use crate::report::length;

/// Returns a table with a row for each model.
pub fn hdd_document(report: &DriveReport) -> Document {
    let DriveReport { seed, cases, drives, outside, rows } = report;
    let angle = |of: &Option<Summary>, which: fn(&Summary) -> f64| {
        of.as_ref().map_or(NONE.to_owned(), |angles| degrees(which(angles)))
    };
    let table = Table::of(
        rows,
        &[
            ("model", Left, &|row: &&DriveRow| row.model.clone()),
            ("lift, mean", Right, &|row| length(&row.lift, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.lift, |errors| errors.median)),
            ("p95", Right, &|row| length(&row.lift, |errors| errors.p95)),
            ("rotation, mean", Right, &|row| angle(&row.turn, |angles| angles.mean)),
            ("p95", Right, &|row| angle(&row.turn, |angles| angles.p95)),
            ("end, mean", Right, &|row| length(&row.last, |errors| errors.mean)),
            ("rest, mean", Right, &|row| length(&row.rest, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.rest, |errors| errors.median)),
            ("in/out correct", Right, &|row| format!("{:.1} %", 1e2 * row.outside)),
            ("time", Right, &|row| seconds(row.time)),
        ],
    );
    let section = Section {
        title: format!(
            "{cases} lever-ups on {drives} drives of seed {seed}; {outside} boards leave the pocket"
        ),
        table,
        ..Section::default()
    };
    Document {
        title: "Models of boards levered out of drives, compared with the 3-D engine at 1/240 s"
            .to_owned(),
        notes: vec![
            "`lift` and `rotation` are root mean square errors over the 15 frames of the rotation: \
             the distance of the centre of mass, and the angle. `end` is the distance at the last \
             of these frames. A board is out if its centre of mass rests beyond the walls. Time is \
             on one core."
                .to_owned(),
        ],
        sections: vec![section],
        json: json!({"hdd": report}),
        ..Document::default()
    }
}
