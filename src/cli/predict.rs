//! `pushplan predict`: one action's effect, predicted beside simulated.

use std::path::PathBuf;

use clap::Args;

use crate::bench::timed_effect;
use crate::effect::EffectModel;
use crate::geometry::Pose;
use crate::report::{PageView, PoseRow, prediction_document, prediction_page};
use crate::scene::{
    Engine, Frame, Job, ModelKind, ModelSpec, Object, Record, Task, Trajectory, Warning,
};
use crate::sim::LeverSimulator;

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    form::Form,
    model::{self, OutsideArgs},
    output,
    poses::PosesArgs,
    push_argument::forms,
    session::Session,
    words::{VIEWS, words},
};

/// Predict what pushes do: the network beside both simulations
#[derive(Args, Debug)]
#[command(after_help = forms(), after_long_help = forms())]
pub struct PredictArgs {
    /// The task whose scene is pushed
    task: PathBuf,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_NETWORK)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    outside: OutsideArgs,
    #[command(flatten)]
    poses: PosesArgs,
    /// Folder for a page that plays what every model says, named after the task
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// What the page shows
    #[arg(long, value_parser = words(&VIEWS), value_name = "VIEW", default_value = "2d", requires = "out")]
    page: PageView,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &PredictArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    args.out.as_deref().map(output::prepare).transpose()?;
    let task = Task::load(&args.task)?;
    let asked = args.model.clone().unwrap_or(match task.levers {
        // Among other things than a plain table the network of lever-ups knows nothing.
        Some(_) => ModelKind::PRIOR.into(),
        None => ModelKind::NETWORK.into(),
    });
    let (plan, tool) = args.action.plan(&task, &library, session)?;
    let tools = [tool];
    let motion = plan.motions(&tools).and_then(|motions| motions.into_iter().next());
    let motion = motion.ok_or_else(|| CliError::usage("nothing moves", "add a push"))?;
    let in_space = motion.is_lever() || task.in_space();
    let job = Job::stated(&task.scene, motion);
    let mut specs = vec![asked.clone()];
    // What leaves the plane is simulated coarsely, as planning does, and finely.
    let coarse =
        ModelKind::Simulated { engine: Engine::Spatial, rate: LeverSimulator::COARSE.rate };
    let beside = if in_space { coarse } else { ModelKind::PLANAR };
    let simulated = [beside, ModelKind::SPATIAL].map(ModelSpec::of);
    specs.extend(simulated.into_iter().filter(|spec| *spec != asked));
    let (mut effects, mut trajectories) = (Vec::new(), Vec::new());
    for spec in specs {
        let model = args.outside.load(&spec)?;
        effects.extend(session.compute(|| timed_effect(&*model, &task.scene, &job)));
        if args.poses.wanted() || args.out.is_some() {
            let jobs = std::slice::from_ref(&job);
            let rolled = session.compute(|| model.rollout(&task.scene, jobs, Record::Frames));
            trajectories.extend(rolled);
        }
    }
    for effect in &effects {
        let by = &effect.trajectory.by;
        for warning in &effect.warnings {
            session.warn(&format!("{by}: {warning}"));
        }
        if effect.warnings.contains(&Warning::Refused) {
            return Err(CliError::Refused(format!("{by} gives no prediction for this action")));
        }
    }
    let rows: Vec<PoseRow> = trajectories.iter().flat_map(|found| poses(&task, found)).collect();
    args.poses.write(&rows)?;
    let mut document = prediction_document(&task, &plan, &effects);
    if let Some(out) = &args.out {
        let recipe = args.library.origin(&args.task, Some(asked.clone())).plan(&plan);
        let page = prediction_page(&task, &tools, &plan, &trajectories, recipe, args.page);
        let path = output::write(out, &format!("{}.html", task.name), page.as_bytes())?;
        document.wrote(&[path]);
    }
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}

/// Every object in every frame.
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
