//! `pushplan predict`: predictions of one motion by several models, or errors of models on
//! recordings.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use pushplan::asset::{self, Kind, PlanFile, TrajectoryFile};
use pushplan::effect::EffectModel;
use pushplan::geometry::Pose;
use pushplan::sim::LeverSimulator;
use pushplan::{
    outcome::{Frame, Record, Trajectory, Warning, warning_lines},
    scene::{Engine, ModelKind, ModelSpec, Object, TableFit, Tool},
    task::{Job, Plan, Task},
};
use pushplan_bench::timed_effect;
use pushplan_report::{
    PageView, PoseRow, TaskSource, prediction_document, prediction_page, trajectory_figures,
};

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    form::Form,
    model::{self, OutOfRangeArgs},
    output,
    poses::PosesArgs,
    push_argument::forms,
    recorded,
    session::Session,
    task_argument,
    value_enums::{VIEWS, possible_values},
};

/// Predict the effect of a motion, or measure prediction errors on recordings
#[derive(Args, Debug)]
#[command(after_help = forms(), after_long_help = forms())]
pub struct PredictArgs {
    /// Task (with --tool and --push, or with --lever), or plan; or recordings, trajectories and
    /// folders of these, on which the errors of every model are measured
    #[arg(required_unless_present = "example", value_name = "TASK|PLAN|RECORDING")]
    pub files: Vec<PathBuf>,
    #[arg(long, value_name = "NAME", help = task_argument::HELP, conflicts_with = "files",
          hide_possible_values = true, value_parser = task_argument::example())]
    example: Option<String>,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_NETWORK)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    pub table: model::TableArgs,
    #[command(flatten)]
    pub out_of_range: OutOfRangeArgs,
    /// Evaluate this model alone, without the models for comparison
    #[arg(long)]
    pub alone: bool,
    #[command(flatten)]
    pub poses: PosesArgs,
    /// Folder for a page that plays the prediction of every model, named after the task; for
    /// recordings, folder for errors.json and curves of the errors by horizon
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also write the predicted frames of each model as a trajectory file, with a drawing
    #[arg(long, requires = "out")]
    trajectories: bool,
    /// Also write animations of the trajectories
    #[arg(long, requires = "trajectories")]
    animate: bool,
    /// View on the page
    #[arg(long, value_parser = possible_values(&VIEWS),
          value_name = "VIEW", default_value = "2d", requires = "out")]
    page: PageView,
    /// Print only one table for recordings, with a row for each folder
    #[arg(long)]
    pub summary: bool,
    #[command(flatten)]
    pub form: Form,
}

/// Kind of input on the command line.
enum Named<'a> {
    Example(&'a str),
    /// Task or plan.
    File(&'a Path, Kind),
    Recordings,
}

/// Prediction to compute.
struct Asked {
    source: TaskSource,
    task: Task,
    tools: Vec<Arc<Tool>>,
    plan: Plan,
    /// Table fit used by the plan's model.
    fit: Option<TableFit>,
}

pub fn run(args: &PredictArgs, session: &Session) -> Result<u8, CliError> {
    let named = args.named()?;
    args.out.as_deref().map(output::prepare).transpose()?;
    match named {
        Named::Example(name) => {
            let source = TaskSource::Example(name.to_owned());
            predict(args, args.acted(Task::example(name)?, source, session)?, session)
        }
        Named::File(file, kind) => predict(args, args.asked(file, kind, session)?, session),
        Named::Recordings if args.action.given() => Err(CliError::usage(
            "recordings already contain the pushes that were made",
            "omit --tool and --push, or name a single task",
        )),
        Named::Recordings => recorded::run(args, session),
    }
}

impl PredictArgs {
    /// Returns the given model, otherwise the network.
    pub fn spec(&self) -> ModelSpec {
        self.model.clone().unwrap_or(ModelKind::NETWORK.into())
    }

    fn named(&self) -> Result<Named<'_>, CliError> {
        if let Some(name) = &self.example {
            return Ok(Named::Example(name));
        }
        let file = match &self.files[..] {
            [file] if !file.is_dir() => file,
            _ => return Ok(Named::Recordings),
        };
        Ok(match asset::check(file, None)? {
            Kind::Recording | Kind::Trajectory => Named::Recordings,
            kind => Named::File(file, kind),
        })
    }

    /// Returns the plan of a plan file, or the action in a task.
    fn asked(&self, file: &Path, kind: Kind, session: &Session) -> Result<Asked, CliError> {
        let source = TaskSource::of(file);
        if kind == Kind::Plan {
            let PlanFile { task, tools, plan, model, fit, .. } = PlanFile::load(file)?;
            // The fit belongs only to the network that made the plan.
            let fit = fit.filter(|_| self.model.is_none() || self.model == model);
            return Ok(Asked { source, task, tools, plan, fit });
        }
        self.acted(Task::load(file)?, source, session)
    }

    /// Returns the action in a task.
    fn acted(&self, task: Task, source: TaskSource, session: &Session) -> Result<Asked, CliError> {
        let library = self.library.load()?;
        let (plan, tool) = self.action.plan(&task, &library, session)?;
        Ok(Asked { source, task, tools: vec![tool], plan, fit: None })
    }
}

