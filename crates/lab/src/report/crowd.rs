//! Errors on crowds and recordings as tables and curves.

use serde_json::json;

use crate::bench::{CrowdFamily, CrowdModel, CrowdReport, HeldOutReport, OneError};
use pushplan::internals::judge::{Drift, RelativeErrors};

use pushplan::internals::report::Align::{Left, Right};
use pushplan::internals::report::{Axis, Chart, Mark, Series};
use pushplan::internals::report::{Document, Figure, Section};
use pushplan::internals::report::{NONE, Table};
use pushplan::internals::report::{fine_millimetres, millimetres};

/// The newest of the reports on crowds and recordings, as soon as it is there; with the first one
/// comes what its columns mean.
pub fn crowd_document(reports: &[CrowdReport]) -> Document {
    let Some((newest, before)) = reports.split_last() else { return Document::default() };
    let recorded = |report: &CrowdReport| report.family == CrowdFamily::Recordings;
    let is_new =
        |kind: bool| recorded(newest) == kind && before.iter().all(|r| recorded(r) != kind);
    let mut legend = Vec::new();
    if is_new(false) {
        legend.push(LEGEND.to_owned());
    }
    if is_new(true) {
        legend.push(RECORDED_LEGEND.to_owned());
    }
    let table = if recorded(newest) { recorded_table(newest) } else { crowd_table(newest) };
    let mut sections = vec![Section { table, ..Section::default() }];
    // Of all recordings together each was told before.
    let told = |name| before.iter().any(|report| report.names.contains(name));
    if newest.names.len() > 1 && !newest.names.iter().any(told) {
        sections.extend(newest.models.first().map(|model| Section {
            title: format!("{} by recording", model.model),
            table: each_table(&newest.names, &model.each),
            ..Section::default()
        }));
    }
    Document { title: headline(newest), notes: legend, sections, ..Document::default() }
}

/// Everything that was evaluated: the sets of crowds side by side, errors by horizon, and all
/// reports in full for programs.
pub fn evaluation_document(suites: &[HeldOutReport], crowds: &[CrowdReport]) -> Document {
    let mut json = json!({});
    if !suites.is_empty() {
        json["suites"] = json!(suites);
    }
    if !crowds.is_empty() {
        json["crowds"] = json!(crowds);
    }
    let model = crowds.first().and_then(|report| report.models.first());
    let mut families: Vec<CrowdFamily> = Vec::new();
    for report in crowds {
        if !families.contains(&report.family) {
            families.push(report.family);
        }
    }
    let figures = families.into_iter().filter_map(|family| {
        let name = format!("error-by-horizon-{}", family.title());
        Some(Figure::chart(name, crowd_chart(family, crowds)?))
    });
    let figures = figures.collect();
    let (recorded, drawn): (Vec<_>, Vec<_>) =
        crowds.iter().partition(|report| report.family == CrowdFamily::Recordings);
    let mut sections = Vec::new();
    for (sets, table) in [(&drawn, drawn_table as fn(&_) -> Table), (&recorded, recordings_table)] {
        if !sets.is_empty() {
            sections.push(Section { table: table(sets), ..Section::default() });
        }
    }
    if let Some(first) = sections.first_mut() {
        first.figures = figures;
    }
    Document {
        title: model.map_or(String::new(), |first| {
            format!("{}, share of the mean true motion", first.model)
        }),
        sections,
        json,
        ..Document::default()
    }
}

/// What the columns of [`crowd_table`] mean.
const LEGEND: &str = "\
error: mean final distance from the truth over all objects; of motion, median, p90: the same, its
median and 90th percentile, as shares of the mean true motion; moved: over objects that move more
than 1 cm; over frames: averaged over all frames instead of the last; overlap: deepest of any two
predicted objects; fixed, revolute, prismatic: mean / largest drift of predicted joints";

/// What the columns of [`recorded_table`] mean.
const RECORDED_LEGEND: &str = "\
mean, median, p95: final distance from the recorded position over all objects; heading: mean final
heading error of objects of known heading; of motion: the mean as a share of the mean recorded
motion; over frames: the same averaged over all recorded frames instead of the last; overlap:
deepest of any two predicted objects; own spread: how far the planar engine ends from itself when
everything starts 0.1 mm beside";

