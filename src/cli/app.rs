//! From the command line to an exit code.

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[cfg(feature = "formats")]
use super::import;
use super::{
    bench, check, completions,
    error::CliError,
    exit_code, export, fit, infer, interrupt, predict, schema,
    session::{GlobalArgs, Session, shown},
    simulate, solve, verify,
};

/// Chooses a tool and pushes that bring objects on a table to goals, and shows that the plan
/// works.
#[derive(Debug, Parser)]
#[command(name = "pushplan", version, max_term_width = 100, after_help = exit_code::HELP)]
pub struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Solve(solve::SolveArgs),
    Run(super::run::RunArgs),
    Verify(verify::VerifyArgs),
    Predict(predict::PredictArgs),
    Simulate(simulate::SimulateArgs),
    Export(export::ExportArgs),
    #[cfg(feature = "formats")]
    Import(import::ImportArgs),
    Check(check::CheckArgs),
    Fit(fit::FitArgs),
    Infer(infer::InferArgs),
    Bench(bench::BenchArgs),
    Schema(schema::SchemaArgs),
    Completions(completions::CompletionsArgs),
}

/// Runs the command with the given arguments, the program's name first.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    start(args, |cli: &Cli| &cli.global, execute)
}

/// Runs a command of this family: parses its arguments, starts a session, has `execute` do what
/// they ask for, and reports what goes wrong.
pub fn start<C: Parser>(
    args: impl IntoIterator<Item = OsString>,
    global: impl FnOnce(&C) -> &GlobalArgs,
    execute: impl FnOnce(&C, &Session) -> Result<u8, CliError>,
) -> ExitCode {
    let cli = match C::try_parse_from(args) {
        Ok(cli) => cli,
        Err(message) => {
            // Help and version come here too, for stdout and with code 0.
            let _ = message.print();
            let wrong = message.use_stderr();
            return if wrong { exit_code::USAGE } else { exit_code::DONE }.into();
        }
    };
    let done = interrupt::install()
        .and_then(|()| Session::start(global(&cli)))
        .and_then(|session| execute(&cli, &session));
    match done {
        Ok(code) => code.into(),
        Err(error) => {
            report(&error);
            error.exit_code().into()
        }
    }
}

fn execute(cli: &Cli, session: &Session) -> Result<u8, CliError> {
    match &cli.command {
        Command::Solve(args) => solve::run(args, session),
        Command::Run(args) => super::run::run(args, session),
        Command::Verify(args) => verify::run(args, session),
        Command::Predict(args) => predict::run(args, session),
        Command::Simulate(args) => simulate::run(args, session),
        Command::Export(args) => export::run(args, session),
        #[cfg(feature = "formats")]
        Command::Import(args) => import::run(args, session),
        Command::Check(args) => check::run(args, session),
        Command::Fit(args) => fit::run(args, session),
        Command::Infer(args) => infer::run(args, session),
        Command::Bench(args) => bench::run(args, session),
        Command::Schema(args) => schema::run(args, session),
        Command::Completions(args) => completions::run(args, session),
    }
}

fn report(error: &CliError) {
    let text = match error {
        CliError::Closed => return,
        // Every fault says so itself, behind its place.
        CliError::Files(faults) | CliError::Output(faults) => faults.to_string(),
        CliError::Interrupted(message) => message.clone(),
        _ => format!("error: {error}"),
    };
    let text = shown(&text);
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let text = if colour { text.replace("error:", "\u{1b}[1;31merror:\u{1b}[0m") } else { text };
    let _ = writeln!(std::io::stderr(), "{text}");
}
