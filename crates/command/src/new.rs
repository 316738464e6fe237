//! `pushplan new`: a task file to start from.

use std::path::PathBuf;

use clap::Args;

use pushplan::asset::{example_text, write_atomic};

use super::{error::CliError, exit_code, session::Session, task_argument};

/// Minimal task that runs, with answers to beginners' questions.
const TASK: &str = include_str!("new.yaml");

/// Write a starter task file
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan new my-task
  pushplan new my-gap --example narrow-gap

Writes <name>.yaml; never overwrites an existing file.")]
pub struct NewArgs {
    /// Name of the task, or path of its file
    name: PathBuf,
    #[arg(long, value_name = "NAME", help = "Shipped task to start from",
          value_parser = task_argument::example())]
    example: Option<String>,
}

pub fn run(args: &NewArgs, session: &Session) -> Result<u8, CliError> {
    let mut path = args.name.clone();
    if !path.extension().is_some_and(|end| end == "yaml" || end == "yml") {
        // A name may contain dots.
        path.as_mut_os_string().push(".yaml");
    }
    let shown = path.display();
    if path.exists() {
        return Err(CliError::usage(format!("{shown} already exists"), "choose another name"));
    }
    let text = match &args.example {
        Some(name) => example_text(name)?,
        None => TASK,
    };
    write_atomic(&path, text.as_bytes()).map_err(CliError::Output)?;
    session.print(&format!("wrote {shown}\nnext: pushplan solve {shown}\n"))?;
    Ok(exit_code::DONE)
}
