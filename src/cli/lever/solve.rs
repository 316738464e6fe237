//! `pushplan solve` for a task of levering.

use std::path::PathBuf;
use std::sync::Arc;

use crate::asset::{LeverPlanFile, ToolLibrary};
use crate::cli::{
    error::CliError,
    exit_code,
    follow::Following,
    output,
    session::Session,
    solve::{self, SolveArgs, solve_error},
};
use crate::report::{
    Figure, PageView, Recipe, ReplayedLever, lever_figure, lever_page, lever_solution_document,
    lever_verdict_line,
};
use crate::scene::{LeverJob, LeverMotion, LeverScene, Task};
use crate::sim::LeverSimulator;
use crate::solve::PlanStatus;
use crate::solve::lever::{LeverPlanner, LeverSettings, LeverSolution, PushedAfter, RankedLever};

use super::model::lever_model;

/// Between two frames of what pictures show, seconds.
pub const FRAME: f64 = 0.02;

/// Chooses a tool and a lever-up, verifies it, writes plan, picture and page.
///
/// # Errors
/// What is wrong with the task, and results that cannot be written.
pub fn solve(
    args: &SolveArgs,
    mut task: Task,
    library: &ToolLibrary,
    session: &Session,
) -> Result<u8, CliError> {
    task.robustness = args.robustness.unwrap_or(task.robustness);
    let model = lever_model(args.model.as_ref())?;
    output::prepare(&args.out)?;
    let mut settings = LeverSettings::for_effort(args.effort);
    settings.disturbed = args.disturbed.map_or(settings.disturbed, usize::from);
    let planner = LeverPlanner::new(model, args.effort).with_settings(settings);
    let planner = planner.seeded(args.seed).within(args.time_limit);
    let following = Following::spinner(session, "solving");
    let solved = session.compute(|| planner.solve_with(&task, library, &following));
    following.finish()?;
    let solution = solved.map_err(solve_error)?;
    let (code, suffix) = match solution.status {
        PlanStatus::Solved => (exit_code::DONE, ""),
        PlanStatus::Fragile => (exit_code::FRAGILE, ".fragile"),
        PlanStatus::NoPlan => (exit_code::NO_PLAN, ".nearest"),
        PlanStatus::FailedVerification => (exit_code::FAILED_VERIFICATION, ".failed"),
    };
    if args.animate {
        session.warn("lever-ups have no picture that moves; the still one shows their frames");
    }
    let name = format!("{}{suffix}", task.name);
    let replayed = solution.best().map(|best| replay(session, &task, best, &name));
    let figures = replayed.iter().map(|(figure, _)| figure.clone()).collect();
    let mut document = lever_solution_document(&task, &solution, figures);
    let mut written = match solution.best().zip(replayed.as_ref()) {
        Some((best, replayed)) => write(args, &task, (best, replayed), &name, &document),
        None => Ok(Vec::new()),
    };
    if let (Ok(written), Some(pushed)) = (&mut written, pushed(&solution)) {
        written.extend(write_pushes(args, session, pushed, suffix)?);
    }
    // A plan that took minutes is shown also where the disk has no place for it.
    document.wrote(written.as_deref().unwrap_or_default());
    args.form.show(session, &document)?;
    written.map(|_| code)
}

/// What the best plan pushes after its lever-up.
fn pushed(solution: &LeverSolution) -> Option<&PushedAfter> {
    solution.best()?.pushed.as_deref()
}

/// The task of pushes that the lever-up leaves, as a file of its own, with its plan, picture and
/// page.
fn write_pushes(
    args: &SolveArgs,
    session: &Session,
    pushed: &PushedAfter,
    suffix: &str,
) -> Result<Vec<PathBuf>, CliError> {
    let PushedAfter { task, solution } = pushed;
    let name = format!("{}{suffix}.yaml", task.name);
    let text = task.to_yaml().map_err(CliError::Output)?;
    let origin = output::write(&args.out, &name, text.as_bytes())?;
    let mut written = match solution.best() {
        Some(best) => solve::write(args, session, (task, &origin), (solution, best), suffix)?,
        None => Vec::new(),
    };
    written.insert(0, origin);
    Ok(written)
}

/// The picture of a plan, and the motion that it shows.
fn replay(session: &Session, task: &Task, best: &RankedLever, name: &str) -> (Figure, LeverMotion) {
    let scene = Arc::new(LeverScene::with(&task.scene, &best.tool));
    let job = LeverJob { scene, lever: best.plan.lever };
    let (_, motion) = session.compute(|| LeverSimulator::FINE.record(&job, FRAME));
    let line = format!("verdict: {}", lever_verdict_line(best.verdict.as_ref()));
    (lever_figure(task, (&best.tool, &best.plan), &motion, &[line], name), motion)
}

/// The plan file, the picture and the page.
fn write(
    args: &SolveArgs,
    task: &Task,
    (best, (figure, motion)): (&RankedLever, &(Figure, LeverMotion)),
    name: &str,
    document: &crate::report::Document,
) -> Result<Vec<PathBuf>, CliError> {
    let path = args.out.join(format!("{name}.plan.json"));
    let file = LeverPlanFile {
        task: task.clone(),
        tool: Arc::clone(&best.tool),
        plan: best.plan.clone(),
        model: Some(best.by.clone()),
        predicted: Some(best.predicted.clone()),
        verdict: best.verdict.clone(),
    };
    file.write(&path).map_err(CliError::Output)?;
    let mut written = vec![path];
    written.extend(output::write_figures(&args.out, document.figures())?);
    let page = match args.page {
        PageView::Above => document.to_html(),
        PageView::Solid => {
            let replayed = ReplayedLever {
                task,
                tool: &best.tool,
                plan: &best.plan,
                motion,
                passed: best.verdict.as_ref().map(|verdict| verdict.passed),
                line: &lever_verdict_line(best.verdict.as_ref()),
                drawing: &figure.to_svg(),
            };
            let plan = written[0].display().to_string();
            lever_page(&replayed, Recipe::of_lever_file(&plan))
        }
    };
    written.push(output::write(&args.out, &format!("{name}.html"), page.as_bytes())?);
    Ok(written)
}
