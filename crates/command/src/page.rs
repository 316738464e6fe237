//! The page of a replayed plan.

use std::path::{Path, PathBuf};

use pushplan::asset::PlanFile;
use pushplan::effect::EffectModel;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::ModelSpec,
    task::Job,
};
use pushplan_report::{Judged, PageView, Recipe, verdict_page};

use super::{error::CliError, model, output, session::Session};

/// Writes the page `<task>.verify.html` with the prediction of the plan's effect model and the
/// replays, and returns its path. `recipe` repeats the replays.
///
/// # Errors
/// Returns an error if the page cannot be written.
pub fn write<'a>(
    out: &Path,
    session: &Session,
    file: &PlanFile,
    judged: impl Into<Judged<'a>>,
    (recipe, view): (Recipe, PageView),
) -> Result<PathBuf, CliError> {
    let predicted = file.model.as_ref().and_then(|spec| {
        let predicted = predict(session, file, spec);
        let warn = |error| session.warn(&format!("the page shows no prediction: {error}"));
        predicted.map_err(warn).ok()?
    });
    let page = verdict_page(file, predicted.as_ref(), judged, recipe, view);
    output::write(out, &name(file), page.as_bytes())
}

/// Returns the file name of the page.
pub fn name(file: &PlanFile) -> String {
    format!("{}.verify.html", file.task.name)
}

/// Predicts a plan with a model; returns `None` if the model declines it.
fn predict(
    session: &Session,
    file: &PlanFile,
    spec: &ModelSpec,
) -> Result<Option<Trajectory>, CliError> {
    let motions = file.plan.motions(&file.tools).unwrap_or_default();
    // Planar models do not support steps after a lever-up.
    if motions.len() > 1 && file.plan.levers() {
        return Ok(None);
    }
    let (model, scene) = (model::load(spec)?, &file.task.scene);
    let jobs: Vec<Job> = motions.into_iter().map(|motion| Job::stated(scene, motion)).collect();
    Ok(session.compute(|| model.in_turn(scene, &jobs, Record::Frames)))
}
