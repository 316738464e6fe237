//! `pushplan completions`: completion scripts for shells.

use clap::Args;
use clap_complete::Shell;

use super::{app, error::CliError, exit_code, session::Session};

/// Print a completion script for a shell
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan completions bash > ~/.local/share/bash-completion/completions/pushplan")]
pub struct CompletionsArgs {
    /// Name of the shell
    shell: Shell,
}

pub fn run(args: &CompletionsArgs, session: &Session) -> Result<u8, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut app::command(), "pushplan", &mut script);
    session.print(&String::from_utf8_lossy(&script))?;
    Ok(exit_code::DONE)
}
