//! Costs of pushes, networks and searches.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Axis, Chart, Document, Figure, Mark, NONE, Section, Series, Table, seconds};
use serde_json::json;

use crate::bench::{EquationCost, FarCost, InferenceCost, PushCost, SearchCost};

/// Returns the costs of a network, if any, of a push by every model, and of a search.
pub fn cost_document(
    networks: &[InferenceCost],
    pushes: &[PushCost],
    searches: &[SearchCost],
) -> Document {
    let mut sections = Vec::new();
    if !networks.is_empty() {
        sections.push(section("The network alone", inference_table(networks)));
    }
    sections.push(section("One push", push_table(pushes)));
    sections.push(section("A search of one-push candidates", search_table(searches)));
    Document {
        title: "Cost of predictions".to_owned(),
        sections,
        json: json!({"cost": {"networks": networks, "pushes": pushes, "searches": searches}}),
        ..Document::default()
    }
}

/// Returns the costs of a network on scenes of many objects.
pub fn crowd_cost_document(objects: usize, networks: &[InferenceCost]) -> Document {
    Document {
        title: format!("{objects} objects, sparse and dense, mixed joints; time per graph-step"),
        sections: vec![section("", inference_table(networks))],
        json: json!({"cost": {"objects": objects, "networks": networks}}),
        ..Document::default()
    }
}

/// Returns the cost of the analytic model's equations by number of objects.
pub fn equation_document(costs: &[EquationCost]) -> Document {
    Document {
        title: "Cost of the equations of the analytic model, per push".to_owned(),
        notes: vec![EQUATIONS.to_owned()],
        sections: vec![section("", equation_table(costs))],
        json: json!({"equations": costs}),
        ..Document::default()
    }
}

/// Explanation of the columns of the equations.
const EQUATIONS: &str = "Two *systems* are solved in each piece of a frame, for displacements and \
    for velocities. An *update* recomputes the resistance of moved objects and tries active *sets* \
    of contacts (sticking, sliding or open); if none is consistent, it *iterates*. *Operations* \
    count only support points and linear equations, and are compared with matrix products.";

/// Returns the costs of a push by the number of objects that it cannot touch.
pub fn far_document(costs: &[FarCost]) -> Document {
    let figures = vec![Figure::chart("far", far_chart(costs))];
    Document {
        title: FAR.to_owned(),
        sections: vec![Section { figures, ..section("", far_table(costs)) }],
        json: json!({"far": costs}),
        ..Document::default()
    }
}

/// Title of the costs of far objects.
const FAR: &str = "Cost of objects out of reach of a push";

fn section(title: &str, table: Table) -> Section {
    Section { title: title.to_owned(), table, ..Section::default() }
}

/// Returns the processor time of a push by every model.
fn push_table(costs: &[PushCost]) -> Table {
    Table::of(
        costs,
        &[
            ("model", Left, &|cost| cost.model.to_string()),
            ("batch", Right, &|cost| cost.batch.to_string()),
            ("processor time per push", Right, &|cost| seconds(cost.seconds)),
            ("per frame", Right, &|cost| seconds(cost.seconds_per_frame)),
        ],
    )
}

/// Returns the processor time of the network alone, fused and on candle, and of building its
/// graphs.
fn inference_table(costs: &[InferenceCost]) -> Table {
    let with_graph = |cost: &InferenceCost| cost.of_peak * cost.fused / (cost.fused + cost.graph);
    Table::of(
        costs,
        &[
            ("candidate-steps", Right, &|cost| cost.graphs.to_string()),
            ("relations", Right, &|cost| cost.relations.to_string()),
            ("graph a step", Right, &|cost| seconds(cost.graph)),
            ("fused network", Right, &|cost| seconds(cost.fused)),
            ("candle network", Right, &|cost| cost.candle.map_or(NONE.to_owned(), seconds)),
            ("fused of GEMM peak", Right, &|cost| format!("{:.0} %", 100.0 * cost.of_peak)),
            ("with its graph", Right, &|cost| format!("{:.0} %", 100.0 * with_graph(cost))),
            ("GEMM peak", Right, &|cost| format!("{:.0} GFLOP/s", cost.peak / 1e9)),
        ],
    )
}

