//! `pushplan check`: reads files and says everything that is wrong with them; JSON schemas of files
//! that people write.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::act::{ActError, Trace};
use crate::asset::{
    self, Fault, Faults, Kind, recording_schema, task_schema, tool_schema, world_schema,
};

use super::{action::LibraryArgs, error::CliError, exit_code, session::Session};

/// Check your files: every fault with its place; or print their schema for editors
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan check tools/*.yaml tasks/*.yaml
  pushplan check --schema task > task.schema.json
  # then, as the first line of a task file:
  # yaml-language-server: $schema=task.schema.json")]
pub struct CheckArgs {
    /// Tool, task, plan, trajectory, recording, world and run files; content tells their kind
    #[arg(required_unless_present = "schema", value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print the JSON schema of this kind of file
    #[arg(long, value_name = "KIND", conflicts_with = "files")]
    schema: Option<Schema>,
    #[command(flatten)]
    library: LibraryArgs,
}

/// Files that people write.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Schema {
    Tool,
    Task,
    Recording,
    World,
}

fn damaged(file: &Path, error: &ActError) -> Faults {
    let advice = "the file is damaged, or of another version; make it again";
    Fault::of_file(&file.display().to_string(), error.to_string(), advice).into()
}

pub fn run(args: &CheckArgs, session: &Session) -> Result<u8, CliError> {
    if let Some(kind) = args.schema {
        let schema = match kind {
            Schema::Tool => tool_schema(),
            Schema::Task => task_schema(),
            Schema::Recording => recording_schema(),
            Schema::World => world_schema(),
        };
        session.print(&format!("{schema:#}\n"))?;
        return Ok(exit_code::DONE);
    }
    let library = args.library.load()?;
    let mut faults = Vec::new();
    for file in &args.files {
        let read = |kind| match kind {
            Kind::Run => Trace::load(file).map(|_| kind).map_err(|error| damaged(file, &error)),
            _ => Ok(kind),
        };
        match asset::check(file, Some(&library)).and_then(read) {
            Ok(kind) => session.print(&format!("{}: {kind}, fine\n", file.display()))?,
            Err(found) => faults.extend(found.0),
        }
    }
    if faults.is_empty() { Ok(exit_code::DONE) } else { Err(Faults(faults).into()) }
}
