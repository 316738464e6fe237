//! What replays of a lever-up show.

use serde_json::json;

use crate::asset::LeverPlanFile;
use crate::report::document::{Document, Section};
use crate::scene::{LeverReason, LeverVerdict};

use super::words::{goal_line, outcome_table, plan_line, plan_sections};

/// A lever-up that was replayed.
pub fn lever_verdict_document(file: &LeverPlanFile, verdict: &LeverVerdict) -> Document {
    let predicted = file.predicted.as_ref().map(|outcome| {
        let model = file.model.as_deref().unwrap_or("unknown model");
        (format!("predicted ({model})"), outcome)
    });
    let replayed = verdict.nominal().map(|nominal| ("3-D".to_owned(), &nominal.outcome));
    let outcomes = Section {
        table: outcome_table(predicted.into_iter().chain(replayed)),
        lines: vec![format!("verdict: {}", lever_verdict_line(Some(verdict)))],
        ..Section::default()
    };
    Document {
        title: format!("{}: {}", file.task.name, plan_line(&file.task, &file.plan)),
        notes: vec![format!("goal: {}", goal_line(&file.task))],
        sections: plan_sections(&file.plan).into_iter().chain([outcomes]).collect(),
        json: json!({
            "task": file.task.name, "plan": file.plan, "verdict": verdict,
            "reason": lever_verdict_line(Some(verdict)),
            "follow_up": file.plan.follow_up.as_ref().map(|follow_up| &follow_up.plan),
        }),
        ..Document::default()
    }
}

/// What the verdict is, and why, in a sentence.
pub fn lever_verdict_line(verdict: Option<&LeverVerdict>) -> String {
    let Some(verdict) = verdict else {
        return "not verified, as the prediction misses the goal".to_owned();
    };
    let count = verdict.disturbed().count();
    let reached = verdict.disturbed().filter(|evidence| evidence.outcome.reached).count();
    match &verdict.reason {
        None if count == 0 => "passed: reaches the goal".to_owned(),
        None => format!("passed: reaches the goal, as do {reached} of {count} disturbed replays"),
        Some(LeverReason::Forbidden(fault)) => format!("failed: {fault}"),
        Some(LeverReason::GoesWrong(warning)) => format!("failed: {warning}"),
        Some(LeverReason::Stopped) => format!("stopped after {count} disturbed replays"),
        Some(LeverReason::Misses) => "failed: misses the goal".to_owned(),
        Some(LeverReason::Fragile { reached, replays, wanted }) => format!(
            "fragile: works as written, but with small errors of place and friction {reached} of \
             {replays} replays reach the goal ({:.0} % asked for)",
            100.0 * wanted
        ),
    }
}
