//! What objects cost that a push cannot touch.

use crate::bench::FarCost;

use super::{
    chart::{Axis, Chart, Mark, Series},
    number::seconds,
    table::{Align, Table},
};

/// Cost of a push by the number of far objects, one row a number, one column a model.
pub fn far_table(costs: &[FarCost]) -> Table {
    let models = models(costs);
    let mut head = vec![("objects out of reach".to_owned(), Align::Right)];
    for (model, batch) in &models {
        head.push((format!("{model}, {batch} at a time"), Align::Right));
        head.push(("ends differ by".to_owned(), Align::Right));
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

/// The same as curves.
pub fn far_chart(costs: &[FarCost]) -> Chart {
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
        title: "Objects that a push cannot touch cost nothing".to_owned(),
        x: Axis::linear("objects out of reach"),
        y: Axis::log("processor time of a push, \u{00b5}s"),
        series: series.collect(),
    }
}

/// The models and batches, in the order in which they come.
fn models(costs: &[FarCost]) -> Vec<(&String, usize)> {
    let mut models = Vec::new();
    for cost in costs {
        if !models.contains(&(&cost.model, cost.batch)) {
            models.push((&cost.model, cost.batch));
        }
    }
    models
}