/// What was measured: trajectories, seed, how far the objects really moved.
fn headline(report: &CrowdReport) -> String {
    let seed = report.seed.map_or(String::new(), |seed| format!(" of seed {seed}"));
    let spread = report
        .own_spread
        .map_or(String::new(), |metres| format!("; own spread {}", fine_millimetres(metres)));
    let first = report.models.first();
    let motion = |errors: Option<&RelativeErrors>| match errors {
        Some(errors) => format!("{} by {}", errors.objects, millimetres(errors.motion)),
        None => "none".to_owned(),
    };
    format!(
        "{}: {} trajectories{seed}, {:.0} frames each; objects move: {} on average, more than 1 cm: \
         {}{spread}",
        report.title,
        report.trajectories,
        report.frames,
        motion(first.and_then(|model| model.all.end.as_ref())),
        motion(first.and_then(|model| model.moved.end.as_ref())),
    )
}

/// Errors of all models on one set, one row each; percentages are of the mean true motion.
fn crowd_table(report: &CrowdReport) -> Table {
    let all = |model: &CrowdModel, value: fn(&RelativeErrors) -> f64| {
        share(model.all.end.as_ref(), value)
    };
    let moved = |model: &CrowdModel, value: fn(&RelativeErrors) -> f64| {
        share(model.moved.end.as_ref(), value)
    };
    let error = |model: &CrowdModel| {
        let end = model.all.end.as_ref();
        end.map_or(NONE.to_owned(), |errors| fine_millimetres(errors.mean))
    };
    Table::of(
        &report.models,
        &[
            ("model", Left, &|model| name(model, report.trajectories)),
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

/// Errors of all models on recordings, one row each.
fn recorded_table(report: &CrowdReport) -> Table {
    let end = |model: &CrowdModel, value: fn(&RelativeErrors) -> f64| {
        model.all.end.as_ref().map_or(NONE.to_owned(), |e| fine_millimetres(value(e)))
    };
    Table::of(
        &report.models,
        &[
            ("model", Left, &|model| name(model, report.trajectories)),
            ("mean", Right, &|model| end(model, |errors| errors.mean)),
            ("median", Right, &|model| end(model, |errors| errors.median)),
            ("p95", Right, &|model| end(model, |errors| errors.p95)),
            ("heading", Right, &|model| angle(model.any_heading_deg)),
            ("of motion", Right, &|model| share(model.all.end.as_ref(), |errors| errors.mean)),
            ("95 % interval", Right, &|model| {
                model.all.end.as_ref().map_or(NONE.to_owned(), interval)
            }),
            ("over frames", Right, &|model| share(model.all.averaged.as_ref(), |e| e.mean)),
            ("overlap", Right, &|model| fine_millimetres(model.overlap)),
        ],
    )
}

/// Errors of one model recording by recording.
fn each_table(names: &[String], each: &[OneError]) -> Table {
    Table::of(
        names.iter().zip(each),
        &[
            ("recording", Left, &|(name, _)| (*name).clone()),
            ("motion", Right, &|(_, one)| millimetres(one.motion)),
            ("error", Right, &|(_, one)| fine_millimetres(one.error)),
            ("heading", Right, &|(_, one)| angle(one.heading_deg)),
            ("of motion", Right, &|(_, one)| match one.motion > 0.0 {
                true => percent(one.error / one.motion),
                false => NONE.to_owned(),
            }),
        ],
    )
}

/// One row a set of drawn scenes: the first model, and the mean error of those beside it.
fn drawn_table(reports: &[&CrowdReport]) -> Table {
    let ends = |report: &CrowdReport, end: &str| beside(report, |name| name.ends_with(end));
    Table::of(
        measured(reports),
        &[
            ("set", Left, &|(report, _)| report.title.clone()),
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
            ("prior", Right, &|(report, _)| beside(report, |name| name == "prior")),
            ("projection", Right, &|(report, _)| beside(report, |name| name == "projection")),
            ("friction 70 %", Right, &|(report, _)| ends(report, ",friction=70%")),
            ("friction 130 %", Right, &|(report, _)| ends(report, ",friction=130%")),
            // Drawn sets are the planar engine's own.
            ("own spread", Right, &|(report, _)| {
                beside(report, |name| name.starts_with("planar,start="))
            }),
        ],
    )
}

/// One row a set of recordings: the first model beside the projection and the planar engine's own
/// spread.
fn recordings_table(reports: &[&CrowdReport]) -> Table {
    Table::of(
        measured(reports),
        &[
            ("set", Left, &|(report, _)| report.title.clone()),
            ("motion", Right, &|(_, model)| end(model, &|errors| millimetres(errors.motion))),
            ("mean", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.mean)),
            ("95 % interval", Right, &|(_, model)| end(model, &interval)),
            ("median", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.median)),
            ("p95", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.p95)),
            ("heading", Right, &|(_, model)| angle(model.any_heading_deg)),
            ("moved", Right, &|(_, model)| share(model.moved.end.as_ref(), |e| e.mean)),
            ("over frames", Right, &|(_, model)| share(model.all.averaged.as_ref(), |e| e.mean)),
            ("projection", Right, &|(report, _)| beside(report, |name| name == "projection")),
            ("own spread", Right, &|(report, model)| {
                let apart = report.own_spread.zip(model.all.end.as_ref());
                apart.map_or(NONE.to_owned(), |(apart, end)| percent(end.share(apart)))
            }),
        ],
    )
}