/// Returns counts and times of the analytic model's equations.
fn equation_table(costs: &[EquationCost]) -> Table {
    let ratio = |of: u64, by: u64| format!("{:.1}", of as f64 / by.max(1) as f64);
    let operations = |cost: &EquationCost| cost.tally.operations as f64 / cost.pushes.max(1) as f64;
    Table::of(
        costs,
        &[
            ("objects", Right, &|cost| cost.objects.to_string()),
            ("joints", Left, &|cost| if cost.jointed { "some" } else { "none" }.to_owned()),
            ("prior", Right, &|cost| seconds(cost.seconds)),
            ("of planar at 1/120 s", Right, &|cost| format!("{:.2}", cost.seconds / cost.rival)),
            ("systems", Right, &|cost| ratio(cost.tally.systems, cost.pushes as u64)),
            ("constraints each", Right, &|cost| ratio(cost.tally.constraints, cost.tally.systems)),
            ("updates each", Right, &|cost| ratio(cost.tally.updates, cost.tally.systems)),
            ("objects per update", Right, &|cost| ratio(cost.tally.weighed, cost.tally.updates)),
            ("sets per update", Right, &|cost| ratio(cost.tally.rounds, cost.tally.updates)),
            ("equations per set", Right, &|cost| ratio(cost.tally.rows, cost.tally.rounds)),
            ("iterated", Right, &|cost| {
                let share = cost.tally.approached as f64 / cost.tally.updates.max(1) as f64;
                format!("{:.1} %", 100.0 * share)
            }),
            ("operations", Right, &|cost| format!("{:.0}k", 1e-3 * operations(cost))),
            ("of peak", Right, &|cost| {
                format!("{:.1} %", 100.0 * operations(cost) / (cost.seconds * cost.peak))
            }),
        ],
    )
}

/// Returns the wall time of a search of one-push candidates by every model.
fn search_table(costs: &[SearchCost]) -> Table {
    Table::of(
        costs,
        &[
            ("model", Left, &|cost| cost.model.to_string()),
            ("task", Left, &|cost| cost.task.clone()),
            ("threads", Right, &|cost| cost.threads.to_string()),
            ("rollouts", Right, &|cost| cost.rollouts.to_string()),
            ("wall time", Right, &|cost| seconds(cost.seconds)),
        ],
    )
}

/// Returns the cost of a push by the number of far objects, a row per number, a column per model.
fn far_table(costs: &[FarCost]) -> Table {
    let models = models(costs);
    let mut head = vec![("objects out of reach".to_owned(), Right)];
    for (model, batch) in &models {
        head.push((format!("{model}, {batch} at a time"), Right));
        head.push(("difference of final poses".to_owned(), Right));
    }
    let mut table = Table::new(head.iter().map(|(name, align)| (name.as_str(), *align)));
    let mut counts: Vec<usize> = costs.iter().map(|cost| cost.far).collect();
    counts.sort_unstable();
    counts.dedup();
    for far in counts {
        let mut row = vec![far.to_string()];
        for model in &models {
            let of = |cost: &&FarCost| cost.far == far && (&cost.model, cost.batch) == *model;
            match costs.iter().find(of) {
                Some(cost) => {
                    row.push(seconds(cost.seconds));
                    row.push(match cost.difference {
                        0.0 => "0".to_owned(),
                        apart => format!("{:.1e} m", apart),
                    });
                }
                None => row.extend([String::new(), String::new()]),
            }
        }
        table.row(row);
    }
    table
}

/// Returns the table as curves.
fn far_chart(costs: &[FarCost]) -> Chart {
    let series = models(costs).into_iter().map(|model| Series {
        name: format!("{}, {} at a time", model.0, model.1),
        points: costs
            .iter()
            .filter(|cost| (&cost.model, cost.batch) == model)
            .map(|cost| [cost.far as f64, cost.seconds * 1e6])
            .collect(),
        mark: Mark::DottedLine,
        labels: Vec::new(),
    });
    Chart {
        title: FAR.to_owned(),
        x: Axis::linear("objects out of reach"),
        y: Axis::log("processor time of a push, \u{00b5}s"),
        series: series.collect(),
    }
}

/// Returns the models and batches, in order of first occurrence.
fn models(costs: &[FarCost]) -> Vec<(&String, usize)> {
    let mut models = Vec::new();
    for cost in costs {
        if !models.contains(&(&cost.model, cost.batch)) {
            models.push((&cost.model, cost.batch));
        }
    }
    models
}
