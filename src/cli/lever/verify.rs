//! `pushplan verify` for a plan of levering.

use std::sync::Arc;

use crate::asset::LeverPlanFile;
use crate::cli::{
    error::CliError, exit_code, follow::Following, output, session::Session, verify::VerifyArgs,
};
use crate::report::{
    PageView, Recipe, ReplayedLever, lever_figure, lever_page, lever_verdict_document,
    lever_verdict_line,
};
use crate::scene::{LeverJob, LeverScene};
use crate::sim::LeverSimulator;
use crate::verify::{LeverVerifier, VerifySettings};
use crate::watch::Until;

use super::solve::FRAME;

/// Replays a lever-up and gives a verdict.
///
/// # Errors
/// Results that cannot be written.
pub fn verify(
    args: &VerifyArgs,
    mut file: LeverPlanFile,
    session: &Session,
) -> Result<u8, CliError> {
    file.task.robustness = args.robustness.unwrap_or(file.task.robustness);
    let settings = VerifySettings { disturbed: args.disturbed as usize, seed: args.seed };
    let following = Following::spinner(session, "replaying");
    let until = Until::new(&following, args.time_limit);
    let verifier = LeverVerifier::new(settings).watched(&until);
    let (task, tool, plan) = (&file.task, &file.tool, &file.plan);
    let verdict = session.compute(|| verifier.verify(task, tool, plan));
    following.finish()?;
    let mut document = lever_verdict_document(&file, &verdict);
    let mut written = Ok(());
    // A plan that names what is not there has nothing to be drawn.
    if let (Some(out), Some(_)) = (&args.out, verdict.nominal()) {
        let scene = Arc::new(LeverScene::with(&task.scene, tool));
        let job = LeverJob { scene, lever: plan.lever };
        let (_, motion) = session.compute(|| LeverSimulator::FINE.record(&job, FRAME));
        let line = lever_verdict_line(Some(&verdict));
        let told = [format!("verdict: {line}")];
        let figure = lever_figure(task, (tool, plan), &motion, &told, &task.name);
        let drawing = figure.to_svg();
        if let Some(last) = document.sections.last_mut() {
            last.figures.push(figure);
        }
        let page = match args.page {
            PageView::Above => document.to_html(),
            PageView::Solid => {
                let (passed, motion) = (Some(verdict.passed), &motion);
                let (line, drawing) = (&*line, &*drawing);
                let replayed = ReplayedLever { task, tool, plan, motion, passed, line, drawing };
                lever_page(&replayed, Recipe::of_lever_file(&args.plan.display().to_string()))
            }
        };
        let name = format!("{}.html", task.name);
        written = output::write(out, &name, page.as_bytes()).map(|path| document.wrote(&[path]));
    }
    args.form.show(session, &document)?;
    written?;
    Ok(match (verdict.passed, verdict.works()) {
        (true, _) => exit_code::DONE,
        (false, true) => exit_code::FRAGILE,
        (false, false) => exit_code::FAILED_VERIFICATION,
    })
}
