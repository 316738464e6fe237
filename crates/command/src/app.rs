//! Execution of a command line, with its exit code.

use std::ffi::OsString;
use std::io::{IsTerminal, Write};

use clap::{CommandFactory, Parser, Subcommand};

use super::import;
use super::{
    bench, check, completions, design,
    error::CliError,
    exit_code, export, fit,
    groups::{Groups, grouped},
    infer, interrupt, mcp, new, predict,
    session::{GlobalArgs, Session, shown},
    solve, verify,
};

/// Chooses a tool and pushes that bring objects on a table to goals, and shows that the plan
/// works.
#[derive(Debug, Parser)]
#[command(name = "pushplan", version, max_term_width = 100, after_help = after_help())]
pub struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    New(new::NewArgs),
    Solve(solve::SolveArgs),
    Run(super::run::RunArgs),
    Verify(verify::VerifyArgs),
    Predict(predict::PredictArgs),
    Design(design::DesignArgs),
    Check(check::CheckArgs),
    Import(import::ImportArgs),
    Export(export::ExportArgs),
    Fit(fit::FitArgs),
    Infer(infer::InferArgs),
    Bench(bench::BenchArgs),
    #[command(hide = true)]
    Completions(completions::CompletionsArgs),
    #[command(hide = true)]
    Mcp(mcp::McpArgs),
}

/// Returns the end of `--help`, which also names the hidden commands.
fn after_help() -> String {
    let shells = "`pushplan completions SHELL` prints a completion script for a shell.";
    let agents = "`pushplan mcp` serves agents; it needs the Python package.";
    format!("{shells}\n{agents}\n\n{}", exit_code::HELP)
}

/// Groups of commands, in the order of `--help`.
const GROUPS: Groups = &[
    ("Plan and execute", &["new", "solve", "run", "verify", "predict", "design"]),
    ("Files", &["check", "import", "export"]),
    ("Learn from recordings", &["fit", "infer"]),
    ("Measure", &["bench"]),
];

/// Runs the command with the given arguments, the program's name first, and returns its exit code.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    start(args, GROUPS, |cli: &Cli| &cli.global, execute)
}

/// Returns the command with its help.
pub fn command() -> clap::Command {
    grouped(Cli::command(), GROUPS)
}

/// Runs a command of this family and returns its exit code. The function parses the arguments,
/// starts a session, calls `execute`, and reports errors.
pub fn start<C: Parser>(
    args: impl IntoIterator<Item = OsString>,
    groups: Groups,
    global: impl FnOnce(&C) -> &GlobalArgs,
    execute: impl FnOnce(&C, &Session) -> Result<u8, CliError>,
) -> u8 {
    let parsed = grouped(C::command(), groups).try_get_matches_from(args);
    let cli = match parsed.and_then(|mut matches| C::from_arg_matches_mut(&mut matches)) {
        Ok(cli) => cli,
        Err(message) => {
            // Help and version arrive here too, for stdout and with code 0.
            let _ = message.print();
            let wrong = message.use_stderr();
            return if wrong { exit_code::USAGE } else { exit_code::DONE };
        }
    };
    pushplan_arm::install();
    let done = interrupt::install()
        .and_then(|()| Session::start(global(&cli)))
        .and_then(|session| execute(&cli, &session));
    match done {
        Ok(code) => code,
        Err(error) => {
            report(&error);
            error.exit_code()
        }
    }
}

fn execute(cli: &Cli, session: &Session) -> Result<u8, CliError> {
    match &cli.command {
        Command::New(args) => new::run(args, session),
        Command::Solve(args) => solve::run(args, session),
        Command::Run(args) => super::run::run(args, session),
        Command::Verify(args) => verify::run(args, session),
        Command::Predict(args) => predict::run(args, session),
        Command::Design(args) => design::run(args, session),
        Command::Export(args) => export::run(args, session),
        Command::Import(args) => import::run(args, session),
        Command::Check(args) => check::run(args, session),
        Command::Fit(args) => fit::run(args, session),
        Command::Infer(args) => infer::run(args, session),
        Command::Bench(args) => bench::run(args, session),
        Command::Mcp(args) => mcp::run(args),
        Command::Completions(args) => completions::run(args, session),
    }
}

fn report(error: &CliError) {
    let text = match error {
        CliError::Closed => return,
        // Each fault contains its own `error:`, after its place.
        CliError::Files(faults) | CliError::Output(faults) => faults.to_string(),
        CliError::Interrupted(message) => message.clone(),
        _ => format!("error: {error}"),
    };
    let text = shown(&text);
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let text = if colour { text.replace("error:", "\u{1b}[1;31merror:\u{1b}[0m") } else { text };
    let _ = writeln!(std::io::stderr(), "{text}");
}
