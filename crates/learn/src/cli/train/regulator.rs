//! `pushplan-learn train regulator`: trains the belief regulator.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use pushplan::internals::effect::{EffectModels, Network};
use pushplan::internals::scene::{ModelKind, ModelSpec};
use pushplan_command::bench::weights_digest;
use pushplan_command::error::CliError;
use pushplan_command::session::Session;

use crate::cli::train::{data, take, weights};
use crate::dataset::lessons;
use crate::train::{Descent, RegulatorSettings, train_regulator};

/// Train the belief regulator
#[derive(Args, Debug)]
#[command(
    after_help = "Lessons are noisy observations of crowds, some without headings of cylinders, \
with the belief of the filter after every window. They are saved in the subfolders `lessons` and \
`held-out`. The shipped propagation network is not changed.

Examples:
  pushplan-learn train regulator runs/regulator
  pushplan-learn train regulator runs/small --lessons 200 --held-out 40 --steps 400"
)]
pub struct RegulatorArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of training lessons
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().lessons,
          value_parser = clap::value_parser!(u64).range(1..))]
    lessons: u64,
    /// Seed of the training lessons
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().data_seed)]
    data_seed: u64,
    /// Number of held-out lessons
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = clap::value_parser!(u64).range(1..))]
    held_out: u64,
    /// Seed of the held-out lessons; it must differ from --data-seed
    #[arg(long, value_name = "N", default_value_t = 2)]
    held_out_seed: u64,
    /// Number of training steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Number of steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N",
          default_value_t = RegulatorSettings::default().descent.evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Width of the hidden state
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().width as u32,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    width: u32,
    /// Seed of the initial weights and the batches
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().seed)]
    seed: u64,
}

pub fn run(args: &RegulatorArgs, session: &Session) -> Result<u8, CliError> {
    if args.data_seed == args.held_out_seed {
        let message = "training lessons and held-out lessons have the same seed";
        return Err(CliError::usage(message, "choose another --held-out-seed"));
    }
    let default = RegulatorSettings::default();
    let settings = RegulatorSettings {
        width: args.width as usize,
        seed: args.seed,
        descent: Descent {
            evaluate_every: args.evaluate_every,
            ..default.descent.in_steps(args.steps)
        },
        data_seed: args.data_seed,
        lessons: args.lessons,
    };
    let shipped = EffectModels::weights()
        .map_err(|error| CliError::unexpected("cannot read the shipped weights", &error))?;
    let network = Arc::new(Network::new(shipped));
    let digest = weights_digest(&ModelSpec::from(ModelKind::NETWORK))?.unwrap_or_default();
    let folder = take(&args.folder, session)?;
    let draw = |name: &str, of: (u64, u64)| {
        let directory = args.folder.join(name);
        data(session, name, |progress| {
            lessons(of, (&network, digest.clone()), &directory, progress)
        })
    };
    let held_out = draw("held-out", (args.held_out_seed, args.held_out))?;
    let all = draw("lessons", (args.data_seed, args.lessons))?;
    weights(session, |progress| train_regulator(&settings, &all, &held_out, &folder, progress))
}
