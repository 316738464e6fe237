//! Choice of the network to train, and common arguments.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;

use super::{memory, parts};

/// Train alternative networks of lever-ups; a rerun resumes an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "The data come from `pushplan-learn generate`. The folder of the run contains \
metrics.jsonl, checkpoint.safetensors, from which a run resumes, and best.safetensors, the weights \
with the lowest held-out error. `pushplan-lab levers` and `pushplan-lab hdd` read these weights.

Ctrl-C saves the run and stops. A rerun of the same command resumes it, and the result is \
bit-identical to an uninterrupted run. `pushplan-learn train lever` trains the shipped network."
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

/// Arguments of both networks.
#[derive(Args, Debug)]
pub(super) struct RunArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Folders of lever-ups to train on
    #[arg(long, value_name = "DIR", required = true, num_args = 1..)]
    pub data: Vec<PathBuf>,
    /// Predict the whole motion instead of a correction of the analytic model
    #[arg(long)]
    pub no_prior: bool,
    /// Train on only this percentage of every folder, its first lever-ups
    #[arg(long, value_name = "PERCENT", default_value_t = 100,
          value_parser = clap::value_parser!(u8).range(1..=100))]
    share: u8,
    /// Number of steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u64).range(1..))]
    pub evaluate_every: u64,
    /// Seed of the initial weights and the batches
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
