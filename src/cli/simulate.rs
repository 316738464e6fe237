//! `pushplan simulate`: an action or a plan in one engine, every frame as a trajectory file.

use std::path::PathBuf;

use clap::Args;

use crate::asset::{AnyPlanFile, TrajectoryFile};
use crate::report::simulation_document;
use crate::scene::{Engine, Job, Record, Task};
use crate::sim::Simulator;

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    form::Form,
    lever, output,
    push_argument::forms,
    session::Session,
    words::{ENGINES, words},
};

/// Simulate pushes and write every frame as a trajectory file, with a picture
#[derive(Args, Debug)]
#[command(after_help = forms())]
pub struct SimulateArgs {
    /// The task whose scene is pushed, or a plan file that is carried out as it is
    #[arg(value_name = "TASK|PLAN")]
    file: PathBuf,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Which engine [default: planar; 3d for lever-ups]
    #[arg(long, value_parser = words(&ENGINES))]
    pub engine: Option<Engine>,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = output::FOLDER)]
    pub out: PathBuf,
    /// Draw a picture that moves as well
    #[arg(long)]
    pub animate: bool,
    #[command(flatten)]
    pub form: Form,
}

pub fn run(args: &SimulateArgs, session: &Session) -> Result<u8, CliError> {
    let (task, plan, tool) = if args.action.given() {
        let library = args.library.load()?;
        let task = Task::load(&args.file)?;
        if task.levers.is_some() {
            let planned = lever::lever_plan(&task, &library, args.action.lever()?, session)?;
            return lever::simulate(args, task, planned, session);
        }
        let (plan, tool) = args.action.plan(&task, &library, session)?;
        (task, plan, tool)
    } else if args.file.extension().is_some_and(|end| end == "json") {
        match AnyPlanFile::load(&args.file)? {
            AnyPlanFile::Pushes(file) => (file.task, file.plan, file.tool),
            AnyPlanFile::Levers(file) => {
                return lever::simulate(args, file.task, (file.plan, file.tool), session);
            }
        }
    } else {
        return Err(CliError::usage(
            "nothing moves in a task alone",
            "add --tool and --push (or --lever), or give a plan file (*.plan.json)",
        ));
    };
    output::prepare(&args.out)?;
    let (simulator, name) = match args.engine.unwrap_or(Engine::Planar) {
        Engine::Planar => (Simulator::planar(), format!("{}.planar", task.name)),
        Engine::Spatial => (Simulator::spatial(), format!("{}.3d", task.name)),
        Engine::Upright => (Simulator::upright(), format!("{}.3d-upright", task.name)),
    };
    let job = Job::stated(&task.scene, plan.motion(&tool));
    let trajectory = session.compute(|| simulator.run(&task.scene, &job, Record::Frames));
    for warning in &trajectory.warnings {
        session.warn(&warning.to_string());
    }
    let file = TrajectoryFile { tool, plan, trajectory, task };
    let mut document = simulation_document(&file, simulator.engine(), &name, args.animate);
    let path = args.out.join(format!("{name}.trajectory.json"));
    file.write(&path).map_err(CliError::Output)?;
    let mut written = vec![path];
    written.extend(output::write_figures(&args.out, document.figures())?);
    document.wrote(&written);
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}
