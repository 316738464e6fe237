//! `pushplan export`: plans for other programs.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::json;

use pushplan::asset::{self, Fault, Faults, Kind, PlanFile, TrajectoryFile};
use pushplan::{outcome::Trajectory, scene::ModelSpec};
#[cfg(feature = "mcap")]
use pushplan_export::mcap;
use pushplan_export::{
    ExportError, LEVER_SCRIPT, REPLAY_SCRIPT, joint_table, joint_trajectory, mjcf,
};

use pushplan_report::Document;

use super::{error::CliError, exit_code, model, output, session::Session};

/// Export plans as MuJoCo scenes, MCAP recordings (Foxglove, Rerun) or joint trajectories (ROS)
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan export plans/pull-back.plan.json --out mjcf
  pip install mujoco && python3 mjcf/replay.py mjcf/pull-back.xml
  pushplan export plans/pull-back.plan.json --format mcap --model planar

mjcf writes <out>/<plan>.xml, a MuJoCo scene with the pushes and the goal of the plan. It also \
writes <out>/replay.py, which plays such scenes and reports for each whether the plan works. For \
plans with lever-ups, the script is <out>/lever.py.

mcap writes <out>/<plan>.mcap with the motion of the tool and the objects. Its JSON messages are \
foxglove.SceneUpdate (/scene) and foxglove.FrameTransforms (/tf), which Foxglove and Rerun play, \
and the same poses as plain numbers (/state, metres and radians). The plan is attached. --model \
predicts the motion of a plan; a trajectory file (`pushplan predict --trajectories`) already \
contains it. Wheels and released binaries write mcap; your own build needs `--features mcap`.

trajectory writes <out>/<plan>.joints.json, a ROS message trajectory_msgs/JointTrajectory, and \
<out>/<plan>.joints.csv. Times are in seconds, positions in radians and velocities in radians per \
second (for prismatic joints in metres). It needs a task whose robot has a `urdf`.")]
pub struct ExportArgs {
    /// Plan or trajectory files, which also contain the task and the tools
    #[arg(required = true, value_name = "PLAN")]
    plans: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Mjcf)]
    format: Format,
    #[arg(long, value_name = "MODEL", default_value = "3d", help = model::HELP)]
    model: ModelSpec,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = output::FOLDER)]
    out: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// MuJoCo scenes
    Mjcf,
    /// MCAP recordings for Foxglove, Rerun and others
    Mcap,
    /// Joint trajectories of an arm, for ROS and as a table
    Trajectory,
}

impl Format {
    /// Returns the file extension of the format.
    fn ending(self) -> &'static str {
        match self {
            Format::Mjcf => "xml",
            Format::Mcap => "mcap",
            Format::Trajectory => "joints.json",
        }
    }
}

pub fn run(args: &ExportArgs, session: &Session) -> Result<u8, CliError> {
    if args.format == Format::Mcap && !cfg!(feature = "mcap") {
        return Err(CliError::usage(
            "this build writes no MCAP",
            "build it with `--features mcap`, or use a wheel or binary of a release",
        ));
    }
    let (mut opened, mut faults) = (Vec::new(), Vec::new());
    for path in &args.plans {
        match open(path) {
            Ok((plan, known)) => opened.push((path, plan, known)),
            Err(found) => faults.extend(found.0),
        }
    }
    if !faults.is_empty() {
        return Err(Faults(faults).into());
    }
    let names: Vec<String> = args.plans.iter().map(|path| name(path, args.format)).collect();
    for (index, name) in names.iter().enumerate() {
        if names[..index].contains(name) {
            return Err(CliError::usage(
                format!("two plans would be written to {name}"),
                "export them to different folders",
            ));
        }
    }
    output::prepare(&args.out)?;
    let mut written = Vec::new();
    let in_space = |plan: &PlanFile| plan.task.in_space() || plan.plan.levers();
    let spaces: Vec<bool> = opened.iter().map(|(_, plan, _)| in_space(plan)).collect();
    for (name, (path, plan, known)) in names.iter().zip(opened) {
        let refused = |error: ExportError| CliError::File(format!("{}: {error}", path.display()));
        let bytes = match args.format {
            Format::Mjcf => mjcf(&plan).map_err(refused)?.into_bytes(),
            Format::Trajectory => joint_trajectory(&plan).map_err(refused)?.into_bytes(),
            Format::Mcap => {
                let trajectory = match known {
                    Some(trajectory) => trajectory,
                    None => carried_out(&plan, &args.model, session)?,
                };
                mcap(&plan, &trajectory).map_err(refused)?
            }
        };
        if args.format == Format::Trajectory {
            let table = joint_table(&plan).map_err(refused)?;
            let name = format!("{}csv", name.trim_end_matches("json"));
            written.push(output::write(&args.out, &name, table.as_bytes())?);
        }
        written.push(output::write(&args.out, name, &bytes)?);
    }
    if args.format == Format::Mjcf {
        for (script, text, of_space) in
            [("replay.py", REPLAY_SCRIPT, false), ("lever.py", LEVER_SCRIPT, true)]
        {
            if spaces.contains(&of_space) {
                written.push(output::write(&args.out, script, text.as_bytes())?);
            }
        }
    }
    if args.json {
        let document = Document { json: json!({"files": written}), ..Document::default() };
        session.print(&document.to_json())?;
    } else {
        let lines: Vec<String> =
            written.iter().map(|path| format!("wrote {}\n", path.display())).collect();
        session.print(&lines.concat())?;
    }
    Ok(exit_code::DONE)
}

