//! The command and its arguments.

use clap::Args;
use pushplan::internals::scene::ModelSpec;
use pushplan_bench::store::Shard;
use pushplan_command::action::LibraryArgs;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::model::OutOfRangeArgs;
use pushplan_command::session::Session;
use pushplan_command::{exit_code, model, output};

use crate::bench::SuiteKind;
use crate::cli::evaluate::crowds::Crowds;
use crate::cli::evaluate::on::On;
use crate::cli::evaluate::parts::Parts;
use crate::cli::evaluate::sources::CrowdArgs;
use crate::report::evaluation_document;
use crate::trivial;

/// Measure prediction errors on held-out pushes and crowds
#[derive(Args, Debug)]
#[command(after_help = "Test sets of --on:
  tools          all pushes of the shipped tools: single, single-any-speed, touching (default)
  sparse, dense  scenes of 6 to 12 objects, some joined, pushed by a round hand
  sparse-line    sparse scenes with one long stroke
  all            sparse and dense

With --out, every finished part (a kind of pushes, a set of scenes) is saved at once. After an \
interruption (Ctrl-C), rerun the same command to resume. --shard 2/3 measures every third part, \
for example on another machine; `pushplan-lab merge OUT SHARD...` merges the shards into the files \
of a single run.

Examples:
  pushplan-lab evaluate --on single --pushes 2000
  pushplan-lab evaluate --on dense --objects 9 --count 50 --out plans
  pushplan-lab evaluate runs/full/best.safetensors --on tools")]
pub struct EvaluateArgs {
    /// Effect model, as in --model
    #[arg(value_name = "MODEL", conflicts_with = "model", value_parser = trivial::spec)]
    positional: Option<ModelSpec>,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP,
          value_parser = trivial::spec)]
    model: ModelSpec,
    #[command(flatten)]
    pub out_of_range: OutOfRangeArgs,
    /// Test sets, one or more, see below
    #[arg(long, value_name = "WHAT", num_args = 1..)]
    on: Vec<On>,
    /// Number of pushes of each kind of tool pushes
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub pushes: u32,
    /// Seed of the pushes and scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    pub seed: u64,
    /// Measure only shard I of N; kinds of pushes and sets of scenes are never split
    #[arg(long, value_name = "I/N", requires = "out")]
    pub shard: Option<Shard>,
    #[command(flatten)]
    pub crowd: CrowdArgs,
    #[command(flatten)]
    pub library: LibraryArgs,
    #[command(flatten)]
    pub form: Form,
}

pub fn run(args: &EvaluateArgs, session: &Session) -> Result<u8, CliError> {
    let model = args.positional.as_ref().unwrap_or(&args.model);
    let (mut kinds, mut families) = (Vec::new(), Vec::new());
    for on in &args.on {
        match on {
            On::Tools(named) => kinds.extend(named),
            On::Crowds(named) => families.extend(named),
        }
    }
    if args.on.is_empty() {
        kinds = SuiteKind::ALL.to_vec();
    }
    let sets = args.crowd.sets(&families)?;
    if let Some(folder) = &args.crowd.out {
        output::prepare(folder)?;
    }
    let crowds = Crowds {
        sets: &sets,
        model,
        out_of_range: args.out_of_range,
        seed: args.seed,
        args: &args.crowd,
        form: args.form,
    };
    let (suites, reports) = Parts { args, kinds: &kinds, crowds: &crowds }.run(session)?;
    let several = reports.len() > 1 || args.crowd.summary && !reports.is_empty();
    args.form.show_rest(session, &evaluation_document(&suites, &reports), several)?;
    Ok(exit_code::DONE)
}
