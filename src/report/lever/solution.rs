//! The result of solving a task of levering.

use serde_json::{Value as Json, json};

use crate::report::document::{Document, Figure, Section};
use crate::report::number::seconds;
use crate::report::table::{Align, Table};
use crate::scene::Task;
use crate::solve::PlanStatus;
use crate::solve::lever::LeverSolution;

use super::verdict::lever_verdict_line;
use super::words::{goal_line, outcome_table, plan_line, plan_sections};

/// A solved task, or the nearest that there is, with its picture.
pub fn lever_solution_document(
    task: &Task,
    solution: &LeverSolution,
    figures: Vec<Figure>,
) -> Document {
    let mut sections = Vec::new();
    if let Some(best) = solution.best() {
        sections.extend(plan_sections(&best.plan));
        let predicted = (format!("predicted ({})", best.by), &best.predicted);
        let nominal = best.verdict.as_ref().and_then(|verdict| verdict.nominal());
        let replayed = nominal.map(|nominal| ("3-D".to_owned(), &nominal.outcome));
        let line = lever_verdict_line(best.verdict.as_ref());
        sections.push(Section {
            table: outcome_table([predicted].into_iter().chain(replayed)),
            lines: vec![format!("verdict: {line}")],
            figures,
            ..Section::default()
        });
        sections.extend(alternatives(task, solution));
    }
    if solution.status == PlanStatus::NoPlan {
        sections.extend(refusals(solution));
    }
    sections.push(Section { lines: vec![cost(solution)], ..Section::default() });
    Document {
        title: format!("{}: {}", task.name, headline(task, solution)),
        notes: vec![format!("goal: {}", goal_line(task))],
        sections,
        json: json(task, solution),
        ..Document::default()
    }
}

fn headline(task: &Task, solution: &LeverSolution) -> String {
    let Some(best) = solution.best() else {
        return "no plan; no lever-up can be made at all".to_owned();
    };
    let plan = plan_line(task, &best.plan);
    let stopped = if solution.stopped { " (stopped early)" } else { "" };
    let headline = match solution.status {
        PlanStatus::Solved => format!("solved with {plan}"),
        PlanStatus::Fragile => format!("fragile; the most robust is {plan}"),
        PlanStatus::NoPlan => format!("no plan; the nearest is {plan}"),
        PlanStatus::FailedVerification => {
            format!("failed verification; the best by prediction is {plan}")
        }
    };
    format!("{headline}{stopped}")
}

/// The other plans that were verified.
fn alternatives(task: &Task, solution: &LeverSolution) -> Option<Section> {
    let others: Vec<_> =
        solution.plans.iter().skip(1).filter(|plan| plan.verdict.is_some()).take(7).collect();
    (!others.is_empty()).then(|| Section {
        title: "Other plans".to_owned(),
        table: Table::of(
            others,
            &[
                ("plan", Align::Left, &|ranked| plan_line(task, &ranked.plan)),
                ("edge", Align::Right, &|ranked| ranked.plan.lever.place.edge.to_string()),
                ("along it", Align::Right, &|ranked| {
                    format!("{:.0} %", 100.0 * ranked.plan.lever.place.fraction)
                }),
                ("verdict", Align::Left, &|ranked| lever_verdict_line(ranked.verdict.as_ref())),
            ],
        ),
        ..Section::default()
    })
}

/// Why lever-ups could not be made, the most frequent first.
fn refusals(solution: &LeverSolution) -> Option<Section> {
    let search = &solution.statistics.search;
    let mut reasons: Vec<_> = search.refused.iter().collect();
    reasons.sort_by(|a, b| b.1.cmp(a.1).then(a.0.cmp(b.0)));
    let considered = search.considered;
    (!reasons.is_empty()).then(|| Section {
        lines: vec![format!("{considered} lever-ups were considered; of these could not be made:")],
        table: Table::of(
            reasons,
            &[
                ("lever-ups", Align::Right, &|(_, count)| count.to_string()),
                ("why", Align::Left, &|(why, _)| (*why).clone()),
            ],
        ),
        ..Section::default()
    })
}

fn cost(solution: &LeverSolution) -> String {
    let statistics = &solution.statistics;
    let timing = &statistics.timing;
    let mut cost = format!(
        "predicted: {}; simulated: {}; verified: {}; time: {}, of which search {}, simulation {}, \
         verification {}",
        statistics.search.rollouts,
        statistics.simulated,
        statistics.verified,
        seconds(timing.total),
        seconds(timing.search),
        seconds(timing.simulation),
        seconds(timing.verification)
    );
    if statistics.followed > 0 {
        let (followed, pushes) = (statistics.followed, seconds(timing.pushes));
        cost.push_str(&format!(", pushes after {followed} of them {pushes}"));
    }
    cost
}

fn json(task: &Task, solution: &LeverSolution) -> Json {
    let plans: Vec<Json> = solution
        .plans
        .iter()
        .map(|ranked| {
            json!({
                "plan": ranked.plan, "predicted": ranked.predicted, "by": ranked.by,
                "verdict": ranked.verdict,
                "follow_up": ranked.plan.follow_up.as_ref().map(|follow_up| &follow_up.plan),
            })
        })
        .collect();
    json!({
        "task": task.name,
        "status": solution.status,
        "stopped": solution.stopped,
        "reason": solution.best().map(|best| lever_verdict_line(best.verdict.as_ref())),
        "plans": plans,
        "statistics": solution.statistics,
    })
}
