//! `pushplan simulate`: an action or a plan in one engine, every frame as a trajectory file.

use std::path::PathBuf;

use clap::Args;

use crate::asset::{PlanFile, TrajectoryFile};
use crate::report::simulation_document;
use crate::scene::{Engine, Record, Task};
use crate::sim::Simulator;

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    form::Form,
    output,
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
    engine: Option<Engine>,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = output::FOLDER)]
    out: PathBuf,
    /// Draw a picture that moves as well
    #[arg(long)]
    animate: bool,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &SimulateArgs, session: &Session) -> Result<u8, CliError> {
    let (task, plan, tools) = if args.action.given() {
        let library = args.library.load()?;
        let task = Task::load(&args.file)?;
        let (plan, tool) = args.action.plan(&task, &library, session)?;
        (task, plan, vec![tool])
    } else if args.file.extension().is_some_and(|end| end == "json") {
        let file = PlanFile::load(&args.file)?;
        (file.task, file.plan, file.tools)
    } else {
        return Err(CliError::usage(
            "nothing moves in a task alone",
            "add --tool and --push (or --lever), or give a plan file (*.plan.json)",
        ));
    };
    let in_space = task.in_space() || plan.levers();
    if in_space && args.engine.is_some_and(|engine| engine != Engine::Spatial) {
        return Err(CliError::usage("lever-ups leave the plane", "use --engine 3d, or none"));
    }
    output::prepare(&args.out)?;
    let (simulator, name) =
        match args.engine.unwrap_or(if in_space { Engine::Spatial } else { Engine::Planar }) {
            Engine::Planar => (Simulator::planar(), format!("{}.planar", task.name)),
            Engine::Spatial => (Simulator::spatial(), format!("{}.3d", task.name)),
            Engine::Upright => (Simulator::upright(), format!("{}.3d-upright", task.name)),
        };
    let missing =
        || CliError::usage("the plan names tools that the file does not hold", "make it again");
    let motions = plan.motions(&tools).ok_or_else(missing)?;
    let trajectory = session.compute(|| simulator.run_plan(&task.scene, &motions, Record::Frames));
    for warning in &trajectory.warnings {
        session.warn(&warning.to_string());
    }
    let file = TrajectoryFile { tools, plan, trajectory, task };
    let mut document = simulation_document(&file, simulator.engine(), &name, args.animate);
    let path = args.out.join(format!("{name}.trajectory.json"));
    file.write(&path).map_err(CliError::Output)?;
    let mut written = vec![path];
    written.extend(output::write_figures(&args.out, document.figures())?);
    document.wrote(&written);
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}
