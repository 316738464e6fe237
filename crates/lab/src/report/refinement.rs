//! Benefit of refinement.

use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, Section, Table};
use serde_json::json;

use crate::bench::RefinementReport;
use crate::report::length;

/// Returns the final errors of plans without and with refinement, by planners of the named effort.
pub fn refinement_document(report: &RefinementReport, effort: &str) -> Document {
    let table = Table::of(
        [("not refined", &report.before), ("refined", &report.after)],
        &[
            ("plans", Left, &|(name, _)| (*name).to_owned()),
            ("solved", Right, &|(_, plans)| format!("{} of {}", plans.solved, report.tasks)),
            ("on all supports", Right, &|(_, plans)| {
                format!("{} of {}", plans.on_all_supports, report.tasks)
            }),
            ("predicted", Right, &|(_, plans)| length(&plans.predicted, |errors| errors.mean)),
            ("2-D", Right, &|(_, plans)| length(&plans.planar, |errors| errors.mean)),
            ("3-D", Right, &|(_, plans)| length(&plans.spatial, |errors| errors.mean)),
            ("median", Right, &|(_, plans)| length(&plans.spatial, |errors| errors.median)),
            ("p95", Right, &|(_, plans)| length(&plans.spatial, |errors| errors.p95)),
            ("replays per task", Right, &|(_, plans)| format!("{:.2}", plans.attempts)),
            ("rollouts", Right, &|(_, plans)| format!("{:.0}", plans.rollouts)),
        ],
    );
    let (tasks, seed, model) = (report.tasks, report.seed, &report.model);
    Document {
        title: format!("{tasks} random tasks of seed {seed}, effort {effort} with {model}"),
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"refinement": report}),
        ..Document::default()
    }
}
