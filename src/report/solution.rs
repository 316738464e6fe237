//! The result of solving a task.

use serde_json::{Value as Json, json};

use crate::scene::Task;
use crate::solve::{PlanStatus, Solution};

use super::document::{Document, Section};
use super::number::seconds;
use super::plan_text::{goal_line, plan_line, point, push_section};
use super::table::{Align, Table};
use super::verdict::{outcome_section, verdict_line};

/// A solved task, or the nearest plan.
pub fn solution_document(task: &Task, solution: &Solution) -> Document {
    let mut sections = Vec::new();
    if let Some(best) = solution.best() {
        sections.extend(push_section(&best.plan));
        let fault = best.predicted.warnings.iter().find(|warning| warning.forbids_success());
        let predicted = Some((best.predicted.by.to_string(), &best.outcome, fault));
        let mut outcomes = outcome_section(task, predicted, best.verdict.as_ref());
        outcomes.lines.extend(best.refinement.aimed_at.map(|aim| {
            let aim = point(aim);
            format!("aimed at {aim}, as the same plan aimed at the goal ended next to it in 3-D")
        }));
        sections.push(outcomes);
    }
    if solution.status == PlanStatus::NoPlan {
        sections.extend(refusals(solution));
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

pub(super) fn headline(solution: &Solution) -> String {
    let Some(best) = solution.best() else {
        return "no plan; no push can be made at all".to_owned();
    };
    let plan = plan_line(&best.plan);
    let headline = match solution.status {
        PlanStatus::Solved if best.plan.pushes.is_empty() => {
            "solved; the object is at the goal already".to_owned()
        }
        PlanStatus::Solved => format!("solved with {plan}"),
        PlanStatus::Fragile => format!("fragile; the most robust is {plan}"),
        PlanStatus::NoPlan if best.plan.pushes.is_empty() => {
            "no plan; no push brings the object nearer".to_owned()
        }
        PlanStatus::NoPlan => format!("no plan; the nearest is {plan}"),
        PlanStatus::FailedVerification => {
            format!("failed verification; the best by prediction is {plan}")
        }
    };
    match solution.stopped {
        true => format!("{headline} (stopped before the search was over)"),
        false => headline,
    }
}

/// Why pushes were not tried, most frequent first.
fn refusals(solution: &Solution) -> Option<Section> {
    let search = &solution.statistics.search;
    let mut reasons: Vec<_> = search.infeasible.iter().collect();
    reasons.sort_by(|a, b| b.1.cmp(a.1).then(a.0.cmp(b.0)));
    let considered = search.considered;
    (!reasons.is_empty()).then(|| Section {
        lines: vec![format!("{considered} pushes were considered; of these could not be made:")],
        table: Table::of(
            reasons,
            &[
                ("pushes", Align::Right, &|(_, count)| count.to_string()),
                ("why", Align::Left, &|(why, _)| why.to_string()),
            ],
        ),
        ..Section::default()
    })
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
        "stopped": solution.stopped,
        "reason": solution.best().map(|best| verdict_line(task, best.verdict.as_ref())),
        "plans": plans,
        "statistics": solution.statistics,
        "warnings": solution.warnings,
    })
}
