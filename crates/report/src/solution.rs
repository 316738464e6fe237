//! Report on the solution of a task.

use serde_json::{Value as Json, json};

use pushplan::outcome::StepMoves;
use pushplan::solve::{PlanStatus, RankedPlan, Solution};
use pushplan::{
    scene::{CORRECTED, ModelKind, ModelPart, ModelSpec},
    task::{Goal, Task},
};

use super::bystanders::{self, bystanders};
use super::detours::detours;
use super::document::{Document, Section};
use super::number::seconds;
use super::plan_text::{goal_line, moves, plan_line, plan_sections, point};
use super::table::{Align, Table};
use super::verdict::{outcome_section, verdict_line};

/// Returns a report on a solved task, or on the nearest plan.
pub fn solution_document(task: &Task, solution: &Solution) -> Document {
    let mut sections = Vec::new();
    if let Some(best) = solution.best() {
        sections.extend(plan_sections(&best.plan, &moved_by(task, best)));
        let fault = best.predicted.warnings.iter().find(|warning| warning.forbids_success());
        let predicted = Some((best.predicted.by.to_string(), &best.outcome, fault));
        let mut outcomes = outcome_section(task, predicted, best.verdict.as_ref());
        outcomes.lines.extend(best.refinement.aimed_at.map(|aim| {
            let aim = point(aim);
            format!("aimed at {aim}, because the plan aimed at the goal itself missed it in 3-D")
        }));
        let share = solution.partial.as_ref().and_then(|partial| partial.robustness);
        outcomes.lines.extend(share.map(|share| {
            format!("{:.0} % of the perturbed replays meet the same goals", 100.0 * share)
        }));
        outcomes.lines.extend(detours(task, best));
        sections.push(outcomes);
    }
    if solution.statistics.levers.is_some() {
        sections.extend(alternatives(task, solution));
    }
    if solution.status == PlanStatus::NoPlan {
        sections.extend(refusals(solution));
    }
    sections.push(Section {
        lines: vec![format!("model: {}", model_words(task, solution)), cost(solution)],
        ..Section::default()
    });
    Document {
        title: solution_title(task, solution),
        notes: vec![format!("goal: {}", goal_line(task))],
        sections,
        json: json(task, solution),
        ..Document::default()
    }
}

/// Returns the name of the task and the result in one line: the title of [`solution_document`].
pub fn solution_title(task: &Task, solution: &Solution) -> String {
    format!("{}: {}", task.name, headline(task, solution))
}

pub(super) fn headline(task: &Task, solution: &Solution) -> String {
    let Some(best) = solution.best() else {
        let step = if solution.statistics.levers.is_some() { "lever-up" } else { "push" };
        return format!("no plan{}; no {step} is feasible", cause(solution));
    };
    let plan = plan_line(&best.plan);
    let headline = match solution.status {
        PlanStatus::Solved if best.plan.is_empty() => {
            "solved; the object is already at the goal".to_owned()
        }
        PlanStatus::Solved => format!("solved with {plan}"),
        PlanStatus::Fragile => format!("fragile; the most robust is {plan}"),
        PlanStatus::Partial => {
            let (met, missed) = met(task, solution);
            format!("partial: {met} of {} goals with {plan}; not met: {missed}", task.goals.len())
        }
        PlanStatus::NoPlan if best.plan.is_empty() => {
            format!("no plan{}; no push reduces the error", cause(solution))
        }
        PlanStatus::NoPlan => format!("no plan{}; the closest is {plan}", cause(solution)),
        PlanStatus::FailedVerification => {
            format!("failed verification{}; the best predicted plan is {plan}", cause(solution))
        }
    };
    match solution.stopped {
        true => format!("{headline} (stopped before the search finished)"),
        false => headline,
    }
}

/// Returns the number of goals that a partial plan meets, and the objects of the other goals.
fn met(task: &Task, solution: &Solution) -> (usize, String) {
    let met = solution.partial.as_ref().map_or(&[][..], |partial| &partial.met);
    let missed = task.goals.iter().enumerate().filter(|(k, _)| !met.contains(k));
    let names: Vec<String> = missed.map(|(_, goal)| goal.names(&task.scene)).collect();
    (met.len(), names.join(", "))
}

/// Formats the cause of infeasibility, if it is known.
fn cause(solution: &Solution) -> String {
    solution.cause.as_ref().map_or(String::new(), |cause| format!(": {cause}"))
}

/// Returns a table of the reasons why pushes were not tried, most frequent first.
fn refusals(solution: &Solution) -> Option<Section> {
    let statistics = &solution.statistics;
    let (what, considered, mut reasons) = match &statistics.levers {
        Some(levers) => {
            let refused = levers.search.refused.iter();
            let reasons: Vec<_> = refused.map(|(why, count)| (why.clone(), *count)).collect();
            ("lever-ups", levers.search.considered, reasons)
        }
        None => {
            let refused = statistics.search.infeasible.iter();
            let reasons: Vec<_> = refused.map(|(why, count)| (why.to_string(), *count)).collect();
            ("pushes", statistics.search.considered, reasons)
        }
    };
    // The sort is stable: equal counts keep the order of their kinds.
    reasons.sort_by_key(|reason| std::cmp::Reverse(reason.1));
    (!reasons.is_empty()).then(|| Section {
        title: format!("Infeasible {what}, of {considered} considered"),
        table: Table::of(
            reasons,
            &[
                (what, Align::Right, &|(_, count)| count.to_string()),
                ("reason", Align::Left, &|(why, _)| why.clone()),
            ],
        ),
        ..Section::default()
    })
}

