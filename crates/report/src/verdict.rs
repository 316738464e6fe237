//! Replay results of a plan, as sentences and tables.

use serde_json::json;

use pushplan::asset::PlanFile;
use pushplan::{
    outcome::{Evidence, Force, Outcome, Reason, Verdict, Warning},
    scene::{Engine, Support},
    task::Task,
};

use super::bystanders::{self, bystanders};
use super::document::{Document, Section};
use super::number::{degrees, millimetres};
use super::plan_text::{engine_name, goal_line, moves, outcome_table, plan_line, plan_sections};
use super::recorded::percent;
use super::second_opinion::Judged;

/// Returns a report on a replayed plan.
pub fn verdict_document<'a>(file: &PlanFile, judged: impl Into<Judged<'a>>) -> Document {
    let Judged { verdict, second } = judged.into();
    let predicted = file.model.as_ref().zip(file.predicted.as_ref());
    let predicted = predicted.map(|(model, outcome)| (model.to_string(), outcome, None));
    let mut outcomes = outcome_section(&file.task, predicted, Some(verdict));
    outcomes.lines.extend(second.map(|second| format!("second opinion: {}", second.line())));
    let moves = moves(&file.task, &file.plan, None, Some(verdict));
    let mut document = Document {
        title: format!("{}: {}", file.task.name, plan_line(&file.plan)),
        notes: vec![format!("goal: {}", goal_line(&file.task))],
        sections: plan_sections(&file.plan, &moves).into_iter().chain([outcomes]).collect(),
        json: json!({
            "task": file.task.name, "plan": file.plan, "moves": moves, "verdict": verdict,
            "reason": verdict_line(&file.task, Some(verdict)),
            "moved": bystanders::json(&bystanders(&file.task, None, Some(verdict))),
        }),
        ..Document::default()
    };
    if let Some(second) = second {
        document.json["second_opinion"] = json!(second);
    }
    document
}

/// Returns the warnings of the nominal replays, each once with the engines that report it.
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

/// Returns the predicted and the simulated outcomes of a plan, and the verdict. `predicted` is the
/// model's name, its outcome, and its fault, if any.
pub(super) fn outcome_section(
    task: &Task,
    predicted: Option<(String, &Outcome, Option<&Warning>)>,
    verdict: Option<&Verdict>,
) -> Section {
    let predicted =
        predicted.map(|(model, outcome, fault)| (format!("predicted ({model})"), outcome, fault));
    let replayed = verdict.into_iter().flat_map(nominal);
    let replayed = replayed.map(|e| (engine_name(e.engine).to_owned(), &e.outcome, e.fault()));
    let reached = predicted.as_ref().is_some_and(|(_, outcome, _)| outcome.reached);
    let mut lines = vec![match verdict {
        None if reached => "verdict: not verified, because the search was stopped".to_owned(),
        _ => format!("verdict: {}", verdict_line(task, verdict)),
    }];
    lines.extend(verdict.and_then(force_line).map(|force| format!("force: {force}")));
    let moved = bystanders(task, predicted.as_ref().map(|(_, outcome, _)| *outcome), verdict);
    lines.extend(bystanders::line(&moved));
    Section {
        table: outcome_table(task, predicted.into_iter().chain(replayed)),
        lines,
        ..Section::default()
    }
}

/// Formats the verdict and its reason in a sentence.
pub(super) fn verdict_line(task: &Task, verdict: Option<&Verdict>) -> String {
    let Some(verdict) = verdict else {
        return "not verified, because the prediction misses the goal".to_owned();
    };
    let engines: Vec<&str> = nominal(verdict).map(|e| engine_name(e.engine)).collect();
    match &verdict.reason {
        None => {
            let simulations = match engines[..] {
                [one] => format!("the {one} simulation"),
                _ => "both simulations".to_owned(),
            };
            format!("passed: reaches the goal in {simulations}{}", perturbed(verdict))
        }
        Some(Reason::Forbidden(what)) => format!("failed: {what}"),
        Some(Reason::GoesWrong { engine, fault }) => {
            format!("failed: in the {} simulation {fault}", engine_name(*engine))
        }
        Some(Reason::Misses { engine, .. }) => {
            let end = verdict.nominal(*engine).map(|evidence| &evidence.outcome);
            format!(
                "failed: {} in the {} simulation",
                end.map_or("misses the goal".to_owned(), |end| misses(task, end)),
                engine_name(*engine)
            )
        }
        Some(Reason::Fragile { .. } | Reason::NeverOn { .. }) if verdict.was_stopped() => {
            "fragile: works as written, but the perturbed replays were stopped before the verdict \
             was clear"
                .to_owned()
        }
        Some(Reason::NeverOn { engine, support, replays }) => format!(
            "fragile: works as written, but fails in all {replays} perturbed {} replays in which \
             objects rest on {}",
            engine_name(*engine),
            resting(support)
        ),
        Some(Reason::Fragile { engine, reached, replays, wanted }) => format!(
            "fragile: works as written, but with small errors of starts and frictions only \
             {reached} of {replays} {} replays reach the goal ({:.0} % required)",
            engine_name(*engine),
            100.0 * wanted
        ),
    }
}

