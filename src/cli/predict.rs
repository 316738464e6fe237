//! `pushplan predict`: one action's effect, predicted beside simulated.

use std::path::PathBuf;

use clap::Args;

use crate::bench::timed_effect;
use crate::report::prediction_document;
use crate::scene::{Job, ModelKind, ModelSpec, Task, Warning};

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    form::Form,
    model::{self, OutsideArgs},
    push_argument::FORMS,
    session::Session,
};

/// Predict what pushes do: the network beside both simulations
#[derive(Args, Debug)]
#[command(after_help = FORMS, after_long_help = FORMS)]
pub struct PredictArgs {
    /// The task whose scene is pushed
    task: PathBuf,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    outside: OutsideArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &PredictArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    let task = Task::load(&args.task)?;
    let (plan, tool) = args.action.plan(&task, &library, session)?;
    let job = Job::stated(&task.scene, plan.motion(&tool));
    let mut specs = vec![args.model.clone()];
    let simulated = [ModelKind::PLANAR, ModelKind::SPATIAL].map(ModelSpec::of);
    specs.extend(simulated.into_iter().filter(|spec| *spec != args.model));
    let mut effects = Vec::new();
    for spec in specs {
        let model = args.outside.load(&spec)?;
        effects.extend(session.compute(|| timed_effect(&*model, &task.scene, &job)));
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
    args.form.show(session, &prediction_document(&task, &plan, &effects))?;
    Ok(exit_code::DONE)
}
