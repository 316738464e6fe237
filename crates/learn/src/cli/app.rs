//! Entry point of `pushplan-learn`, from the command line to an exit code.

use std::ffi::OsString;

use clap::{Parser, Subcommand};
use pushplan_command::bench::status;
use pushplan_command::bench::status::StatusArgs;
use pushplan_command::error::CliError;
use pushplan_command::groups::Groups;
use pushplan_command::session::{GlobalArgs, Session};
use pushplan_command::{exit_code, start};

use super::{compare, generate, merge, train};

/// Generates training data by simulation, and trains the networks of pushplan on it.
#[derive(Debug, Parser)]
#[command(name = "pushplan-learn", version, max_term_width = 100, after_help = exit_code::HELP)]
struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Compare(compare::CompareArgs),
    Generate(generate::GenerateArgs),
    Merge(merge::MergeArgs),
    Status(StatusArgs),
    Train(train::TrainArgs),
}

/// Groups of commands, in the order of `--help`.
const GROUPS: Groups =
    &[("Data", &["generate", "merge", "status"]), ("Weights", &["train", "compare"])];

/// Runs the command with the given arguments, starting with the program name, and returns its exit
/// code.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    start(args, GROUPS, |cli: &Cli| &cli.global, execute)
}

fn execute(cli: &Cli, session: &Session) -> Result<u8, CliError> {
    match &cli.command {
        Command::Compare(args) => compare::run(args, session),
        Command::Generate(args) => generate::run(args, session),
        Command::Merge(args) => merge::run(args, session),
        Command::Status(args) => status::run(args, session).map(|()| exit_code::DONE),
        Command::Train(args) => train::run(args, session),
    }
}
