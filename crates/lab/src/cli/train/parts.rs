//! `pushplan-lab train parts`: the propagation network on the cuboids of a board and its drive.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::network::Config;
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_learn::cli::train::{distinct, opened, take, weights};
use pushplan_learn::dataset::{LeverDataset, LeverEpisode};
use pushplan_learn::train::Descent;

use super::RunArgs;
use crate::parts::{PartsSettings, train_parts};

/// Propagation between cuboids that are near, step by step
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan-learn generate data/hdd --preset hdd --episodes 500 --seed 1
  pushplan-learn generate data/held-hdd --preset hdd --episodes 1000 --seed 3
  pushplan-lab train parts runs/parts --data data/hdd --held-out data/held-hdd --no-prior
  pushplan-lab hdd --network runs/parts/best.safetensors")]
pub struct PartsArgs {
    #[command(flatten)]
    run: RunArgs,
    /// Folders of held-out lever-ups, of other seeds
    #[arg(long, value_name = "DIR", required = true, num_args = 1..)]
    held_out: Vec<PathBuf>,
    /// Steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = PartsSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Hidden width, an even number
    #[arg(long, value_name = "N", default_value_t = PartsSettings::default().config.width as u32,
          value_parser = clap::value_parser!(u32).range(2..=1024))]
    width: u32,
}

pub fn run(args: &PartsArgs, session: &Session) -> Result<u8, CliError> {
    if args.width % 2 == 1 {
        let message = format!("--width must be even, not {}", args.width);
        return Err(CliError::usage(message, format!("try {}", args.width + 1)));
    }
    let (data, held_out) = (opened(&args.run.data, session)?, opened(&args.held_out, session)?);
    distinct(&data, &held_out)?;
    let share = |set: &LeverDataset| args.run.share(set.episodes().len());
    let config = |set: &LeverDataset| set.config().split(set.config().seed, share(set) as u64);
    let default = PartsSettings::default();
    let settings = PartsSettings {
        config: Config { width: args.width as usize, ..default.config },
        prior: !args.run.no_prior,
        seed: args.run.seed,
        descent: Descent {
            evaluate_every: args.run.evaluate_every,
            ..default.descent.in_steps(args.steps)
        },
        data: data.iter().map(config).collect(),
    };
    let known: Vec<LeverEpisode> =
        data.iter().flat_map(|set| &set.episodes()[..share(set)]).cloned().collect();
    let asked: Vec<LeverEpisode> =
        held_out.iter().flat_map(LeverDataset::episodes).cloned().collect();
    let folder = take(&args.run.folder, session)?;
    weights(session, |progress| train_parts(&settings, &known, &asked, &folder, progress))
}