/// The reports with their first models.
fn measured<'a>(reports: &[&'a CrowdReport]) -> Vec<(&'a CrowdReport, &'a CrowdModel)> {
    reports.iter().filter_map(|report| Some((*report, report.models.first()?))).collect()
}

/// The mean error of the first model with such a name.
fn beside(report: &CrowdReport, wanted: impl Fn(&str) -> bool) -> String {
    let found = report.models.iter().find(|model| wanted(&model.model));
    share(found.and_then(|model| model.all.end.as_ref()), |errors| errors.mean)
}

/// What is said of a model's errors at the end, if anything moves.
fn end(model: &CrowdModel, text: &dyn Fn(&RelativeErrors) -> String) -> String {
    model.all.end.as_ref().map_or(NONE.to_owned(), text)
}

/// Error by horizon of all models, averaged over the sets of one family; `None` if there are none.
fn crowd_chart(family: CrowdFamily, reports: &[CrowdReport]) -> Option<Chart> {
    let reports: Vec<&CrowdReport> =
        reports.iter().filter(|report| report.family == family).collect();
    let first = reports.first()?;
    let series = |name: &str| {
        let curves: Vec<Vec<[f64; 2]>> = reports
            .iter()
            .filter_map(|report| report.models.iter().find(|model| model.model == name))
            .filter_map(relative_curve)
            .collect();
        let steps = curves.iter().map(Vec::len).min().unwrap_or(0);
        let count = curves.len() as f64;
        let points = (0..steps).map(|k| {
            [curves[0][k][0], curves.iter().map(|curve| curve[k][1]).sum::<f64>() / count]
        });
        Series {
            name: name.to_owned(),
            points: points.collect(),
            mark: Mark::Line,
            labels: Vec::new(),
        }
    };
    Some(Chart {
        title: format!("Error by horizon, {}, {} sets", family.title(), reports.len()),
        x: Axis::linear("share of the frames, %"),
        y: Axis::log("mean error, % of the mean final motion"),
        series: first.models.iter().map(|model| series(&model.model)).collect(),
    })
}

/// Percent of frames and of the mean final motion.
fn relative_curve(model: &CrowdModel) -> Option<Vec<[f64; 2]>> {
    let motion = model.curve.last().map(|point| point.motion).filter(|motion| *motion > 0.0)?;
    let points = model.curve.iter();
    Some(points.map(|point| [1e2 * point.horizon, 1e2 * point.error / motion]).collect())
}

fn name(model: &CrowdModel, trajectories: usize) -> String {
    match model.failed {
        0 => model.model.clone(),
        failed => format!("{} (failed in {failed} of {trajectories})", model.model),
    }
}

fn share(errors: Option<&RelativeErrors>, value: impl Fn(&RelativeErrors) -> f64) -> String {
    errors.map_or(NONE.to_owned(), |errors| percent(errors.share(value(errors))))
}

fn interval(errors: &RelativeErrors) -> String {
    let span = errors.relative_interval;
    format!("{} to {}", percent(span.low), percent(span.high))
}

fn angle(degrees: Option<f64>) -> String {
    degrees.map_or(NONE.to_owned(), |degrees| format!("{degrees:.2}\u{00b0}"))
}

fn percent(share: f64) -> String {
    let value = 1e2 * share;
    match value.abs() {
        v if v < 0.995 => format!("{value:.2} %"),
        v if v < 99.5 => format!("{value:.1} %"),
        _ => format!("{value:.0} %"),
    }
}

fn drift(drift: &Drift) -> String {
    match drift.joints {
        0 => NONE.to_owned(),
        _ => format!("{} / {}", fine_millimetres(drift.mean), fine_millimetres(drift.max)),
    }
}
