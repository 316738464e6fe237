//! Errors of models of lever-ups.

use pushplan_act::judge::Summary;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table, degrees, millimetres, seconds};
use serde_json::json;

use crate::bench::{LeverReport, LeverRow, SupportRow};
use crate::report::length;

/// Returns two tables for each family: models, and the support edge.
pub fn levers_document(reports: &[LeverReport]) -> Document {
    Document {
        title: "Models of lever-ups, compared with the 3-D engine at 1/240 s".to_owned(),
        notes: vec![
            "`lift` is the root mean square distance of the centre of mass over the 15 frames of \
             the rotation. `end` is its distance and `rotation` the angle at the last of these \
             frames. Time is on one core."
                .to_owned(),
        ],
        sections: reports.iter().flat_map(|report| [models(report), supports(report)]).collect(),
        json: json!({"levers": reports}),
        ..Document::default()
    }
}

fn models(report: &LeverReport) -> Section {
    let LeverReport { preset, seed, cases, slipped, flipped, leaning, .. } = report;
    let mean = |of: &Option<Summary>| length(of, |errors| errors.mean);
    let median = |of: &Option<Summary>| length(of, |errors| errors.median);
    let table = Table::of(
        &report.rows,
        &[
            ("model", Left, &|row: &&LeverRow| row.model.clone()),
            ("lift, mean", Right, &|row| mean(&row.lift)),
            ("median", Right, &|row| median(&row.lift)),
            ("slipping", Right, &|row| mean(&row.slipping)),
            ("others", Right, &|row| mean(&row.kept)),
            ("end, mean", Right, &|row| mean(&row.last)),
            ("rotation, median", Right, &|row| {
                row.turn.as_ref().map_or(NONE.to_owned(), |turn| degrees(turn.median))
            }),
            ("rest, mean", Right, &|row| mean(&row.rest)),
            ("median", Right, &|row| median(&row.rest)),
            ("slip correct", Right, &|row| percent(row.slips)),
            ("ending correct", Right, &|row| percent(row.endings)),
            ("time", Right, &|row| seconds(row.time)),
        ],
    );
    Section {
        title: format!(
            "{preset}: {cases} lever-ups of seed {seed}, {} of motion; {slipped} slip, {flipped} \
             flip, {leaning} end leaning",
            millimetres(report.motion)
        ),
        table,
        ..Section::default()
    }
}

fn supports(report: &LeverReport) -> Section {
    let share = |right: usize, all: usize| {
        if all == 0 { NONE.to_owned() } else { percent(right as f64 / all as f64) }
    };
    let table = Table::of(
        &report.supports,
        &[
            ("corners", Left, &|row: &&SupportRow| match row.corners {
                0 => "all".to_owned(),
                corners => corners.to_string(),
            }),
            ("lever-ups", Right, &|row| row.all.to_string()),
            ("correct", Right, &|row| share(row.right, row.all)),
            ("not slipping", Right, &|row| row.kept.to_string()),
            ("correct", Right, &|row| share(row.kept_right, row.kept)),
        ],
    );
    Section {
        title: format!("{}: the support edge in closed form", report.preset),
        table,
        ..Section::default()
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 1e2 * share)
}
