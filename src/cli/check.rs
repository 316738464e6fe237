//! `pushplan check`: reads files and says everything that is wrong with them.

use std::path::PathBuf;

use clap::Args;

use crate::asset::{self, Faults};

use super::{action::LibraryArgs, error::CliError, exit_code, session::Session};

/// Check tool, task, plan, trajectory and recording files: every fault with its place
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  pushplan check tools/*.yaml tasks/*.yaml")]
pub struct CheckArgs {
    /// Files to check; their kind is seen from their content
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

pub fn run(args: &CheckArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    let mut faults = Vec::new();
    for file in &args.files {
        match asset::check(file, Some(&library)) {
            Ok(kind) => session.print(&format!("{}: {kind}, fine\n", file.display()))?,
            Err(found) => faults.extend(found.0),
        }
    }
    if faults.is_empty() { Ok(exit_code::DONE) } else { Err(Faults(faults).into()) }
}