/// Formats the errors of the missed goals.
fn misses(task: &Task, end: &Outcome) -> String {
    let first = task.goals.first();
    let share = first.and_then(|goal| goal.covered(&end.state).zip(goal.wanted_share()));
    if let (Some((covered, asked)), [_]) = (share, &task.goals[..]) {
        let [covered, asked] = [covered, asked].map(percent);
        return format!("covers {covered} of the goal outline ({asked} required)");
    }
    let mut by = Vec::new();
    for (k, (goal, miss)) in task.goals.iter().zip(&end.goals).enumerate() {
        let of = task.scene.objects.get(miss.object).filter(|_| k > 0);
        let of = of.map_or(String::new(), |object| format!(" of {}", object.name));
        if miss.error > goal.tolerance() {
            let [off, allowed] = [miss.error, goal.tolerance()].map(millimetres);
            by.push(format!("{off}{of} ({allowed} allowed)"));
        }
        if let (Some(turned), Some(facing)) = (miss.heading_error, goal.heading())
            && turned > facing.tolerance
        {
            let [turned, allowed] = [turned, facing.tolerance].map(degrees);
            by.push(format!("{turned}{of} ({allowed} allowed)"));
        }
    }
    match by.is_empty() {
        true => "misses the goal".to_owned(),
        false => format!("misses the goal by {}", by.join(" and ")),
    }
}

/// Describes the support of objects.
fn resting(support: &Support) -> String {
    match support {
        Support::Even => "their whole underside".to_owned(),
        Support::Corners => "their corners or rims".to_owned(),
        Support::Spread(share) => format!("points at {:.0} % of their corners", 100.0 * share),
        Support::Points(_) => "points".to_owned(),
    }
}

/// Formats the share of perturbed replays that reach the goal.
fn perturbed(verdict: &Verdict) -> String {
    let mut found = Vec::new();
    for engine in Engine::ALL {
        let count = verdict.perturbed(engine).count();
        let reached = verdict.perturbed(engine).filter(|e| e.outcome.reached).count();
        if count > 0 {
            found.push(format!("{reached}/{count} ({})", engine_name(engine)));
        }
    }
    match found.is_empty() {
        true => String::new(),
        false => format!("; perturbed replays: {}", found.join(", ")),
    }
}

/// Formats the force of the tool when the plan is executed as written.
fn force_line(verdict: &Verdict) -> Option<String> {
    let forces: Vec<Force> = nominal(verdict).filter_map(|evidence| evidence.force).collect();
    let most = |of: fn(&Force) -> f64| forces.iter().map(of).reduce(f64::max);
    let (lasting, peak) = (most(|force| force.lasting)?, most(|force| force.peak)?);
    Some(format!("about {lasting:.0} N sustained, {peak:.0} N at impact"))
}

/// Returns the nominal replays, 2-D first.
pub(super) fn nominal(verdict: &Verdict) -> impl Iterator<Item = &Evidence> {
    Engine::ALL.into_iter().filter_map(|engine| verdict.nominal(engine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::{outcome::Perturbation, scene::State};

    #[test]
    fn a_warning_of_both_engines_is_reported_once() {
        let landed = || Warning::SetDownOn { object: "can".to_owned(), stroke: 1 };
        let toppled = Warning::Toppled { object: "can".to_owned() };
        let outcome = Outcome { state: State::default(), goals: Vec::new(), reached: false };
        let evidence = |engine, warnings| Evidence {
            engine,
            perturbation: Perturbation::Nominal,
            outcome: outcome.clone(),
            warnings,
            force: None,
            trajectory: None,
        };
        let evidence = vec![
            evidence(Engine::Planar, vec![landed()]),
            evidence(Engine::Spatial, vec![landed(), toppled]),
        ];
        let verdict = Verdict::judge(Vec::new(), evidence, 0.75);
        insta::assert_snapshot!(replay_warnings(&verdict).join("\n"), @r"
    2-D and 3-D: can is below the tool when it is set down for push 2, so the nominal replay fails
    3-D: can toppled, so its pose on the table is unreliable; push lower or slower
    ");
    }
}
