//! Convergence of simulated lever-ups.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table, millimetres, seconds};
use serde_json::json;

use crate::bench::{ConvergenceReport, ConvergenceRow, Setting};
use crate::report::length;

/// Returns a table for each family.
pub fn convergence_document(reports: &[ConvergenceReport]) -> Document {
    Document {
        title: "Simulated lever-ups, compared with a time step of 1/1920 s".to_owned(),
        notes: vec![
            "`lift` is the root mean square distance of the plate frame over the frames of the \
             rotation, `end` the distance at the end of the rotation. In the last row, the plate \
             starts with an offset of 0.1 mm, and the reference is the run at 1/240 s without it."
                .to_owned(),
        ],
        sections: reports.iter().map(section).collect(),
        json: json!({"convergence": reports}),
        ..Document::default()
    }
}

fn section(report: &ConvergenceReport) -> Section {
    let ConvergenceReport { preset, seed, cases, slipped, flipped, leaning, jammed, .. } = report;
    let motion = millimetres(report.motion);
    let table = Table::of(
        &report.rows,
        &[
            ("step", Left, &|row: &&ConvergenceRow| match row.setting {
                Setting::Steps(rate) => format!("1/{rate} s"),
                Setting::Aside => "1/240 s, start offset 0.1 mm".to_owned(),
            }),
            ("lift, mean", Right, &|row| length(&row.lift, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.lift, |errors| errors.median)),
            ("p95", Right, &|row| length(&row.lift, |errors| errors.p95)),
            ("end, mean", Right, &|row| length(&row.last, |errors| errors.mean)),
            ("rest, mean", Right, &|row| length(&row.rest, |errors| errors.mean)),
            ("median", Right, &|row| length(&row.rest, |errors| errors.median)),
            ("slips differ", Right, &|row| row.slips.to_string()),
            ("endings differ", Right, &|row| row.endings.to_string()),
            ("time", Right, &|row| {
                row.time.as_ref().map_or(NONE.to_owned(), |time| seconds(time.mean))
            }),
        ],
    );
    Section {
        title: format!(
            "{preset}: {cases} lever-ups of seed {seed}, {motion} of motion; {slipped} slip, \
             {flipped} flip, {leaning} end leaning, {jammed} jam"
        ),
        table,
        ..Section::default()
    }
}
