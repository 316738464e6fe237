//! The benchmarks by name.

use clap::{Args, Subcommand};

use crate::cli::{error::CliError, exit_code, session::Session};

use super::{
    convergence, cost, hdd, joints, lever_points, lever_tasks, levers, masses, probes, random,
    refinement, saved, status, tasks, tools,
};

/// Measure what solving brings and what pushes and searches cost
#[derive(Args, Debug)]
pub struct BenchArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Tasks(tasks::TasksArgs),
    Random(random::RandomArgs),
    Run(super::run::RunArgs),
    Refinement(refinement::RefinementArgs),
    Cost(cost::CostArgs),
    Convergence(convergence::ConvergenceArgs),
    Levers(levers::LeversArgs),
    Hdd(hdd::HddArgs),
    Tools(tools::ToolsArgs),
    Joints(joints::JointsArgs),
    Masses(masses::MassesArgs),
    Probes(probes::ProbesArgs),
    LeverTasks(lever_tasks::LeverTasksArgs),
    LeverPoints(lever_points::LeverPointsArgs),
    Merge(saved::MergeArgs),
    Status(status::StatusArgs),
    Report(saved::ReportArgs),
}

pub fn run(args: &BenchArgs, session: &Session) -> Result<u8, CliError> {
    match &args.what {
        What::Tasks(args) => tasks::run(args, session)?,
        What::Random(args) => random::run(args, session)?,
        What::Run(args) => super::run::run(args, session)?,
        What::Refinement(args) => refinement::run(args, session)?,
        What::Cost(args) => cost::run(args, session)?,
        What::Convergence(args) => convergence::run(args, session)?,
        What::Levers(args) => levers::run(args, session)?,
        What::Hdd(args) => hdd::run(args, session)?,
        What::Tools(args) => tools::run(args, session)?,
        What::Joints(args) => joints::run(args, session)?,
        What::Masses(args) => masses::run(args, session)?,
        What::Probes(args) => probes::run(args, session)?,
        What::LeverTasks(args) => lever_tasks::run(args, session)?,
        What::LeverPoints(args) => lever_points::run(args, session)?,
        What::Merge(args) => saved::merge(args, session)?,
        What::Status(args) => status::run(args, session)?,
        What::Report(args) => saved::report(args, session)?,
    }
    Ok(exit_code::DONE)
}
