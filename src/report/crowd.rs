//! Errors on crowds as tables and curves.

use crate::bench::{CrowdFamily, CrowdModel, CrowdReport};
use crate::judge::{Drift, RelativeErrors};

use super::{
    chart::{Axis, Chart, Mark, Series},
    number::{fine_millimetres, millimetres},
    table::{Align, NONE, Table},
};

/// What was measured: trajectories, seed, how far the objects really moved.
pub fn crowd_line(report: &CrowdReport) -> String {
    let seed = report.seed.map_or(String::new(), |seed| format!(" of seed {seed}"));
    let first = report.models.first();
    let motion = |errors: Option<&RelativeErrors>| match errors {
        Some(errors) => format!("{} by {}", errors.objects, millimetres(errors.motion)),
        None => "none".to_owned(),
    };
    format!(
        "{}: {} trajectories{seed}, {:.0} frames each; objects move: {} on average, more than 1 cm: {}",
        report.title,
        report.trajectories,
        report.frames,
        motion(first.and_then(|model| model.all.end.as_ref())),
        motion(first.and_then(|model| model.moved.end.as_ref())),
    )
}

/// Errors of all models on one set, one row each; percentages are of the mean true motion.
pub fn crowd_table(report: &CrowdReport) -> Table {
    let mut table = Table::new([
        ("model", Align::Left),
        ("error", Align::Right),
        ("of motion", Align::Right),
        ("median", Align::Right),
        ("p90", Align::Right),
        ("moved", Align::Right),
        ("median", Align::Right),
        ("p90", Align::Right),
        ("over frames", Align::Right),
        ("moved", Align::Right),
        ("overlap", Align::Right),
        ("fixed", Align::Right),
        ("revolute", Align::Right),
        ("prismatic", Align::Right),
    ]);
    for model in &report.models {
        let (all, moved) = (model.all.end.as_ref(), model.moved.end.as_ref());
        table.row([
            name(model, report.trajectories),
            all.map_or(NONE.to_owned(), |errors| fine_millimetres(errors.mean)),
            share(all, |errors| errors.mean),
            share(all, |errors| errors.median),
            share(all, |errors| errors.p90),
            share(moved, |errors| errors.mean),
            share(moved, |errors| errors.median),
            share(moved, |errors| errors.p90),
            share(model.all.averaged.as_ref(), |errors| errors.mean),
            share(model.moved.averaged.as_ref(), |errors| errors.mean),
            fine_millimetres(model.overlap),
            drift(&model.drift[0]),
            drift(&model.drift[1]),
            drift(&model.drift[2]),
        ]);
    }
    table
}

/// What the columns of [`crowd_table`] mean.
pub const CROWD_LEGEND: &str = "\
error: mean final distance from the truth over all objects; of motion, median, p90: the same, its
median and 90th percentile, as shares of the mean true motion; moved: over objects that move more
than 1 cm; over frames: averaged over all frames instead of the last; overlap: deepest of any two
predicted objects; fixed, revolute, prismatic: mean / largest drift of predicted joints";

/// One row a set: the first model beside the projection and the simulator's own spread.
pub fn crowd_summary(reports: &[CrowdReport]) -> Table {
    let mut table = Table::new([
        ("set", Align::Left),
        ("motion", Align::Right),
        ("mean", Align::Right),
        ("95 % interval", Align::Right),
        ("median", Align::Right),
        ("moved", Align::Right),
        ("over frames", Align::Right),
        ("projection", Align::Right),
        ("own spread", Align::Right),
    ]);
    for report in reports {
        let Some(model) = report.models.first() else { continue };
        let end = model.all.end.as_ref();
        let of = |wanted: &dyn Fn(&str) -> bool| {
            let found = report.models.iter().find(|model| wanted(&model.model));
            share(found.and_then(|model| model.all.end.as_ref()), |errors| errors.mean)
        };
        table.row([
            report.title.clone(),
            end.map_or(NONE.to_owned(), |errors| millimetres(errors.motion)),
            share(end, |errors| errors.mean),
            end.map_or(NONE.to_owned(), |errors| {
                let span = errors.relative_interval;
                format!("{} to {}", percent(span.low), percent(span.high))
            }),
            share(end, |errors| errors.median),
            share(model.moved.end.as_ref(), |errors| errors.mean),
            share(model.all.averaged.as_ref(), |errors| errors.mean),
            of(&|name| name == "projection"),
            of(&|name| name.starts_with("planar,start=")),
        ]);
    }
    table
}

/// Error by horizon of all models, averaged over the sets of one family; nothing if there are
/// none.
pub fn crowd_chart(family: CrowdFamily, reports: &[CrowdReport]) -> Option<Chart> {
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
