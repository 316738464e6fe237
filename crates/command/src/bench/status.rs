//! `pushplan bench status`: missing shards of a run.

use std::path::PathBuf;

use clap::Args;

use crate::{error::CliError, session::Session};
use pushplan_bench::store::RunStatus;

/// Say which shards of a run are missing or unfinished, as array jobs take them: `3,7-9`
#[derive(Args, Debug)]
#[command(
    after_help = "Prints nothing on stdout if all are finished, and on stderr how far the unfinished ones are.
A folder that does not exist yet is that of a missing shard, as long as another one holds a run.

Examples:
  pushplan bench status runs/tools-shards/*
  sbatch --array=\"$(pushplan bench status runs/tools-shards/*)\" job.sh"
)]
pub struct StatusArgs {
    /// Folders of the shards of one benchmark, or of one set of training data
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
}

pub fn run(args: &StatusArgs, session: &Session) -> Result<(), CliError> {
    let status = RunStatus::of(&args.folders)?;
    for shard in status.shards.iter().filter(|shard| !shard.is_complete()) {
        let writer =
            shard.writer.as_ref().map_or(String::new(), |who| format!(", locked by {who}"));
        session.message(&format!(
            "shard {}: {} of {} tasks in {}{writer}",
            shard.shard,
            shard.done,
            shard.tasks,
            shard.folder.display()
        ));
    }
    match status.array() {
        none if none.is_empty() => Ok(()),
        missing => session.print(&format!("{missing}\n")),
    }
}
