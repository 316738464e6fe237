//! `pushplan simulate` for a lever-up.

use std::sync::Arc;

use crate::asset::LeverTrajectoryFile;
use crate::cli::{error::CliError, exit_code, output, session::Session, simulate::SimulateArgs};
use crate::report::lever_simulation_document;
use crate::scene::{Engine, LeverJob, LeverPlan, LeverScene, Task, Tool};
use crate::sim::LeverSimulator;

use super::solve::FRAME;

/// Simulates one lever-up in 3-D, and writes every frame as a trajectory file, with a picture.
///
/// # Errors
/// Another engine than the 3-D one, and results that cannot be written.
pub fn simulate(
    args: &SimulateArgs,
    task: Task,
    (plan, tool): (LeverPlan, Arc<Tool>),
    session: &Session,
) -> Result<u8, CliError> {
    if args.engine.is_some_and(|engine| engine != Engine::Spatial) {
        return Err(CliError::usage("lever-ups leave the plane", "use --engine 3d, or none"));
    }
    if args.animate {
        session.warn("lever-ups have no picture that moves; the still one shows their frames");
    }
    output::prepare(&args.out)?;
    let name = format!("{}.3d", task.name);
    let job = LeverJob { scene: Arc::new(LeverScene::with(&task.scene, &tool)), lever: plan.lever };
    let (trajectory, motion) = session.compute(|| LeverSimulator::FINE.record(&job, FRAME));
    let outcome = task.goal.judge_lever(&job.scene, &job.lever, &trajectory);
    for warning in &trajectory.warnings {
        session.warn(&warning.to_string());
    }
    let file = LeverTrajectoryFile { task, tool, plan, trajectory, motion };
    let mut document = lever_simulation_document(&file, &outcome, &name);
    let path = args.out.join(format!("{name}.trajectory.json"));
    file.write(&path).map_err(CliError::Output)?;
    let mut written = vec![path];
    written.extend(output::write_figures(&args.out, document.figures())?);
    document.wrote(&written);
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}
