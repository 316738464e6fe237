//! Report on the solved tasks of a benchmark: tables, and rows for CSV.

use serde_json::json;

use pushplan::solve::PlanStatus;
use pushplan_bench::store::{Finished, RunManifest, Seconds};
use pushplan_bench::{End, SolvedTask};

use super::chart::{Axis, Chart, Mark, Series};
use super::document::{Document, Figure, Section};
use super::number::{millimetres, seconds};
use super::table::{Align, Table};

/// Column names of [`solved_cells`] in CSV; lengths in metres, angles in degrees, times in seconds.
pub const SOLVED_COLUMNS: [(&str, Align); 20] = [
    ("index", Align::Right),
    ("task", Align::Left),
    ("status", Align::Left),
    ("tool", Align::Left),
    ("pushes", Align::Right),
    ("tolerance_m", Align::Right),
    ("predicted_m", Align::Right),
    ("planar_m", Align::Right),
    ("spatial_m", Align::Right),
    ("predicted_deg", Align::Right),
    ("planar_deg", Align::Right),
    ("spatial_deg", Align::Right),
    ("planar_reached", Align::Left),
    ("spatial_reached", Align::Left),
    ("attempts", Align::Right),
    ("rollouts", Align::Right),
    ("search_s", Align::Right),
    ("refinement_s", Align::Right),
    ("verification_s", Align::Right),
    ("total_s", Align::Right),
];

/// Returns a report on a benchmark of task files.
pub fn solved_document(run: &RunManifest, tasks: &[Finished<SolvedTask>]) -> Document {
    let solved = tasks.iter().filter(|task| task.record.status == PlanStatus::Solved).count();
    let errors = |end: &dyn Fn(&SolvedTask) -> Option<End>| -> Vec<f64> {
        tasks.iter().filter_map(|task| Some(end(&task.record)?.error)).collect()
    };
    let chart = error_chart(
        "Final errors of the tasks",
        &[
            ("predicted".to_owned(), errors(&|task| task.predicted)),
            ("planar".to_owned(), errors(&|task| task.planar)),
            ("3-D".to_owned(), errors(&|task| task.spatial)),
        ],
    );
    let mut rows = Table::new(SOLVED_COLUMNS);
    for task in tasks {
        rows.row(solved_cells(task.index, &task.record, &task.seconds));
    }
    let section = Section { table: task_table(tasks), figures: vec![chart], ..Section::default() };
    Document {
        title: format!("{solved} of {} tasks solved with {}", tasks.len(), run.model),
        notes: vec![progress_note(run, tasks.len())].into_iter().flatten().collect(),
        sections: vec![section],
        rows,
        json: json!({"run": run, "tasks": tasks.iter().map(flat).collect::<Vec<_>>()}),
    }
}

/// Returns a table with one row per task: tool, final error, and duration.
fn task_table(tasks: &[Finished<SolvedTask>]) -> Table {
    let mut table = Table::new([
        ("task", Align::Left),
        ("status", Align::Left),
        ("tool", Align::Left),
        ("pushes", Align::Right),
        ("predicted", Align::Right),
        ("2-D", Align::Right),
        ("3-D", Align::Right),
        ("allowed", Align::Right),
        ("perturbed", Align::Right),
        ("time", Align::Right),
    ]);
    for Finished { record, seconds: times, .. } in tasks {
        let error = |end: Option<End>| end.map_or(String::new(), |end| millimetres(end.error));
        let plan = record.plan.as_ref();
        table.row([
            record.task.clone(),
            status(record.status).to_owned(),
            plan.map_or(String::new(), |plan| plan.tools().join(", ")),
            plan.map_or(String::new(), |plan| plan.pushes().len().to_string()),
            error(record.predicted),
            error(record.planar),
            error(record.spatial),
            record.tolerance.map_or(String::new(), millimetres),
            record.robustness.map_or(String::new(), |share| format!("{:.0} %", share * 100.0)),
            times.get("total").map_or(String::new(), |total| seconds(*total)),
        ]);
    }
    table
}

/// Returns all values of a task as cells, for CSV.
pub fn solved_cells(index: usize, record: &SolvedTask, times: &Seconds) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let error = |end: Option<End>| number(end.map(|end| end.error));
    let turned =
        |end: Option<End>| number(end.and_then(|end| end.heading_error).map(f64::to_degrees));
    let reached = |end: Option<End>| end.map_or(String::new(), |end| end.reached.to_string());
    let plan = record.plan.as_ref();
    let ends = [record.predicted, record.planar, record.spatial];
    let mut cells = vec![
        index.to_string(),
        record.task.clone(),
        status(record.status).to_owned(),
        plan.map_or(String::new(), |plan| plan.tools().join(", ")),
        plan.map_or(String::new(), |plan| plan.pushes().len().to_string()),
        number(record.tolerance),
    ];
    cells.extend(ends.map(error));
    cells.extend(ends.map(turned));
    cells.extend([record.planar, record.spatial].map(reached));
    cells.extend([record.attempts.to_string(), record.rollouts.to_string()]);
    let stages = ["search", "refinement", "verification", "total"];
    cells.extend(stages.map(|stage| number(times.get(stage).copied())));
    cells
}

/// Plots the share of tasks within an error, on a logarithmic axis.
pub fn error_chart(title: &str, errors: &[(String, Vec<f64>)]) -> Figure {
    /// Smallest error shown, metres. Smaller errors are irrelevant and would compress the rest of
    /// the axis.
    const SMALLEST: f64 = 1e-4;
    let series = errors.iter().map(|(name, errors)| {
        let mut sorted: Vec<f64> = errors.iter().map(|error| error.max(SMALLEST)).collect();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len().max(1) as f64;
        let points = sorted.iter().enumerate();
        let points = points.map(|(k, error)| [1e3 * error, 100.0 * (k + 1) as f64 / count]);
        Series {
            name: name.clone(),
            points: points.collect(),
            mark: Mark::Line,
            labels: Vec::new(),
        }
    });
    let chart = Chart {
        title: title.to_owned(),
        x: Axis::log("final error, mm"),
        y: Axis::linear("tasks within this error, %"),
        series: series.collect(),
    };
    Figure::chart("errors", chart)
}

/// Returns a finished task as one JSON object, with index and times next to the keys of the record.
pub fn flat<R: serde::Serialize>(task: &Finished<R>) -> serde_json::Value {
    let mut value = json!(task.record);
    value["index"] = json!(task.index);
    value["seconds"] = json!(task.seconds);
    value
}

/// Describes the part of the suite that the numbers cover; `None` if it is the whole suite.
pub fn progress_note(run: &RunManifest, done: usize) -> Option<String> {
    let wanted = run.indices().len();
    let shard = run.shard.map(|shard| format!("Shard {shard} of {} tasks. ", run.tasks));
    let left = (done < wanted).then(|| format!("Unfinished: {done} of {wanted} tasks."));
    let note = format!("{}{}", shard.unwrap_or_default(), left.unwrap_or_default());
    (!note.is_empty()).then(|| note.trim_end().to_owned())
}

pub(super) fn status(status: PlanStatus) -> &'static str {
    match status {
        PlanStatus::Solved => "solved",
        PlanStatus::Fragile => "fragile",
        PlanStatus::Partial => "partial",
        PlanStatus::NoPlan => "no plan",
        PlanStatus::FailedVerification => "failed verification",
    }
}