/// Largest number of rows on other plans.
const OTHERS: usize = 7;

/// Returns the distinct lines in the order of their first occurrence, with their numbers.
fn counted(lines: impl Iterator<Item = [String; 2]>) -> Vec<([String; 2], usize)> {
    let mut distinct: Vec<([String; 2], usize)> = Vec::new();
    for line in lines {
        match distinct.iter_mut().find(|(known, _)| *known == line) {
            Some((_, count)) => *count += 1,
            None => distinct.push((line, 1)),
        }
    }
    distinct
}

/// Returns a section on the other verified plans; plans with equal descriptions share a row.
fn alternatives(task: &Task, solution: &Solution) -> Option<Section> {
    let verified = solution.plans.iter().skip(1).filter(|plan| plan.verdict.is_some());
    let mut others = counted(
        verified
            .map(|ranked| [plan_line(&ranked.plan), verdict_line(task, ranked.verdict.as_ref())]),
    );
    others.truncate(OTHERS);
    let plan = |plan: &str, count: usize| match count {
        1 => plan.to_owned(),
        _ => format!("{plan} ({count} plans)"),
    };
    (!others.is_empty()).then(|| Section {
        title: "Other plans".to_owned(),
        table: Table::of(
            others,
            &[
                ("plan", Align::Left, &|([words, _], count)| plan(words, *count)),
                ("verdict", Align::Left, &|([_, verdict], _)| verdict.clone()),
            ],
        ),
        ..Section::default()
    })
}

/// Formats the model in words: the one of several that predicted the best plan.
pub(super) fn model_words(task: &Task, solution: &Solution) -> String {
    let by = solution.best().map(|best| &best.predicted.by.first().kind);
    let took = |part: &&ModelPart| Some(&part.kind) == by;
    let kind = &solution.model.parts().find(took).unwrap_or(solution.model.first()).kind;
    let crowd = matches!(kind, ModelKind::Network { .. }) && task.scene.objects.len() > CORRECTED;
    let line = ModelSpec::from(kind.clone()).to_string();
    match crowd {
        true => format!("{line}; only its analytic model while more than {CORRECTED} objects move"),
        false => line,
    }
}

fn cost(solution: &Solution) -> String {
    let statistics = &solution.statistics;
    let timing = &statistics.timing;
    let stages = [
        ("search", timing.search),
        ("refinement", timing.refinement),
        ("verification", timing.verification),
    ];
    // Levering tasks have no refinement.
    let stages = stages.into_iter().filter(|(_, taken)| *taken > 0.0);
    let stages: Vec<String> =
        stages.map(|(stage, taken)| format!("{stage} {}", seconds(taken))).collect();
    let stages =
        if stages.is_empty() { String::new() } else { format!(" ({})", stages.join(", ")) };
    format!(
        "rollouts: {}; plans verified: {}; time: {}{stages}",
        statistics.rollouts,
        statistics.verified,
        seconds(timing.total)
    )
}

/// Returns the objects that each step of a ranked plan moves.
pub(super) fn moved_by(task: &Task, ranked: &RankedPlan) -> Vec<StepMoves> {
    moves(task, &ranked.plan, Some(&ranked.predicted), ranked.verdict.as_ref())
}

fn json(task: &Task, solution: &Solution) -> Json {
    let plans: Vec<Json> = solution
        .plans
        .iter()
        .map(|ranked| {
            json!({
                "plan": ranked.plan,
                "moves": moved_by(task, ranked),
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
        "best": solution.best().map(|_| 0),
        "partial": solution.partial.as_ref().map(|partial| {
            let name = |goal: &Goal| goal.names(&task.scene);
            let met = task.goals.iter().enumerate().map(|(k, goal)| {
                json!({"object": name(goal), "met": partial.met.contains(&k)})
            });
            json!({"goals": met.collect::<Vec<Json>>(), "robustness": partial.robustness})
        }),
        "cause": solution.cause.as_ref().map(ToString::to_string),
        "reason": solution.best().map(|best| verdict_line(task, best.verdict.as_ref())),
        "moved": solution.best().map(|best| {
            bystanders::json(&bystanders(task, Some(&best.outcome), best.verdict.as_ref()))
        }),
        "plans": plans,
        "statistics": solution.statistics,
        "warnings": solution.warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_lines_are_counted_in_the_order_of_their_first_occurrence() {
        let line = |plan: &str| [plan.to_owned(), "works".to_owned()];
        let lines = ["a", "b", "a", "a"].map(line).into_iter();
        assert_eq!(counted(lines), [(line("a"), 3), (line("b"), 1)]);
    }
}
