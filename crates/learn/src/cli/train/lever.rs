//! `pushplan-learn train lever`: trains the network that corrects predicted lever-ups.

use std::path::PathBuf;

use clap::Args;
use pushplan_bench::store::Shard;
use pushplan_command::error::CliError;
use pushplan_command::session::Session;

use crate::cli::train::{data, take, weights};
use crate::dataset::{
    DatasetError, LeverConfig, LeverDataset, LeverEpisode, LeverPreset, generate,
};
use crate::train::{Descent, LeverSettings, train_lever};

/// Training data of the shipped weights.
const LEARNED: [LeverConfig; 4] = [
    LeverConfig { seed: 1, episodes: 14_000, preset: LeverPreset::Varied },
    LeverConfig { seed: 21, episodes: 16_000, preset: LeverPreset::Varied },
    LeverConfig { seed: 1, episodes: 8000, preset: LeverPreset::Fixed },
    LeverConfig { seed: 21, episodes: 8000, preset: LeverPreset::Fixed },
];

/// Held-out data for choosing the shipped weights.
const HELD_OUT: [LeverConfig; 2] = [
    LeverConfig { seed: 3, episodes: 1500, preset: LeverPreset::Varied },
    LeverConfig { seed: 3, episodes: 1500, preset: LeverPreset::Fixed },
];

/// Train the network that corrects predicted lever-ups
#[derive(Args, Debug)]
#[command(
    after_help = "`pushplan-lab train` trains alternative networks: without an analytic model, \
with other features, or with images.

Examples:
  pushplan-learn train lever runs/lever
  pushplan-learn generate data/levers --preset levers --episodes 2000 --seed 1
  pushplan-learn generate data/held-levers --preset levers --episodes 500 --seed 3
  pushplan-learn train lever runs/small --data data/levers --held-out data/held-levers --steps 1000"
)]
pub struct LeverArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folders of lever-ups to train on [default: the data of the shipped weights, generated in
    /// DIR]
    #[arg(long, value_name = "DIR", num_args = 1.., requires = "held_out")]
    data: Vec<PathBuf>,
    /// Folders of held-out lever-ups with other seeds
    #[arg(long, value_name = "DIR", num_args = 1.., requires = "data")]
    held_out: Vec<PathBuf>,
    /// Number of training steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Number of steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().descent.evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Width of the hidden state
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().width as u32,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    width: u32,
    /// Seed of the initial weights and the batches
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().seed)]
    seed: u64,
}

pub fn run(args: &LeverArgs, session: &Session) -> Result<u8, CliError> {
    let folder = take(&args.folder, session)?;
    let sets = |configs: &[LeverConfig], given: &[PathBuf]| {
        if given.is_empty() { args.made(configs, session) } else { opened(given, session) }
    };
    let held_out = sets(&HELD_OUT, &args.held_out)?;
    let learned = sets(&LEARNED, &args.data)?;
    distinct(&learned, &held_out)?;
    let default = LeverSettings::default();
    let settings = LeverSettings {
        width: args.width as usize,
        seed: args.seed,
        descent: Descent {
            evaluate_every: args.evaluate_every,
            ..default.descent.in_steps(args.steps)
        },
        data: learned.iter().map(|set| *set.config()).collect(),
        ..default
    };
    let episodes = |sets: &[LeverDataset]| -> Vec<LeverEpisode> {
        sets.iter().flat_map(LeverDataset::episodes).cloned().collect()
    };
    let (learned, held_out) = (episodes(&learned), episodes(&held_out));
    weights(session, |progress| train_lever(&settings, &learned, &held_out, &folder, progress))
}

impl LeverArgs {
    /// Makes lever-ups in the folder of the run, or completes those present.
    fn made(
        &self,
        configs: &[LeverConfig],
        session: &Session,
    ) -> Result<Vec<LeverDataset>, CliError> {
        let made = |config: &LeverConfig| {
            let name = format!("{}-{}", config.preset, config.seed);
            let folder = self.folder.join("data").join(&name);
            data(session, &name, |progress| {
                generate(config, Shard::WHOLE, &folder, progress)?;
                LeverDataset::open(&folder)
            })
        };
        configs.iter().map(made).collect()
    }
}

/// Reads folders of lever-ups.
///
/// # Errors
/// Returns an error if a folder holds other or incomplete data.
pub fn opened(folders: &[PathBuf], session: &Session) -> Result<Vec<LeverDataset>, CliError> {
    let open = |folder: &PathBuf| LeverDataset::open(folder);
    data(session, "data", |_| folders.iter().map(open).collect::<Result<_, DatasetError>>())
}

/// Rejects held-out lever-ups with a seed of the training data, because they share shapes.
///
/// # Errors
/// Returns [`CliError::Usage`] for a common seed.
pub fn distinct(learned: &[LeverDataset], held_out: &[LeverDataset]) -> Result<(), CliError> {
    let seeds =
        |sets: &[LeverDataset]| sets.iter().map(|set| set.config().seed).collect::<Vec<_>>();
    if seeds(learned).iter().any(|seed| seeds(held_out).contains(seed)) {
        let message = "training data and held-out lever-ups have a seed in common";
        return Err(CliError::usage(message, "generate them with another --seed"));
    }
    Ok(())
}
