//! Errors on crowds as tables and curves.

use pushplan_act::judge::{Drift, ModelErrors, RelativeErrors, TrialErrors};
use pushplan_report::Align::{Left, Right};
use pushplan_report::{
    Document, Figure, NONE, Section, Table, beside, end, fine_millimetres, horizon_chart,
    millimetres, model_name, share, trials_line,
};
use serde_json::json;

use crate::bench::{CrowdFamily, CrowdReport, HeldOutReport};

/// Returns the newest of the reports on crowds, as soon as it is available. The first one includes
/// the explanation of its columns.
pub fn crowd_document(reports: &[CrowdReport]) -> Document {
    let Some((newest, before)) = reports.split_last() else { return Document::default() };
    let notes = if before.is_empty() { vec![LEGEND.to_owned()] } else { Vec::new() };
    let sections = vec![Section { table: crowd_table(newest), ..Section::default() }];
    let title = trials_line(&newest.errors, &format!(" of seed {}", newest.seed));
    Document { title, notes, sections, ..Document::default() }
}

/// Returns the whole evaluation: the sets of crowds side by side, errors by horizon, and all
/// reports in full for programs.
pub fn evaluation_document(suites: &[HeldOutReport], crowds: &[CrowdReport]) -> Document {
    let mut json = json!({});
    if !suites.is_empty() {
        json["suites"] = json!(suites);
    }
    if !crowds.is_empty() {
        json["crowds"] = json!(crowds);
    }
    let model = crowds.first().and_then(|report| report.errors.models.first());
    let mut families: Vec<CrowdFamily> = Vec::new();
    for report in crowds {
        if !families.contains(&report.family) {
            families.push(report.family);
        }
    }
    let chart = |family: CrowdFamily| {
        let sets = crowds.iter().filter(|report| report.family == family);
        let sets: Vec<&TrialErrors> = sets.map(|report| &report.errors).collect();
        let name = format!("error-by-horizon-{}", family.title());
        Some(Figure::chart(name, horizon_chart(family.title(), &sets)?))
    };
    let sections = (!crowds.is_empty()).then(|| Section {
        table: drawn_table(crowds),
        figures: families.into_iter().filter_map(chart).collect(),
        ..Section::default()
    });
    Document {
        title: model.map_or(String::new(), |first| {
            format!("{}, share of the mean true motion", first.model)
        }),
        sections: sections.into_iter().collect(),
        json,
        ..Document::default()
    }
}

/// Explanation of the columns of [`crowd_table`].
const LEGEND: &str = "\
error: mean final distance from the ground truth over all objects; of motion, median, p90: mean,
median and 90th percentile of this error, relative to the mean true motion; moved: objects that move
more than 1 cm; over frames: average over all frames; overlap: maximum penetration of two predicted
objects; fixed, revolute, prismatic: mean / maximum drift of predicted joints";

/// Returns the errors of all models on a set, one row each; percentages are of the mean true
/// motion.
fn crowd_table(report: &CrowdReport) -> Table {
    let all = |model: &ModelErrors, value: fn(&RelativeErrors) -> f64| {
        share(model.all.end.as_ref(), value)
    };
    let moved = |model: &ModelErrors, value: fn(&RelativeErrors) -> f64| {
        share(model.moved.end.as_ref(), value)
    };
    let error = |model: &ModelErrors| {
        let end = model.all.end.as_ref();
        end.map_or(NONE.to_owned(), |errors| fine_millimetres(errors.mean))
    };
    Table::of(
        &report.errors.models,
        &[
            ("model", Left, &|model| model_name(model, report.errors.trajectories)),
            ("error", Right, &|model| error(model)),
            ("of motion", Right, &|model| all(model, |errors| errors.mean)),
            ("median", Right, &|model| all(model, |errors| errors.median)),
            ("p90", Right, &|model| all(model, |errors| errors.p90)),
            ("moved", Right, &|model| moved(model, |errors| errors.mean)),
            ("median", Right, &|model| moved(model, |errors| errors.median)),
            ("p90", Right, &|model| moved(model, |errors| errors.p90)),
            ("over frames", Right, &|model| share(model.all.averaged.as_ref(), |e| e.mean)),
            ("moved", Right, &|model| share(model.moved.averaged.as_ref(), |e| e.mean)),
            ("overlap", Right, &|model| fine_millimetres(model.overlap)),
            ("fixed", Right, &|model| drift(&model.drift[0])),
            ("revolute", Right, &|model| drift(&model.drift[1])),
            ("prismatic", Right, &|model| drift(&model.drift[2])),
        ],
    )
}

/// Returns a row for each set of drawn scenes: the first model, and the mean errors of the others.
fn drawn_table(reports: &[CrowdReport]) -> Table {
    let ends = |report: &CrowdReport, end: &str| beside(&report.errors, |name| name.ends_with(end));
    Table::of(
        reports.iter().filter_map(|report| Some((report, report.errors.models.first()?))),
        &[
            ("set", Left, &|(report, _)| report.errors.title.clone()),
            ("motion", Right, &|(_, model)| end(model, &|errors| millimetres(errors.motion))),
            ("error", Right, &|(_, model)| end(model, &|errors| fine_millimetres(errors.mean))),
            ("of motion", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.mean)),
            ("median", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.median)),
            ("p90", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.p90)),
            ("over frames", Right, &|(_, model)| share(model.all.averaged.as_ref(), |e| e.mean)),
            ("moved", Right, &|(_, model)| share(model.moved.end.as_ref(), |e| e.mean)),
            ("joints guessed", Right, &|(report, _)| ends(report, ",joints=guessed")),
            ("joints none", Right, &|(report, _)| ends(report, ",joints=none")),
            ("joints fixed", Right, &|(report, _)| ends(report, ",joints=fixed")),
            ("prior", Right, &|(report, _)| beside(&report.errors, |name| name == "prior")),
            ("projection", Right, &|(report, _)| {
                beside(&report.errors, |name| name == "projection")
            }),
            ("friction 70 %", Right, &|(report, _)| ends(report, ",friction=70%")),
            ("friction 130 %", Right, &|(report, _)| ends(report, ",friction=130%")),
            // Drawn sets are simulated with the 2-D engine.
            ("own spread", Right, &|(report, _)| {
                beside(&report.errors, |name| name.starts_with("planar,start="))
            }),
        ],
    )
}

fn drift(drift: &Drift) -> String {
    match drift.joints {
        0 => NONE.to_owned(),
        _ => format!("{} / {}", fine_millimetres(drift.mean), fine_millimetres(drift.max)),
    }
}
