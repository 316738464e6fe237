//! `pushplan predict` for a lever-up.

use std::sync::Arc;
use std::time::Instant;

use crate::asset::LeverTrajectoryFile;
use crate::cli::{error::CliError, exit_code, output, predict::PredictArgs, session::Session};
use crate::effect::{LeverModel, LeverTrust, SimulatedLevers};
use crate::report::{
    PageView, PredictedLever, Recipe, ReplayedLever, lever_figure, lever_page,
    lever_prediction_document,
};
use crate::scene::{LeverJob, LeverPlan, LeverScene, Task, Tool};
use crate::sim::LeverSimulator;

use super::model::lever_model;
use super::solve::FRAME;

/// Predicts one lever-up by a model, beside coarse and fine simulation.
///
/// # Errors
/// Results that cannot be written.
pub fn predict(
    args: &PredictArgs,
    task: &Task,
    (plan, tool): (LeverPlan, Arc<Tool>),
    session: &Session,
) -> Result<u8, CliError> {
    if args.poses.wanted() {
        return Err(CliError::usage(
            "poses of lever-ups are in space and have no such file",
            "`--out DIR --trajectories` writes them into a trajectory file",
        ));
    }
    let job = LeverJob { scene: Arc::new(LeverScene::with(&task.scene, &tool)), lever: plan.lever };
    let mut models = vec![lever_model(args.model.as_ref())?];
    let beside = if args.alone { &[][..] } else { &[LeverSimulator::COARSE, LeverSimulator::FINE] };
    for &simulator in beside {
        let simulated = SimulatedLevers { simulator };
        if models.iter().all(|known| known.name() != simulated.name()) {
            models.push(Arc::new(simulated));
        }
    }
    let mut predicted = Vec::new();
    for model in &models {
        if model.trust(&job) == LeverTrust::NotMine {
            session.warn(&format!("{}: leaves out something that matters here", model.name()));
        }
        let began = Instant::now();
        let rolled = session.compute(|| model.rollout(std::slice::from_ref(&job)));
        let seconds = began.elapsed().as_secs_f64();
        predicted.extend(rolled.into_iter().map(|trajectory| {
            let outcome = task.goal.judge_lever(&job.scene, &job.lever, &trajectory);
            PredictedLever { by: model.name(), trajectory, outcome, seconds }
        }));
    }
    let replayed = args.out.as_ref().map(|_| {
        let (trajectory, motion) = session.compute(|| LeverSimulator::FINE.record(&job, FRAME));
        (lever_figure(task, (&tool, &plan), &motion, &[], &task.name), trajectory, motion)
    });
    let figures = replayed.iter().map(|(figure, ..)| figure.clone()).collect();
    let mut document = lever_prediction_document(task, &plan, &predicted, figures);
    if let Some((out, (figure, trajectory, motion))) = args.out.as_ref().zip(replayed) {
        let page = match args.page {
            PageView::Above => document.to_html(),
            PageView::Solid => {
                let says = |one: &PredictedLever| {
                    let word = if one.outcome.reached { "reaches" } else { "misses" };
                    format!("{} {word} the goal", one.by)
                };
                let line = predicted.iter().map(says).collect::<Vec<_>>().join(", ");
                let (line, drawing) = (&*line, &*figure.to_svg());
                let (tool, plan, motion) = (&*tool, &plan, &motion);
                let replayed =
                    ReplayedLever { task, tool, plan, motion, passed: None, line, drawing };
                lever_page(&replayed, Recipe::default())
            }
        };
        let mut written =
            vec![output::write(out, &format!("{}.html", task.name), page.as_bytes())?];
        if args.trajectories {
            let name = format!("{}.3d", task.name);
            let path = out.join(format!("{name}.trajectory.json"));
            written.push(output::write(out, &format!("{name}.svg"), figure.to_svg().as_bytes())?);
            let file = LeverTrajectoryFile { task: task.clone(), tool, plan, trajectory, motion };
            file.write(&path).map_err(CliError::Output)?;
            written.push(path);
        }
        document.wrote(&written);
    }
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}
