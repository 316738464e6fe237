//! The result of solving a task.

use serde_json::{Value as Json, json};

use crate::scene::Task;
use crate::solve::{PlanStatus, Solution};

use super::document::{Document, Section};
use super::number::seconds;
use super::plan_text::{goal_line, plan_line, point, push_section};
use super::verdict::outcome_section;

/// A solved task, or the nearest that there is.
pub fn solution_document(task: &Task, solution: &Solution) -> Document {
    let mut sections = Vec::new();
    if let Some(best) = solution.best() {
        sections.extend(push_section(&best.plan));
        let predicted = Some((best.predicted.by.to_string(), &best.outcome));
        let mut outcomes = outcome_section(task, predicted, best.verdict.as_ref());
        outcomes.lines.extend(best.refinement.aimed_at.map(|aim| {
            let aim = point(aim);
            format!("aimed at {aim}, as the same plan aimed at the goal ended beside it in 3-D")
        }));
        sections.push(outcomes);
    }
    sections.push(Section { lines: vec![cost(solution)], ..Section::default() });
    Document {
        title: format!("{}: {}", task.name, headline(solution)),
        notes: vec![format!("goal: {}", goal_line(task))],
        sections,
        json: json(task, solution),
        ..Document::default()
    }
}

fn headline(solution: &Solution) -> String {
    let Some(best) = solution.best() else {
        return "no plan; no push can be made at all".to_owned();
    };
    let plan = plan_line(&best.plan);
    match solution.status {
        PlanStatus::Solved if best.plan.pushes.is_empty() => {
            "solved; the object is at the goal already".to_owned()
        }
        PlanStatus::Solved => format!("solved with {plan}"),
        PlanStatus::NoPlan if best.plan.pushes.is_empty() => {
            "no plan; no push brings the object nearer".to_owned()
        }
        PlanStatus::NoPlan => format!("no plan; the nearest is {plan}"),
        PlanStatus::FailedVerification => {
            format!("failed verification; the best by prediction is {plan}")
        }
    }
}

fn cost(solution: &Solution) -> String {
    let statistics = &solution.statistics;
    let timing = &statistics.timing;
    format!(
        "rollouts: {}; verified: {}; time: {}, of which search {}, refinement {}, verification {}",
        statistics.rollouts,
        statistics.verified,
        seconds(timing.total),
        seconds(timing.search),
        seconds(timing.refinement),
        seconds(timing.verification)
    )
}

fn json(task: &Task, solution: &Solution) -> Json {
    let plans: Vec<Json> = solution
        .plans
        .iter()
        .map(|ranked| {
            json!({
                "plan": ranked.plan,
                "predicted": ranked.outcome,
                "verdict": ranked.verdict,
                "refinement": ranked.refinement,
            })
        })
        .collect();
    json!({
        "task": task.name,
        "model": solution.best().map(|best| &best.predicted.by),
        "status": solution.status,
        "plans": plans,
        "statistics": solution.statistics,
        "warnings": solution.warnings,
    })
}
