//! Table of the information gained by probes.

use pushplan_act::act::ProbeRule;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, Section, Table};
use serde_json::json;

use crate::bench::ProbeSummary;

/// Explanation of the columns.
const LEGEND: &str = "Each exploratory push is the best of sixteen random pushes of 10 cm by the \
    rule: most information (*information*), the first (*random*), the first at an object of the \
    least certain pair (*uncertain*), or largest motion (*motion*). *Correct* is the share of \
    near pairs with the true type of joint, *nll* the mean negative log probability of this type. \
    *Test push* is the mean error over the objects for a later push of 20 cm, which is not \
    observed, predicted under the belief; *all known* is predicted with the true joints.";

/// Returns the results of probes.
pub fn probes_document(summaries: &[ProbeSummary]) -> Document {
    let mut table = Table::new([
        ("rule", Left),
        ("probes", Right),
        ("pairs", Right),
        ("correct, %", Right),
        ("nll", Right),
        ("test push, median", Right),
        ("mean", Right),
        ("all known, median", Right),
    ]);
    let length = |metres: f64| format!("{:.1} mm", 1e3 * metres);
    for one in summaries {
        table.row([
            title(one.case.rule).to_owned(),
            one.probes.to_string(),
            one.pairs.to_string(),
            format!("{:.1}", 1e2 * one.right),
            format!("{:.3}", one.surprise),
            length(one.error_median),
            length(one.error_mean),
            length(one.known_median),
        ]);
    }
    let scenes = summaries.first().map_or(0, |one| one.scenes);
    let set = summaries.first().map_or_else(String::new, |one| one.case.set.title());
    Document {
        title: format!("Exploratory pushes in {scenes} scenes: {set}"),
        notes: vec![LEGEND.to_owned()],
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"probes": summaries}),
        ..Document::default()
    }
}

fn title(rule: ProbeRule) -> &'static str {
    match rule {
        ProbeRule::Task => "task",
        ProbeRule::Information => "information",
        ProbeRule::Random => "random",
        ProbeRule::Uncertain => "uncertain",
        ProbeRule::Motion => "motion",
    }
}
