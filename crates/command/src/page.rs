//! The page of a plan that was replayed.

use std::path::{Path, PathBuf};

use pushplan::asset::PlanFile;
use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory, Verdict},
    scene::ModelSpec,
    task::Job,
};
use pushplan_report::{PageView, Recipe, verdict_page};

use super::{error::CliError, model, output, session::Session};

/// Writes the page `<task>.verify.html` with what the plan's effect model says next to the replays, and
/// gives its path; `recipe` makes the replays
/// again.
///
/// # Errors
/// If it cannot be written.
pub fn write(
    out: &Path,
    session: &Session,
    file: &PlanFile,
    verdict: &Verdict,
    (recipe, view): (Recipe, PageView),
) -> Result<PathBuf, CliError> {
    let predicted = file.model.as_ref().and_then(|spec| {
        let predicted = predict(session, file, spec);
        let warn = |error| session.warn(&format!("the page shows no prediction: {error}"));
        predicted.map_err(warn).ok()?
    });
    let page = verdict_page(file, predicted.as_ref(), verdict, recipe, view);
    output::write(out, &format!("{}.verify.html", file.task.name), page.as_bytes())
}

/// What a model says of a plan; `None` if it gives no trajectory.
fn predict(
    session: &Session,
    file: &PlanFile,
    spec: &ModelSpec,
) -> Result<Option<Trajectory>, CliError> {
    let motions = file.plan.motions(&file.tools).unwrap_or_default();
    // What follows something levered no model of the plane tells.
    if motions.len() > 1 && file.plan.levers() {
        return Ok(None);
    }
    let (model, scene) = (model::load(spec)?, &file.task.scene);
    let jobs: Vec<Job> = motions.into_iter().map(|motion| Job::stated(scene, motion)).collect();
    Ok(session.compute(|| model.in_turn(scene, &jobs, Record::Frames)))
}
