//! What replays of a plan show, in words and tables.

use serde_json::json;

use crate::asset::PlanFile;
use crate::scene::{Engine, Evidence, Outcome, Task, Verdict, Warning};

use super::document::{Document, Section};
use super::plan_text::{engine_name, goal_line, outcome_table, plan_line, push_section};

/// A plan that was replayed.
pub fn verdict_document(file: &PlanFile, verdict: &Verdict) -> Document {
    let predicted = file.model.as_ref().zip(file.predicted.as_ref());
    let predicted = predicted.map(|(model, outcome)| (model.to_string(), outcome));
    let outcomes = outcome_section(&file.task, predicted, Some(verdict));
    Document {
        title: format!("{}: {}", file.task.name, plan_line(&file.plan)),
        notes: vec![format!("goal: {}", goal_line(&file.task))],
        sections: push_section(&file.plan).into_iter().chain([outcomes]).collect(),
        json: json!({"task": file.task.name, "plan": file.plan, "verdict": verdict}),
        ..Document::default()
    }
}

/// What a reader should know of the nominal replays, once each and with the engines that say so.
pub fn replay_warnings(verdict: &Verdict) -> Vec<String> {
    let mut found: Vec<(&Warning, Vec<&'static str>)> = Vec::new();
    for evidence in nominal(verdict) {
        for warning in &evidence.warnings {
            let name = engine_name(evidence.engine);
            match found.iter_mut().find(|(known, _)| *known == warning) {
                Some((_, engines)) if engines.contains(&name) => {}
                Some((_, engines)) => engines.push(name),
                None => found.push((warning, vec![name])),
            }
        }
    }
    let line =
        |(warning, engines): (&Warning, Vec<&str>)| format!("{}: {warning}", engines.join(" and "));
    found.into_iter().map(line).collect()
}

/// Where a plan ends by prediction (which model, where) and in both engines, and what the verdict
/// is.
pub(super) fn outcome_section(
    task: &Task,
    predicted: Option<(String, &Outcome)>,
    verdict: Option<&Verdict>,
) -> Section {
    let predicted = predicted.map(|(model, outcome)| (format!("predicted ({model})"), outcome));
    let replayed = verdict.into_iter().flat_map(nominal);
    let replayed = replayed.map(|e| (engine_name(e.engine).to_owned(), &e.outcome));
    Section {
        table: outcome_table(task, predicted.into_iter().chain(replayed)),
        lines: vec![format!("verdict: {}", verdict_line(verdict))],
        ..Section::default()
    }
}

/// Whether it passed and what that means.
pub(super) fn verdict_line(verdict: Option<&Verdict>) -> String {
    let Some(verdict) = verdict else {
        return "not verified, as the prediction misses the goal".to_owned();
    };
    let word = if verdict.passed { "passed" } else { "failed" };
    let does = if verdict.passed { "reaches" } else { "misses" };
    let draws: Vec<&Evidence> = verdict.disturbed(Engine::Spatial).collect();
    let reached = draws.iter().filter(|evidence| evidence.outcome.reached).count();
    let robust = match draws.len() {
        0 => String::new(),
        count => format!("; {reached} of {count} disturbed replays reach it"),
    };
    format!("{word}: {does} the goal in the 3-D simulation{robust}")
}

/// The nominal replays, planar first.
pub(super) fn nominal(verdict: &Verdict) -> impl Iterator<Item = &Evidence> {
    Engine::ALL.into_iter().filter_map(|engine| verdict.nominal(engine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Disturbance, State};

    #[test]
    fn a_warning_of_both_engines_is_said_once() {
        let landed = || Warning::SetDownOn { object: "can".to_owned(), stroke: 1 };
        let toppled = Warning::Toppled { object: "can".to_owned() };
        let outcome =
            Outcome { state: State::default(), error: 0.1, heading_error: None, reached: false };
        let evidence = |engine, warnings| Evidence {
            engine,
            disturbance: Disturbance::Nominal,
            outcome: outcome.clone(),
            warnings,
            trajectory: None,
        };
        let verdict = Verdict {
            passed: false,
            evidence: vec![
                evidence(Engine::Planar, vec![landed()]),
                evidence(Engine::Spatial, vec![landed(), toppled]),
            ],
            robustness: None,
        };
        insta::assert_snapshot!(replay_warnings(&verdict).join("\n"), @r"
        planar and 3-D: the tool came down on can for push 2 instead of beside it, so the plan does not work as written
        3-D: can toppled; its pose on the table means little, push lower or slower
        ");
    }
}
