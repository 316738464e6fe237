//! Still and animated pictures of a plan.

use std::sync::Arc;

use pushplan::solve::RankedPlan;
use pushplan::{
    outcome::{Outcome, Trajectory, Verdict},
    scene::{Engine, Tool},
    task::{Plan, Task, ToolMotion},
};

use super::document::Figure;
use super::number::{degrees, millimetres};
use super::picture::{MovingPicture, ScenePicture, Source, SpacePicture, Track};
use super::plan_text::{engine_name, goal_line, plan_line};
use super::verdict::{nominal, verdict_line};

/// Returns pictures of a plan with the predicted and replayed paths of its objects. `animate` adds
/// an animation. Files are named `name`.
pub fn plan_figures(
    task: &Task,
    plan: &RankedPlan,
    replays: &Verdict,
    name: &str,
    animate: bool,
) -> Vec<Figure> {
    let replay = replays.nominal(Engine::Spatial).and_then(|found| found.trajectory.as_ref());
    let shown = replay.unwrap_or(&plan.predicted);
    if shown.outcome().space.is_some() {
        let line = format!("verdict: {}", verdict_line(task, plan.verdict.as_ref()));
        return space_figures(task, (&plan.plan, &plan.tools[..]), shown, &[line], (name, animate));
    }
    let motions = plan.plan.slides(&plan.tools).unwrap_or_default();
    let still = still(task, plan, &motions, replays).to_svg();
    let mut figures = vec![Figure::svg(name, still)];
    if let Some(replay) = replay.filter(|_| animate) {
        figures.push(moving_figure(
            task,
            &plan.plan,
            &motions,
            (Source::Simulated(Engine::Spatial), replay),
            name,
        ));
    }
    figures
}

/// Returns pictures of a 3-D motion, with lines below the title. `animate` adds an animation.
pub fn space_figures(
    task: &Task,
    (plan, tools): (&Plan, &[Arc<Tool>]),
    trajectory: &Trajectory,
    lines: &[String],
    (name, animate): (&str, bool),
) -> Vec<Figure> {
    let notes = [format!("goal: {}", goal_line(task))].into_iter().chain(lines.iter().cloned());
    let picture = SpacePicture {
        title: format!("{}: {}", task.name, plan_line(plan)),
        notes: notes.collect(),
        scene: &task.scene,
        plan,
        tools,
        goal: &task.goals[0],
        trajectory,
    };
    let mut figures = vec![Figure::svg(name, picture.to_svg())];
    if animate {
        figures.push(Figure::svg(format!("{name}.animated"), picture.to_moving_svg()));
    }
    figures
}

/// Returns an animation of a plan's simulation in one engine.
pub fn moving_figure(
    task: &Task,
    plan: &Plan,
    motions: &[ToolMotion],
    (source, trajectory): (Source, &Trajectory),
    name: &str,
) -> Figure {
    let title = match task.description.as_str() {
        "" => &task.name,
        description => description,
    };
    let picture = MovingPicture {
        title: title.to_owned(),
        plan: plan_line(plan),
        source,
        task,
        motions,
        trajectory,
    };
    Figure::svg(format!("{name}.animated"), picture.to_svg())
}

fn still<'a>(
    task: &'a Task,
    plan: &'a RankedPlan,
    motions: &'a [ToolMotion],
    replays: &'a Verdict,
) -> ScenePicture<'a> {
    let goal = &task.goals[0];
    // The error of a goal that is a heading alone is an angle.
    let angle = goal.heading().filter(|_| !goal.tolerance().is_finite());
    let words = |outcome: &Outcome| match (angle, outcome.heading_error()) {
        (Some(_), Some(turn)) => degrees(turn),
        _ => millimetres(outcome.error()),
    };
    let mut errors = vec![format!("predicted {}", words(&plan.outcome))];
    let mut tracks = Vec::new();
    // An object that does not move has no path to draw.
    for evidence in nominal(replays).filter(|_| !plan.plan.is_empty()) {
        let engine = engine_name(evidence.engine);
        errors.push(format!("{engine} {}", words(&evidence.outcome)));
        let source = Source::Simulated(evidence.engine);
        tracks.extend(evidence.trajectory.iter().map(|trajectory| Track { source, trajectory }));
    }
    let allowed = match angle {
        Some(facing) => degrees(facing.tolerance),
        None => millimetres(goal.tolerance()),
    };
    tracks.push(Track { source: Source::Predicted, trajectory: &plan.predicted });
    ScenePicture {
        title: format!("{}: {}", task.name, plan_line(&plan.plan)),
        notes: vec![
            format!("error: {}; allowed {allowed}", errors.join(", ")),
            format!("verdict: {}", verdict_line(task, plan.verdict.as_ref())),
        ],
        scene: &task.scene,
        goals: task.shown_goals(),
        reach: Some(task.annulus()),
        motions,
        tracks,
    }
}
