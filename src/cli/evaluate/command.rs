//! The command: what is measured on what.

use clap::Args;

use crate::bench::{HeldOut, HeldOutReport, SuiteKind, push_baselines};
use crate::cli::{
    action::LibraryArgs,
    error::CliError,
    exit_code,
    form::Form,
    model::{self, OutsideArgs},
    poses::PosesArgs,
    session::Session,
};
use crate::effect::EffectModel;
use crate::report::{evaluation_document, heldout_document};
use crate::scene::ModelSpec;

use super::crowds::Crowds;
use super::on::On;
use super::sources::{CrowdArgs, Sources};

/// Measure prediction errors on held-out pushes, crowds and your own recordings
#[derive(Args, Debug)]
#[command(after_help = "What to measure on, any of:
  tools          all pushes of a shipped tool: single, single-any-speed, touching (default)
  sparse, dense  scenes of 6 to 12 objects, some joined, pushed by a round hand
  sparse-line    the same with one long stroke
  all            sparse and dense
  FILE, FOLDER   your own recordings (`pushplan schema recording`), or trajectory files; those of
                 a folder are measured together

Examples:
  pushplan evaluate --on single --pushes 2000
  pushplan evaluate --on dense --objects 9 --count 50 --out plans
  pushplan evaluate runs/full/best.safetensors --on push.recording.json
  pushplan evaluate prior --on recordings/ --export poses.csv")]
pub struct EvaluateArgs {
    /// The model, the same as --model
    #[arg(value_name = "MODEL", conflicts_with = "model")]
    positional: Option<ModelSpec>,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    outside: OutsideArgs,
    /// What to measure on, see below; several may be given
    #[arg(long, value_name = "WHAT", num_args = 1..)]
    on: Vec<On>,
    /// Pushes of each kind of tool pushes
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pushes: u32,
    /// Seed of the pushes and scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    crowd: CrowdArgs,
    #[command(flatten)]
    poses: PosesArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &EvaluateArgs, session: &Session) -> Result<u8, CliError> {
    let model = args.positional.as_ref().unwrap_or(&args.model);
    let (mut kinds, mut families, mut files) = (Vec::new(), Vec::new(), Vec::new());
    for on in &args.on {
        match on {
            On::Tools(named) => kinds.extend(named),
            On::Crowds(named) => families.extend(named),
            On::File(path) => files.push(path.clone()),
        }
    }
    if args.on.is_empty() {
        kinds = SuiteKind::ALL.to_vec();
    }
    let sources = Sources::load(&families, &files, &args.crowd)?;
    let suites = tools(args, model, &kinds, session)?;
    let crowds = Crowds {
        sources: &sources,
        model,
        outside: args.outside,
        seed: args.seed,
        args: &args.crowd,
        poses: &args.poses,
        form: args.form,
    }
    .run(session)?;
    args.form.show_rest(session, &evaluation_document(&suites, &crowds), crowds.len() > 1)?;
    Ok(exit_code::DONE)
}

/// Errors on pushes of the shipped tools.
fn tools(
    args: &EvaluateArgs,
    spec: &ModelSpec,
    kinds: &[SuiteKind],
    session: &Session,
) -> Result<Vec<HeldOutReport>, CliError> {
    if kinds.is_empty() {
        return Ok(Vec::new());
    }
    let library = args.library.load()?;
    let mut models: Vec<Box<dyn EffectModel>> = vec![Box::new(args.outside.load(spec)?)];
    for other in push_baselines(spec) {
        models.push(Box::new(model::load(&other)?));
    }
    let mut reports = Vec::new();
    for kind in kinds {
        let spinner = session.spinner(kind.title());
        let report = session.compute(|| {
            spinner.set_message("simulating");
            let truth = HeldOut::prepare(*kind, &library, args.seed, args.pushes as usize);
            spinner.set_message("predicting");
            let models: Vec<&dyn EffectModel> = models.iter().map(|model| &**model).collect();
            truth.report(&models)
        });
        spinner.finish_and_clear();
        args.form.show_part(session, &heldout_document(&report))?;
        reports.push(report);
    }
    Ok(reports)
}
