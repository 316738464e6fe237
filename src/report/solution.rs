//! The result of solving a task, in words, as JSON and as a picture.

use serde_json::{Value as Json, json};

use crate::asset::SCHEMA_VERSION;
use crate::scene::{
    Engine, Evidence, ModelSpec, Outcome, Plan, Task, ToolMotion, Trajectory, Verdict, Warning,
};
use crate::solve::{PlanStatus, RankedPlan, Solution};

use super::{
    number::{millimetres, seconds},
    picture::{MovingPicture, ScenePicture, Source, Track},
    plan_text::{goal_line, outcome_table, plan_line, point, push_table},
};

/// The result for people.
pub fn solution_text(task: &Task, solution: &Solution) -> String {
    let mut text = format!("{}: {}\n", task.name, headline(solution));
    text += &format!("goal: {}\n", goal_line(task));
    if let Some(best) = solution.best() {
        if !best.plan.pushes.is_empty() {
            text += &format!("\n{}", push_table(&best.plan).to_text());
        }
        text += "\n";
        text +=
            &outcomes_text(task, Some((&best.predicted.by, &best.outcome)), best.verdict.as_ref());
        if let Some(aim) = best.refinement.aimed_at {
            text += &format!(
                "aimed at {}, as the same plan aimed at the goal ended beside it in 3-D\n",
                point(aim)
            );
        }
    }
    let statistics = &solution.statistics;
    let timing = &statistics.timing;
    text += &format!(
        "\nrollouts: {}; verified: {}; time: {}, of which search {}, refinement {}, verification {}\n",
        statistics.rollouts,
        statistics.verified,
        seconds(timing.total),
        seconds(timing.search),
        seconds(timing.refinement),
        seconds(timing.verification)
    );
    text
}

/// The result for programs.
pub fn solution_json(task: &Task, solution: &Solution) -> Json {
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
        "schema_version": SCHEMA_VERSION,
        "task": task.name,
        "model": solution.best().map(|best| &best.predicted.by),
        "status": solution.status,
        "plans": plans,
        "statistics": solution.statistics,
        "warnings": solution.warnings,
    })
}

/// Where a plan ends by prediction and in both engines, and what the verdict is.
pub fn outcomes_text(
    task: &Task,
    predicted: Option<(&ModelSpec, &Outcome)>,
    verdict: Option<&Verdict>,
) -> String {
    let source = predicted.map(|(model, _)| format!("predicted ({model})")).unwrap_or_default();
    let mut outcomes: Vec<(&str, &Outcome)> = Vec::new();
    outcomes.extend(predicted.map(|(_, outcome)| (source.as_str(), outcome)));
    for evidence in verdict.iter().flat_map(|verdict| nominal(verdict)) {
        outcomes.push((engine_name(evidence.engine), &evidence.outcome));
    }
    let mut text = outcome_table(task, &outcomes).to_text();
    text += &format!("\nverdict: {}\n", verdict_line(verdict));
    text
}

/// A picture of a plan, with the ways by prediction and in its replays.
pub fn plan_picture<'a>(
    task: &'a Task,
    plan: &'a RankedPlan,
    motion: &'a ToolMotion,
    replays: &'a Verdict,
) -> ScenePicture<'a> {
    let mut errors = vec![format!("predicted {}", millimetres(plan.outcome.error))];
    let mut tracks = Vec::new();
    // What does not move has no way to be drawn.
    for evidence in nominal(replays).filter(|_| !motion.strokes.is_empty()) {
        let (engine, error) = (engine_name(evidence.engine), evidence.outcome.error);
        errors.push(format!("{engine} {}", millimetres(error)));
        let source = Source::Simulated(evidence.engine);
        tracks.extend(evidence.trajectory.iter().map(|trajectory| Track { source, trajectory }));
    }
    let allowed = millimetres(task.goal.tolerance);
    tracks.push(Track { source: Source::Predicted, trajectory: &plan.predicted });
    ScenePicture {
        title: format!("{}: {}", task.name, plan_line(&plan.plan)),
        notes: vec![
            format!("error: {}; allowed {allowed}", errors.join(", ")),
            format!("verdict: {}", verdict_line(plan.verdict.as_ref())),
        ],
        scene: &task.scene,
        goal: Some(&task.goal),
        robot: Some(&task.robot),
        motion: Some(motion),
        tracks,
    }
}

/// A plan's replay in an engine as a picture that moves.
pub fn moving_picture<'a>(
    task: &'a Task,
    plan: &Plan,
    motion: &'a ToolMotion,
    (engine, replay): (Engine, &'a Trajectory),
) -> MovingPicture<'a> {
    let title = match task.description.as_str() {
        "" => task.name.clone(),
        description => description.to_owned(),
    };
    MovingPicture {
        title,
        plan: plan_line(plan),
        source: Source::Simulated(engine),
        scene: &task.scene,
        goal: &task.goal,
        robot: &task.robot,
        motion,
        trajectory: replay,
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

fn verdict_line(verdict: Option<&Verdict>) -> String {
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

fn nominal(verdict: &Verdict) -> impl Iterator<Item = &Evidence> {
    Engine::ALL.into_iter().filter_map(|engine| verdict.nominal(engine))
}

fn engine_name(engine: Engine) -> &'static str {
    match engine {
        Engine::Planar => "planar",
        Engine::Spatial => "3-D",
    }
}
