//! The command line of `pushplan-lab`, up to its exit code.

use std::ffi::OsString;

use clap::{Parser, Subcommand};
use pushplan_command::bench::saved::{MergeArgs, ReportArgs};
use pushplan_command::bench::status::StatusArgs;
use pushplan_command::bench::suite::SuiteArgs;
use pushplan_command::bench::{saved, status};
use pushplan_command::error::CliError;
use pushplan_command::groups::Groups;
use pushplan_command::session::{GlobalArgs, Session};
use pushplan_command::{exit_code, start};

use super::{
    adapted, convergence, cost, evaluate, hdd, joints, kept, lever_points, lever_tasks, levers,
    masses, measure, probes, random, refinement, rest_of_way, tradeoff, train,
};

/// Measures the published results of pushplan: errors, costs, success, beliefs and trade-offs.
#[derive(Debug, Parser)]
#[command(name = "pushplan-lab", version, max_term_width = 100, after_help = exit_code::HELP)]
struct Cli {
    #[command(flatten)]
    global: GlobalArgs,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Evaluate(evaluate::EvaluateArgs),
    Adapted(adapted::AdaptedArgs),
    Tradeoff(tradeoff::TradeOffArgs),
    Random(SuiteArgs<random::RandomArgs>),
    Run(SuiteArgs<super::run::RunArgs>),
    Refinement(SuiteArgs<refinement::RefinementArgs>),
    Cost(cost::CostArgs),
    Joints(SuiteArgs<joints::JointsArgs>),
    RestOfWay(rest_of_way::RestOfWayArgs),
    Masses(SuiteArgs<masses::MassesArgs>),
    Probes(SuiteArgs<probes::ProbesArgs>),
    Convergence(convergence::ConvergenceArgs),
    Levers(levers::LeversArgs),
    Hdd(hdd::HddArgs),
    LeverTasks(SuiteArgs<lever_tasks::LeverTasksArgs>),
    LeverPoints(lever_points::LeverPointsArgs),
    Train(train::TrainArgs),
    Measure(measure::MeasureArgs),
    Merge(MergeArgs),
    Status(StatusArgs),
    Report(ReportArgs),
}

/// Groups of the commands, in the order of `--help`.
const GROUPS: Groups = &[
    ("Prediction", &["evaluate", "adapted", "cost"]),
    ("Planning", &["random", "run", "refinement", "tradeoff"]),
    ("Belief", &["joints", "rest-of-way", "masses", "probes"]),
    ("Levering", &["levers", "lever-tasks", "lever-points", "hdd", "convergence", "train"]),
    ("Saved runs", &["merge", "status", "report"]),
    ("Published tables", &["measure"]),
];

/// Runs the command with the given arguments, the program's name first, and returns its exit code.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    start(args, GROUPS, |cli: &Cli| &cli.global, execute)
}

fn execute(cli: &Cli, session: &Session) -> Result<u8, CliError> {
    match &cli.command {
        Command::Evaluate(args) => evaluate::run(args, session).map(drop)?,
        Command::Adapted(args) => adapted::run(args, session).map(drop)?,
        Command::Tradeoff(args) => tradeoff::run(args, session).map(drop)?,
        Command::Random(args) => args.run(session)?,
        Command::Run(args) => args.run(session)?,
        Command::Refinement(args) => args.run(session)?,
        Command::Cost(args) => cost::run(args, session)?,
        Command::Joints(args) => args.run(session)?,
        Command::RestOfWay(args) => rest_of_way::run(args, session)?,
        Command::Masses(args) => args.run(session)?,
        Command::Probes(args) => args.run(session)?,
        Command::Convergence(args) => convergence::run(args, session)?,
        Command::Levers(args) => levers::run(args, session)?,
        Command::Hdd(args) => hdd::run(args, session)?,
        Command::LeverTasks(args) => args.run(session)?,
        Command::LeverPoints(args) => lever_points::run(args, session)?,
        Command::Train(args) => return train::run(args, session),
        Command::Measure(args) => measure::run(args, session)?,
        Command::Merge(args) => saved::merge(args, &kept::SUITES, session)?,
        Command::Status(args) => status::run(args, session)?,
        Command::Report(args) => saved::report(args, &kept::SUITES, session)?,
    }
    Ok(exit_code::DONE)
}
