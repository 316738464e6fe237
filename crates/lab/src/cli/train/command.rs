//! Choice of the network to train, and common arguments.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;

use super::{memory, parts};

/// Train networks of lever-ups that were tried; the same command goes on with an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "Lever-ups are those of `pushplan-learn generate`. In the folder lie checkpoint.safetensors to go on from,
metrics.jsonl, and best.safetensors, the weights with the lowest held-out error, for `pushplan-lab levers`
and `pushplan-lab hdd`. Ctrl-C saves and stops; the same command then goes on, to the same bits as a run
that never stopped. The shipped network is trained by `pushplan-learn train lever`."
)]
pub struct TrainArgs {
    #[command(subcommand)]
    network: Network,
}

#[derive(Debug, Subcommand)]
enum Network {
    Memory(memory::MemoryArgs),
    Parts(parts::PartsArgs),
}

/// What both are told.
#[derive(Args, Debug)]
pub(super) struct RunArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Folders of lever-ups to learn from
    #[arg(long, value_name = "DIR", required = true, num_args = 1..)]
    pub data: Vec<PathBuf>,
    /// Predict everything, and correct no prior
    #[arg(long)]
    pub no_prior: bool,
    /// Learn from this share of every folder only, its first lever-ups
    #[arg(long, value_name = "PERCENT", default_value_t = 100,
          value_parser = clap::value_parser!(u8).range(1..=100))]
    share: u8,
    /// Steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u64).range(1..))]
    pub evaluate_every: u64,
    /// Seed of first weights and batches
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

impl RunArgs {
    /// Returns the number of lever-ups, out of `count`, that are learned from.
    pub fn share(&self, count: usize) -> usize {
        (count * usize::from(self.share)).div_ceil(100)
    }
}

pub fn run(args: &TrainArgs, session: &Session) -> Result<u8, CliError> {
    match &args.network {
        Network::Memory(args) => memory::run(args, session),
        Network::Parts(args) => parts::run(args, session),
    }
}
