//! Curves of a training run.

use pushplan_report::{Axis, Chart, Document, Figure, Mark, Section, Series};
use serde_json::json;

use crate::train::{HeldOutError, Line};

/// Returns the curves of a training run so far.
pub fn training_document(lines: &[Line<HeldOutError>]) -> Document {
    let section =
        Section { figures: vec![Figure::chart("curves", chart(lines))], ..Section::default() };
    Document {
        title: TITLE.to_owned(),
        sections: vec![section],
        json: json!({"metrics": lines}),
        ..Document::default()
    }
}

/// Title of the curves.
const TITLE: &str = "Held-out final position error during training";

/// Returns the chart of held-out errors over the steps.
fn chart(lines: &[Line<HeldOutError>]) -> Chart {
    let series = |name: &str, value: &dyn Fn(&Line<HeldOutError>) -> f64| Series {
        name: name.to_owned(),
        points: lines.iter().map(|line| [line.step as f64, 1e3 * value(line)]).collect(),
        mark: Mark::Line,
        labels: Vec::new(),
    };
    Chart {
        title: TITLE.to_owned(),
        x: Axis::linear("steps"),
        y: Axis::log("error, mm"),
        series: vec![
            series("95th percentile", &|line| line.held_out.p95),
            series("mean", &|line| line.held_out.mean),
            series("median", &|line| line.held_out.median),
            series("mean, one object", &|line| {
                line.held_out.single.as_ref().map_or(f64::NAN, |single| single.mean)
            }),
        ],
    }
}
