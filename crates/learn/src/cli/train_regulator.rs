//! `pushplan-learn train-regulator`: the belief regulator's weights, in a folder that holds the whole run.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use pushplan::cli::bench::weights_digest;
use pushplan::cli::error::CliError;
use pushplan::cli::follow::Following;
use pushplan::cli::session::Session;
use pushplan::cli::{exit_code, interrupt};
use pushplan::internals::effect::{EffectModels, Network};
use pushplan::internals::scene::ModelSpec;
use pushplan::internals::store::FolderLock;

use crate::cli::generate::data_error;
use crate::cli::train::train_error;
use crate::dataset::lessons;
use crate::train::{Descent, RegulatorSettings, train_regulator};

/// Train the belief regulator; the same command goes on with an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "Lessons are crowds that are seen with noise, some of them without the headings of cylinders, and what
the filter made of every window; they are kept in the folder's `lessons` and `held-out`. The shipped
propagation network is not changed. Beside them lie checkpoint.safetensors to go on from,
metrics.jsonl, and best.safetensors, the weights with the lowest held-out negative log-likelihood.
Ctrl-C saves and stops; the same command then goes on, to the same bits as a run that never stopped.

Examples:
  pushplan-learn train-regulator runs/regulator
  pushplan-learn train-regulator runs/small --lessons 200 --held-out 40 --steps 400"
)]
pub struct TrainRegulatorArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of lessons
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().lessons,
          value_parser = clap::value_parser!(u64).range(1..))]
    lessons: u64,
    /// Seed of the lessons
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().data_seed)]
    data_seed: u64,
    /// Number of held-out lessons
    #[arg(long, value_name = "N", default_value_t = 300,
          value_parser = clap::value_parser!(u64).range(1..))]
    held_out: u64,
    /// Seed of the held-out lessons; must differ from that of the others
    #[arg(long, value_name = "N", default_value_t = 2)]
    held_out_seed: u64,
    /// Steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Width of the hidden state
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().width as u32,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    width: u32,
    /// Seed of first weights and batches
    #[arg(long, value_name = "N", default_value_t = RegulatorSettings::default().seed)]
    seed: u64,
}

pub fn run(args: &TrainRegulatorArgs, session: &Session) -> Result<u8, CliError> {
    if args.data_seed == args.held_out_seed {
        let message = "the held-out lessons have the seed of the others";
        return Err(CliError::usage(message, "choose another --held-out-seed"));
    }
    let default = RegulatorSettings::default();
    let settings = RegulatorSettings {
        width: args.width as usize,
        seed: args.seed,
        evaluate_every: args.evaluate_every,
        descent: Descent {
            steps: args.steps,
            // A short run must get past its warm-up as well.
            warm_up: default.descent.warm_up.min(args.steps / 10),
            ..default.descent
        },
        data_seed: args.data_seed,
        lessons: args.lessons,
        ..default
    };
    let weights = EffectModels::weights()
        .map_err(|error| CliError::unexpected("cannot read the shipped weights", &error))?;
    let network = Arc::new(Network::new(weights));
    let digest = weights_digest(&ModelSpec::from(pushplan::internals::scene::ModelKind::NETWORK))?;
    interrupt::watch();
    let folder = FolderLock::take(&args.folder, &Following::bar(session, "folder"))?;
    let draw = |name: &str, of: (u64, u64)| {
        let following = Following::bar(session, name);
        let digest = digest.clone().unwrap_or_default();
        let directory = args.folder.join(name);
        let drawn = session.compute(|| lessons(of, (&network, digest), &directory, &following));
        following.finish()?;
        drawn.map_err(data_error)
    };
    let held_out = draw("held-out", (args.held_out_seed, args.held_out))?;
    let all = draw("lessons", (args.data_seed, args.lessons))?;
    let following = Following::bar(session, "steps");
    let best = session.compute(|| train_regulator(&settings, &all, &held_out, &folder, &following));
    following.finish()?;
    let best = best.map_err(train_error)?;
    if interrupt::requested() {
        let message = "stopped; the run is saved, the same command goes on with it";
        return Err(CliError::Interrupted(message.to_owned()));
    }
    if let Some(best) = best {
        session.print(&format!("wrote {}\n", best.display()))?;
    }
    Ok(exit_code::DONE)
}
