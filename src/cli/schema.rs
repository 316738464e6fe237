//! `pushplan schema`: JSON schemas of the files people write, for editors.

use clap::{Args, ValueEnum};

use crate::asset::{recording_schema, task_schema, tool_schema, world_schema};

use super::{error::CliError, exit_code, session::Session};

/// Print the JSON schema of tool, task, recording or world files, for editors
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan schema task > task.schema.json
  # then, as the first line of a task file:
  # yaml-language-server: $schema=task.schema.json")]
pub struct SchemaArgs {
    /// Kind of file
    kind: Kind,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    Tool,
    Task,
    Recording,
    World,
}

pub fn run(args: &SchemaArgs, session: &Session) -> Result<u8, CliError> {
    let schema = match args.kind {
        Kind::Tool => tool_schema(),
        Kind::Task => task_schema(),
        Kind::Recording => recording_schema(),
        Kind::World => world_schema(),
    };
    session.print(&format!("{schema:#}\n"))?;
    Ok(exit_code::DONE)
}