/// Reads a plan, and its trajectory if the file contains one.
fn open(path: &Path) -> Result<(PlanFile, Option<Trajectory>), Faults> {
    match asset::check(path, None)? {
        Kind::Plan => PlanFile::load(path).map(|plan| (plan, None)),
        Kind::Trajectory => {
            let TrajectoryFile { task, tools, plan, trajectory } = TrajectoryFile::load(path)?;
            let model = Some(trajectory.by.clone());
            let plan = PlanFile { model, ..PlanFile::new(task, tools, plan) };
            Ok((plan, Some(trajectory)))
        }
        kind => {
            let message = format!("this is a {kind} file; `export` needs a plan or a trajectory");
            let advice =
                "`pushplan solve` writes plans, `pushplan predict --trajectories` trajectories";
            Err(Fault::of_file(&path.display().to_string(), message, advice).into())
        }
    }
}

/// Predicts the trajectory of a plan with a model.
fn carried_out(
    plan: &PlanFile,
    spec: &ModelSpec,
    session: &Session,
) -> Result<Trajectory, CliError> {
    use pushplan::effect::EffectModel;
    use pushplan::{
        outcome::Record,
        task::{Job, Motion},
    };
    let scene = &plan.task.scene;
    let motions = plan.plan.motions(&plan.tools).unwrap_or_default();
    let trajectory =
        // Steps after a lever-up are supported only by the engine.
        match motions.len() > 1 && plan.plan.levers() {
            false => {
                let model = model::load(spec)?;
                let job = |motion: &Motion| Job::stated(scene, motion.clone());
                let jobs: Vec<Job> = motions.iter().map(job).collect();
                session.compute(|| model.in_turn(scene, &jobs, Record::Frames))
            }
            true => Some(session.compute(|| {
                pushplan::sim::Simulator::spatial().run_plan(scene, &motions, Record::Frames)
            })),
        };
    let trajectory =
        trajectory.ok_or_else(|| CliError::unexpected("cannot predict the plan", spec))?;
    for warning in &trajectory.warnings {
        session.warn(&format!("{}: {warning}", trajectory.by));
    }
    Ok(trajectory)
}

/// Returns the name of the exported file: `a/b.plan.json` becomes `b.xml`, and
/// `a/b.3d.trajectory.json` becomes `b.3d.xml`.
fn name(path: &Path, format: Format) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".json").unwrap_or(&name);
    let stem = [".plan", ".trajectory"].iter().find_map(|kind| stem.strip_suffix(kind));
    let stem = stem.unwrap_or_else(|| name.strip_suffix(".json").unwrap_or(&name));
    format!("{stem}.{}", format.ending())
}

/// Replaces the writer in a build without MCAP, which rejects the format before it reads any file.
#[cfg(not(feature = "mcap"))]
fn mcap(_: &PlanFile, _: &Trajectory) -> Result<Vec<u8>, ExportError> {
    Err(ExportError::Mcap("this build writes no MCAP".to_owned()))
}
