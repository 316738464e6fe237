//! `pushplan-learn merge`: merges shards of training data.

use std::path::PathBuf;

use clap::Args;
use pushplan_command::error::CliError;
use pushplan_command::exit_code;
use pushplan_command::session::Session;

use crate::dataset::merge_data;

use super::generate::data_error;

/// Merge the shards of training data into the files of a single run
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan-learn generate part-1 --seed 1 --shard 1/2      # here
  pushplan-learn generate part-2 --seed 1 --shard 2/2      # there
  pushplan-learn merge whole part-1 part-2")]
pub struct MergeArgs {
    /// Folder for the merged data; it must not contain data
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// Folders of all shards, in any order
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
}

pub fn run(args: &MergeArgs, session: &Session) -> Result<u8, CliError> {
    let (episodes, seed) = merge_data(&args.out, &args.shards).map_err(data_error)?;
    session.print(&format!("{episodes} episodes of seed {seed} in {}\n", args.out.display()))?;
    Ok(exit_code::DONE)
}
