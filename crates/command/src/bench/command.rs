//! The benchmarks by name.

use clap::{Args, Subcommand};

use crate::{error::CliError, exit_code, session::Session};

use super::suite::SuiteArgs;
use super::{saved, status, tasks, tools};

/// Benchmark tool selection and task suites
#[derive(Args, Debug)]
pub struct BenchArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Tools(SuiteArgs<tools::ToolsArgs>),
    Tasks(SuiteArgs<tasks::TasksArgs>),
    Merge(saved::MergeArgs),
    Status(status::StatusArgs),
    Report(saved::ReportArgs),
}

pub fn run(args: &BenchArgs, session: &Session) -> Result<u8, CliError> {
    match &args.what {
        What::Tools(args) => tools::run(args, session)?,
        What::Tasks(args) => args.run(session)?,
        What::Merge(args) => saved::merge(args, &saved::SUITES, session)?,
        What::Status(args) => status::run(args, session)?,
        What::Report(args) => saved::report(args, &saved::SUITES, session)?,
    }
    Ok(exit_code::DONE)
}
