//! `pushplan simulate`: an action or a plan in one engine, every frame as a trajectory file.

use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::asset::{PlanFile, SCHEMA_VERSION, TrajectoryFile};
use crate::report::{ScenePicture, Source, Track, goal_line, millimetres, plan_line, push_table};
use crate::scene::{Engine, Job, Record, Task};
use crate::sim::Simulator;

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code, output,
    push_argument::FORMS,
    session::Session,
};

/// Simulate pushes and write every frame as a trajectory file, with a picture
#[derive(Args, Debug)]
#[command(after_help = FORMS)]
pub struct SimulateArgs {
    /// The task whose scene is pushed, or a plan file that is carried out as it is
    #[arg(value_name = "TASK|PLAN")]
    file: PathBuf,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Which engine
    #[arg(long, value_enum, default_value_t = EngineName::Planar)]
    engine: EngineName,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = output::FOLDER)]
    out: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum EngineName {
    /// Top-down, fast
    Planar,
    /// Full 3-D
    #[value(name = "3d")]
    Spatial,
}

pub fn run(args: &SimulateArgs, session: &Session) -> Result<u8, CliError> {
    let (task, plan, tool) = if args.action.given() {
        let task = Task::load(&args.file)?;
        let (plan, tool) = args.action.plan(&task, &args.library.load()?, session)?;
        (task, plan, tool)
    } else if args.file.extension().is_some_and(|end| end == "json") {
        let PlanFile { task, plan, tool, .. } = PlanFile::load(&args.file)?;
        (task, plan, tool)
    } else {
        return Err(CliError::usage(
            "nothing moves in a task alone",
            "add --tool and --push, or give a plan file (*.plan.json)",
        ));
    };
    output::prepare(&args.out)?;
    let (simulator, name) = match args.engine {
        EngineName::Planar => (Simulator::planar(), "planar"),
        EngineName::Spatial => (Simulator::spatial(), "3d"),
    };
    let motion = plan.motion(&tool);
    let job = Job::stated(&task.scene, motion.clone());
    let trajectory = session.compute(|| simulator.run(&task.scene, &job, Record::Frames));
    for warning in &trajectory.warnings {
        session.warn(&warning.to_string());
    }

    let engine = simulator.engine();
    let error = task.goal.error(trajectory.outcome());
    let picture = ScenePicture {
        title: format!("{}: {}", task.name, plan_line(&plan)),
        notes: vec![format!("{} from the goal at rest", millimetres(error))],
        scene: &task.scene,
        goal: Some(&task.goal),
        robot: Some(&task.robot),
        motion: Some(&motion),
        tracks: vec![Track { source: Source::Simulated(engine), trajectory: &trajectory }],
    };
    let stem = format!("{}.{name}", task.name);
    let svg = output::write(&args.out, &format!("{stem}.svg"), picture.to_svg().as_bytes())?;
    let path = args.out.join(format!("{stem}.trajectory.json"));
    let file = TrajectoryFile { tool: Arc::clone(&tool), plan, trajectory, task };
    file.write(&path).map_err(CliError::Output)?;
    report(args, session, &file, engine, &[path, svg])?;
    Ok(exit_code::DONE)
}

fn report(
    args: &SimulateArgs,
    session: &Session,
    file: &TrajectoryFile,
    engine: Engine,
    written: &[PathBuf],
) -> Result<(), CliError> {
    let end = file.trajectory.outcome();
    let error = file.task.goal.error(end);
    if args.json {
        let report = json!({
            "schema_version": SCHEMA_VERSION, "task": file.task.name, "engine": engine,
            "plan": file.plan, "frames": file.trajectory.frames.len(), "state": end,
            "goal_error": error, "warnings": file.trajectory.warnings, "files": written,
        });
        return session.print(&format!("{report:#}\n"));
    }
    let seconds = file.trajectory.frames.last().map_or(0.0, |frame| frame.time);
    let mut text = format!("{}\n{}\n", plan_line(&file.plan), push_table(&file.plan).to_text());
    text += &format!(
        "{} frames, {seconds:.2} s; {} from the goal: {}\n",
        file.trajectory.frames.len(),
        millimetres(error),
        goal_line(&file.task)
    );
    for path in written {
        text += &format!("wrote {}\n", path.display());
    }
    session.print(&text)
}
