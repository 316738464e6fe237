//! Errors of models on the user's recordings, as tables and curves.

use serde_json::json;

use pushplan_act::judge::{ModelErrors, OneError, RecordedErrors, RelativeErrors, TrialErrors};

use super::chart::{Axis, Chart, Mark, Series};
use super::document::{Document, Figure, Section};
use super::number::{fine_millimetres, millimetres};
use super::table::{
    Align::{Left, Right},
    NONE, Table,
};

/// Returns the newest of the reports on recordings; the first report also explains its columns.
pub fn recorded_document(reports: &[RecordedErrors]) -> Document {
    let Some((newest, before)) = reports.split_last() else { return Document::default() };
    let notes = if before.is_empty() { vec![LEGEND.to_owned()] } else { Vec::new() };
    let mut sections = vec![Section { table: recorded_table(newest), ..Section::default() }];
    // A combined report has no table by recording, because earlier reports contain the recordings.
    let reported = |name| before.iter().any(|report| report.names.contains(name));
    if newest.names.len() > 1 && !newest.names.iter().any(reported) {
        sections.extend(newest.errors.models.first().map(|model| Section {
            title: format!("{} by recording, with the error that the model expects", model.model),
            table: each_table(&newest.names, &model.each),
            ..Section::default()
        }));
    }
    let spread = newest
        .own_spread
        .map_or(String::new(), |metres| format!("; own spread {}", fine_millimetres(metres)));
    let title = format!("{}{spread}", trials_line(&newest.errors, ""));
    Document { title, notes, sections, ..Document::default() }
}

/// Returns all reports on recordings: side by side, errors by horizon, and in full for programs.
pub fn recordings_document(reports: &[RecordedErrors]) -> Document {
    let errors: Vec<&TrialErrors> = reports.iter().map(|report| &report.errors).collect();
    let model = errors.first().and_then(|errors| errors.models.first());
    let figures = horizon_chart("recordings", &errors)
        .map(|chart| Figure::chart("error-by-horizon-recordings".to_owned(), chart));
    let section = Section {
        table: recordings_table(reports),
        figures: figures.into_iter().collect(),
        ..Section::default()
    };
    Document {
        title: model.map_or(String::new(), |first| {
            format!("{}, share of the mean true motion", first.model)
        }),
        sections: vec![section],
        json: json!({ "recordings": reports }),
        ..Document::default()
    }
}

/// Explanation of the columns of [`recorded_table`].
const LEGEND: &str = "\
mean, median, p95: final position error over all objects. heading: mean final heading error of
objects with a known heading. of motion: the mean error as a share of the mean recorded motion.
over frames: this share, averaged over all recorded frames instead of the last one. overlap: the
deepest overlap of two predicted objects. own spread: the final distance between two replays of
the 2-D engine whose starts differ by 0.1 mm.";

/// Formats the number of trajectories, described by `of`, and the true displacement of objects.
pub fn trials_line(errors: &TrialErrors, of: &str) -> String {
    let first = errors.models.first();
    let motion = |errors: Option<&RelativeErrors>| match errors {
        Some(errors) => format!("{} by {}", errors.objects, millimetres(errors.motion)),
        None => "none".to_owned(),
    };
    format!(
        "{}: {} trajectories{of}, {:.0} frames each; objects move: {} on average, \
         more than 1 cm: {}",
        errors.title,
        errors.trajectories,
        errors.frames,
        motion(first.and_then(|model| model.all.end.as_ref())),
        motion(first.and_then(|model| model.moved.end.as_ref())),
    )
}