fn predict(args: &PredictArgs, asked: Asked, session: &Session) -> Result<u8, CliError> {
    let Asked { source, mut task, tools, plan, fit } = asked;
    let fit = args.table.load()?.or(fit);
    if let Some(fit) = &fit {
        model::state(fit, &mut task.scene, session);
    }
    let motions = plan.motions(&tools).unwrap_or_default();
    let [motion] = &motions[..] else {
        return Err(CliError::usage(
            "`predict` needs a plan of exactly one motion",
            "`pushplan verify` replays the whole plan",
        ));
    };
    let spec = args.model.clone().unwrap_or(match task.levers {
        // The network of lever-ups supports only a plain table.
        Some(_) => ModelKind::PRIOR.into(),
        None => ModelKind::NETWORK.into(),
    });
    let job = Job::stated(&task.scene, motion.clone());
    let mut specs = vec![spec.clone()];
    if !args.alone {
        // Motions that leave the plane are simulated coarsely, as in planning, and finely.
        let coarse =
            ModelKind::Simulated { engine: Engine::Spatial, rate: LeverSimulator::COARSE.rate };
        let levers = motion.is_lever() || task.levers.is_some();
        let next = if levers { coarse } else { ModelKind::PLANAR };
        let simulated = [next, ModelKind::SPATIAL].map(ModelSpec::of);
        specs.extend(simulated.into_iter().filter(|other| *other != spec));
    }
    let (mut effects, mut trajectories) = (Vec::new(), Vec::new());
    for spec in specs {
        let model = args.out_of_range.fitted(&spec, fit.as_ref())?;
        effects.extend(session.compute(|| timed_effect(&*model, &task.scene, &job)));
        if args.poses.wanted() || args.out.is_some() {
            let jobs = std::slice::from_ref(&job);
            let rolled = session.compute(|| model.rollout(&task.scene, jobs, Record::Frames));
            trajectories.extend(rolled);
        }
    }
    for effect in &effects {
        let by = &effect.trajectory.by;
        let lines = warning_lines(&effect.warnings).into_iter();
        session.warn_each(&lines.map(|line| format!("{by}: {line}")).collect::<Vec<_>>());
        if effect.warnings.contains(&Warning::Refused) {
            return Err(CliError::Refused(format!("{by} declines to predict this action")));
        }
    }
    let rows: Vec<PoseRow> = trajectories.iter().flat_map(|found| poses(&task, found)).collect();
    args.poses.write(&rows)?;
    let mut document = prediction_document(&task, &plan, &effects);
    if let Some(out) = &args.out {
        let recipe = args.library.origin(source, Some(spec)).plan(&plan);
        let page = prediction_page(&task, &tools, &plan, &trajectories, recipe, args.page);
        let mut written =
            vec![output::write(out, &format!("{}.predict.html", task.name), page.as_bytes())?];
        if args.trajectories {
            let planned = (&task, &tools[..], &plan);
            written.extend(write_trajectories(planned, trajectories, args.animate, out)?);
        }
        document.wrote(&written);
    }
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}

/// Writes every trajectory with its pictures, and returns their paths.
fn write_trajectories(
    (task, tools, plan): (&Task, &[Arc<Tool>], &Plan),
    trajectories: Vec<Trajectory>,
    animate: bool,
    out: &Path,
) -> Result<Vec<PathBuf>, CliError> {
    let mut written = Vec::new();
    for trajectory in trajectories {
        // A name such as `3d,step=1/60` is not a valid file name on all systems.
        let by: String = trajectory.by.to_string();
        let by: String =
            by.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let name = format!("{}.{by}", task.name);
        let (task, tools, plan) = (task.clone(), tools.to_vec(), plan.clone());
        let file = TrajectoryFile { task, tools, plan, trajectory };
        let path = out.join(format!("{name}.trajectory.json"));
        file.write(&path).map_err(CliError::Output)?;
        written.push(path);
        written.extend(output::write_figures(out, &trajectory_figures(&file, &name, animate))?);
    }
    Ok(written)
}

/// Returns the pose of every object in every frame.
fn poses(task: &Task, trajectory: &Trajectory) -> Vec<PoseRow> {
    let by = trajectory.by.to_string();
    let of_frame = |frame: &Frame| -> Vec<PoseRow> {
        let pairs = task.scene.objects.iter().zip(&frame.state.poses);
        let row = |(object, pose): (&Object, &Pose)| PoseRow {
            name: task.name.clone(),
            by: by.clone(),
            object: object.name.clone(),
            time: frame.time,
            pose: *pose,
        };
        pairs.map(row).collect()
    };
    trajectory.frames.iter().flat_map(of_frame).collect()
}
