//! From the command line to an exit code.

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[cfg(feature = "formats")]
use super::import;
#[cfg(not(feature = "train"))]
use super::untrained;
use super::{
    bench, check, completions,
    error::CliError,
    evaluate, exit_code, export, fit, generate, infer, interrupt, predict, schema,
    session::{GlobalArgs, Session, shown},
    simulate, solve, tradeoff, verify,
};
#[cfg(feature = "train")]
use super::{train, train_lever, train_regulator};

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
    Generate(generate::GenerateArgs),
    #[cfg(feature = "train")]
    Train(train::TrainArgs),
    #[cfg(feature = "train")]
    TrainRegulator(train_regulator::TrainRegulatorArgs),
    #[cfg(feature = "train")]
    TrainLever(train_lever::TrainLeverArgs),
    /// Train the network, in a build with the feature `train`
    #[cfg(not(feature = "train"))]
    Train(untrained::UntrainedArgs),
    /// Train the belief regulator, in a build with the feature `train`
    #[cfg(not(feature = "train"))]
    TrainRegulator(untrained::UntrainedArgs),
    /// Train a network of lever-ups, in a build with the feature `train`
    #[cfg(not(feature = "train"))]
    TrainLever(untrained::UntrainedArgs),
    Evaluate(evaluate::EvaluateArgs),
    Fit(fit::FitArgs),
    Infer(infer::InferArgs),
    Bench(bench::BenchArgs),
    Tradeoff(tradeoff::TradeOffArgs),
    Schema(schema::SchemaArgs),
    Completions(completions::CompletionsArgs),
}

/// Runs the command with the given arguments, the program's name first.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(args) {
        Ok(cli) => cli,
        Err(message) => {
            // Help and version come here too, for stdout and with code 0.
            let _ = message.print();
            let wrong = message.use_stderr();
            return if wrong { exit_code::USAGE } else { exit_code::DONE }.into();
        }
    };
    match execute(&cli) {
        Ok(code) => code.into(),
        Err(error) => {
            report(&error);
            error.exit_code().into()
        }
    }
}

fn execute(cli: &Cli) -> Result<u8, CliError> {
    interrupt::install()?;
    let session = Session::start(&cli.global)?;
    match &cli.command {
        Command::Solve(args) => solve::run(args, &session),
        Command::Run(args) => super::run::run(args, &session),
        Command::Verify(args) => verify::run(args, &session),
        Command::Predict(args) => predict::run(args, &session),
        Command::Simulate(args) => simulate::run(args, &session),
        Command::Export(args) => export::run(args, &session),
        #[cfg(feature = "formats")]
        Command::Import(args) => import::run(args, &session),
        Command::Check(args) => check::run(args, &session),
        Command::Generate(args) => generate::run(args, &session),
        #[cfg(feature = "train")]
        Command::Train(args) => train::run(args, &session),
        #[cfg(feature = "train")]
        Command::TrainRegulator(args) => train_regulator::run(args, &session),
        #[cfg(feature = "train")]
        Command::TrainLever(args) => train_lever::run(args, &session),
        #[cfg(not(feature = "train"))]
        Command::Train(_) | Command::TrainRegulator(_) | Command::TrainLever(_) => {
            Err(untrained::run())
        }
        Command::Evaluate(args) => evaluate::run(args, &session),
        Command::Fit(args) => fit::run(args, &session),
        Command::Infer(args) => infer::run(args, &session),
        Command::Bench(args) => bench::run(args, &session),
        Command::Tradeoff(args) => tradeoff::run(args, &session),
        Command::Schema(args) => schema::run(args, &session),
        Command::Completions(args) => completions::run(args, &session),
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