/// Returns a table of the errors of all models on recordings, one row each.
fn recorded_table(report: &RecordedErrors) -> Table {
    let end = |model: &ModelErrors, value: fn(&RelativeErrors) -> f64| {
        model.all.end.as_ref().map_or(NONE.to_owned(), |e| fine_millimetres(value(e)))
    };
    Table::of(
        &report.errors.models,
        &[
            ("model", Left, &|model| model_name(model, report.errors.trajectories)),
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

/// Returns a table of the errors of one model, recording by recording.
fn each_table(names: &[String], each: &[OneError]) -> Table {
    Table::of(
        names.iter().zip(each),
        &[
            ("recording", Left, &|(name, _)| (*name).clone()),
            ("motion", Right, &|(_, one)| millimetres(one.motion)),
            ("error", Right, &|(_, one)| fine_millimetres(one.error)),
            ("expected", Right, &|(_, one)| one.expected.map_or(NONE.to_owned(), fine_millimetres)),
            ("heading", Right, &|(_, one)| angle(one.heading_deg)),
            ("of motion", Right, &|(_, one)| match one.motion > 0.0 {
                true => percent(one.error / one.motion),
                false => NONE.to_owned(),
            }),
        ],
    )
}

/// Returns a table with one row per set of recordings: errors of the first model and of the
/// analytic model, and the spread of the 2-D engine.
fn recordings_table(reports: &[RecordedErrors]) -> Table {
    Table::of(
        reports.iter().filter_map(|report| Some((report, report.errors.models.first()?))),
        &[
            ("set", Left, &|(report, _)| report.errors.title.clone()),
            ("motion", Right, &|(_, model)| end(model, &|errors| millimetres(errors.motion))),
            ("mean", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.mean)),
            ("95 % interval", Right, &|(_, model)| end(model, &interval)),
            ("median", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.median)),
            ("p95", Right, &|(_, model)| share(model.all.end.as_ref(), |e| e.p95)),
            ("heading", Right, &|(_, model)| angle(model.any_heading_deg)),
            ("moved", Right, &|(_, model)| share(model.moved.end.as_ref(), |e| e.mean)),
            ("over frames", Right, &|(_, model)| share(model.all.averaged.as_ref(), |e| e.mean)),
            ("prior", Right, &|(report, _)| beside(&report.errors, |name| name == "prior")),
            ("own spread", Right, &|(report, model)| {
                let apart = report.own_spread.zip(model.all.end.as_ref());
                apart.map_or(NONE.to_owned(), |(apart, end)| percent(end.share(apart)))
            }),
        ],
    )
}

/// Formats the mean error of the first model whose name satisfies `wanted`.
pub fn beside(errors: &TrialErrors, wanted: impl Fn(&str) -> bool) -> String {
    let found = errors.models.iter().find(|model| wanted(&model.model));
    share(found.and_then(|model| model.all.end.as_ref()), |errors| errors.mean)
}

/// Formats a model's errors at the end, if any object moves.
pub fn end(model: &ModelErrors, text: &dyn Fn(&RelativeErrors) -> String) -> String {
    model.all.end.as_ref().map_or(NONE.to_owned(), text)
}

/// Plots the error by horizon of all models, averaged over sets of one `family`; `None` if there
/// are none.
pub fn horizon_chart(family: &str, sets: &[&TrialErrors]) -> Option<Chart> {
    let first = sets.first()?;
    let series = |name: &str| {
        let curves: Vec<Vec<[f64; 2]>> = sets
            .iter()
            .filter_map(|errors| errors.models.iter().find(|model| model.model == name))
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
        title: format!("Error by horizon, {family}, {} sets", sets.len()),
        x: Axis::linear("share of the frames, %"),
        y: Axis::log("mean error, % of the mean final motion"),
        series: first.models.iter().map(|model| series(&model.model)).collect(),
    })
}

/// Returns the error curve in percent: horizon as a share of frames, error as a share of the mean
/// final motion.
fn relative_curve(model: &ModelErrors) -> Option<Vec<[f64; 2]>> {
    let motion = model.curve.last().map(|point| point.motion).filter(|motion| *motion > 0.0)?;
    let points = model.curve.iter();
    Some(points.map(|point| [1e2 * point.horizon, 1e2 * point.error / motion]).collect())
}

/// Formats the model's name and the number of trajectories in which it failed.
pub fn model_name(model: &ModelErrors, trajectories: usize) -> String {
    match model.failed {
        0 => model.model.clone(),
        failed => format!("{} (failed in {failed} of {trajectories})", model.model),
    }
}

/// Formats a value of errors as a share of the mean true motion.
pub fn share(errors: Option<&RelativeErrors>, value: impl Fn(&RelativeErrors) -> f64) -> String {
    errors.map_or(NONE.to_owned(), |errors| percent(errors.share(value(errors))))
}

fn interval(errors: &RelativeErrors) -> String {
    let span = errors.relative_interval;
    format!("{} to {}", percent(span.low), percent(span.high))
}

fn angle(degrees: Option<f64>) -> String {
    degrees.map_or(NONE.to_owned(), |degrees| format!("{degrees:.2}\u{00b0}"))
}

/// Formats a share in percent, with two decimals below one.
pub fn percent(share: f64) -> String {
    let value = 1e2 * share;
    match value.abs() {
        v if v < 0.995 => format!("{value:.2} %"),
        v if v < 99.5 => format!("{value:.1} %"),
        _ => format!("{value:.0} %"),
    }
}
