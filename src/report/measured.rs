//! Measured numbers as tables: errors on held-out pushes, refinement, costs.

use crate::bench::SearchCost;
use crate::bench::{
    ErrorRow, HeldOutErrors, HeldOutReport, InferenceCost, PushCost, RefinementReport,
};
use crate::judge::Summary;

use super::number::{fine_millimetres, millimetres, seconds};
use super::table::{Align, NONE, Table};

/// What was measured: pushes, seed, how far the objects really moved.
pub fn heldout_line(report: &HeldOutReport) -> String {
    let motion = report.motion.as_ref();
    format!(
        "{}: {} pushes of seed {}; {} objects moved more than 1 cm, {} on average",
        report.suite.title(),
        report.pushes,
        report.seed,
        motion.map_or(0, |motion| motion.count),
        motion.map_or(NONE.to_owned(), |motion| millimetres(motion.mean))
    )
}

/// Final errors of all models over all objects, one row each.
pub fn heldout_table(report: &HeldOutReport) -> Table {
    let mut table = error_table("model");
    for model in &report.models {
        if let Some(row) = model.rows.iter().find(|row| row.group == "all") {
            table.row(error_cells(&model.model, row));
        }
    }
    table
}

/// Final errors of one model by shape and by number of objects.
pub fn group_table(errors: &HeldOutErrors) -> Table {
    let mut table = error_table("objects");
    for row in &errors.rows {
        table.row(error_cells(&row.group, row));
    }
    table
}

/// Final errors of plans without and with refinement.
pub fn refinement_table(report: &RefinementReport) -> Table {
    let mut table = Table::new([
        ("plans", Align::Left),
        ("solved", Align::Right),
        ("predicted", Align::Right),
        ("planar", Align::Right),
        ("3-D", Align::Right),
        ("median", Align::Right),
        ("p95", Align::Right),
        ("replays a task", Align::Right),
        ("rollouts", Align::Right),
    ]);
    for (name, errors) in [("as searched", &report.before), ("refined", &report.after)] {
        table.row([
            name.to_owned(),
            format!("{} of {}", errors.solved, report.tasks),
            pick(&errors.predicted, |summary| summary.mean),
            pick(&errors.planar, |summary| summary.mean),
            pick(&errors.spatial, |summary| summary.mean),
            pick(&errors.spatial, |summary| summary.median),
            pick(&errors.spatial, |summary| summary.p95),
            format!("{:.2}", errors.attempts),
            format!("{:.0}", errors.rollouts),
        ]);
    }
    table
}

/// Processor time of one push by every model.
pub fn push_cost_table(costs: &[PushCost]) -> Table {
    let mut table = Table::new([
        ("model", Align::Left),
        ("batch", Align::Right),
        ("processor time a push", Align::Right),
        ("a frame", Align::Right),
    ]);
    for cost in costs {
        table.row([
            cost.model.clone(),
            cost.batch.to_string(),
            seconds(cost.seconds),
            seconds(cost.seconds_per_frame),
        ]);
    }
    table
}

/// Processor time of the network alone, fused and on candle, and of building its graphs.
pub fn inference_table(costs: &[InferenceCost]) -> Table {
    let mut table = Table::new([
        ("candidate-steps", Align::Right),
        ("relations", Align::Right),
        ("graph a step", Align::Right),
        ("fused network", Align::Right),
        ("candle network", Align::Right),
        ("fused of GEMM peak", Align::Right),
        ("with its graph", Align::Right),
        ("GEMM peak", Align::Right),
    ]);
    for cost in costs {
        let with_graph = cost.of_peak * cost.fused / (cost.fused + cost.graph);
        table.row([
            cost.graphs.to_string(),
            cost.relations.to_string(),
            seconds(cost.graph),
            seconds(cost.fused),
            cost.candle.map_or(NONE.to_owned(), seconds),
            format!("{:.0} %", 100.0 * cost.of_peak),
            format!("{:.0} %", 100.0 * with_graph),
            format!("{:.0} GFLOP/s", cost.peak / 1e9),
        ]);
    }
    table
}

/// Wall time of a search of one-push candidates by every model.
pub fn search_cost_table(costs: &[SearchCost]) -> Table {
    let mut table = Table::new([
        ("model", Align::Left),
        ("task", Align::Left),
        ("threads", Align::Right),
        ("rollouts", Align::Right),
        ("wall time", Align::Right),
    ]);
    for cost in costs {
        table.row([
            cost.model.clone(),
            cost.task.clone(),
            cost.threads.to_string(),
            cost.rollouts.to_string(),
            seconds(cost.seconds),
        ]);
    }
    table
}

fn error_table(first: &str) -> Table {
    Table::new([
        (first, Align::Left),
        ("moved", Align::Right),
        ("mean", Align::Right),
        ("median", Align::Right),
        ("p95", Align::Right),
        ("heading median", Align::Right),
        ("mean against 3-D", Align::Right),
        ("not moved", Align::Right),
        ("mean there", Align::Right),
    ])
}

fn error_cells(name: &str, row: &ErrorRow) -> [String; 9] {
    let heading = row.heading_deg.as_ref();
    let count =
        |summary: &Option<Summary>| summary.as_ref().map_or(0, |summary| summary.count).to_string();
    [
        name.to_owned(),
        count(&row.position),
        pick(&row.position, |summary| summary.mean),
        pick(&row.position, |summary| summary.median),
        pick(&row.position, |summary| summary.p95),
        heading.map_or(NONE.to_owned(), |heading| format!("{:.2}\u{00b0}", heading.median)),
        pick(&row.position_3d, |summary| summary.mean),
        count(&row.unmoved),
        pick(&row.unmoved, |summary| summary.mean),
    ]
}

fn pick(summary: &Option<Summary>, value: impl Fn(&Summary) -> f64) -> String {
    summary.as_ref().map_or(NONE.to_owned(), |summary| fine_millimetres(value(summary)))
}
