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
    solve::{SolveArgs, solve_error},
};
use crate::report::{Figure, lever_figure, lever_solution_document, lever_verdict_line};
use crate::scene::{LeverJob, LeverTask};
use crate::sim::LeverSimulator;
use crate::solve::PlanStatus;
use crate::solve::lever::{LeverPlanner, RankedLever};

use super::model::lever_model;

/// Between two frames of what pictures show, seconds.
pub const FRAME: f64 = 0.02;

/// Chooses a tool and a lever-up, verifies it, writes plan, picture and page.
///
/// # Errors
/// What is wrong with the task, and results that cannot be written.
pub fn solve(
    args: &SolveArgs,
    mut task: LeverTask,
    library: &ToolLibrary,
    session: &Session,
) -> Result<u8, CliError> {
    task.robustness = args.robustness.unwrap_or(task.robustness);
    let model = lever_model(args.model.as_ref())?;
    output::prepare(&args.out)?;
    let planner = LeverPlanner::new(model, args.effort).seeded(args.seed).within(args.time_limit);
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
    let figures: Vec<Figure> =
        solution.best().map(|best| figure(session, &task, best, &name)).into_iter().collect();
    let mut document = lever_solution_document(&task, &solution, figures);
    let written = match solution.best() {
        Some(best) => write(args, &task, best, &name, &document),
        None => Ok(Vec::new()),
    };
    // A plan that took minutes is shown also where the disk has no place for it.
    document.wrote(written.as_deref().unwrap_or_default());
    args.form.show(session, &document)?;
    written.map(|_| code)
}

fn figure(session: &Session, task: &LeverTask, best: &RankedLever, name: &str) -> Figure {
    let scene = Arc::new(task.scene(best.tool.blade));
    let job = LeverJob { scene, lever: best.plan.lever };
    let (_, motion) = session.compute(|| LeverSimulator::FINE.record(&job, FRAME));
    let line = format!("verdict: {}", lever_verdict_line(best.verdict.as_ref()));
    lever_figure(task, (&best.tool, &best.plan), &motion, &[line], name)
}

/// The plan file, the picture and the page.
fn write(
    args: &SolveArgs,
    task: &LeverTask,
    best: &RankedLever,
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
    written.push(output::write(&args.out, &format!("{name}.html"), document.to_html().as_bytes())?);
    Ok(written)
}
