//! `pushplan bench refinement`: what refinement brings.

use std::sync::Arc;

use clap::Args;

use crate::bench::refinement_report;
use crate::cli::{
    error::CliError,
    model,
    session::Session,
    solve::solve_error,
    words::{EFFORTS, words},
};
use crate::report::refinement_document;
use crate::solve::{Effort, Planner, Settings};

use super::common::Common;

/// Random solvable tasks with and without refinement of what the search finds
#[derive(Args, Debug)]
pub struct RefinementArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: u32,
    /// How hard to try otherwise
    #[arg(long, value_parser = words(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

pub fn run(args: &RefinementArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let effort = args.effort;
    let model = Arc::new(model::load(&args.common.spec(effort))?);
    let settings = Settings { disturbed: 0, ..effort.settings() };
    let planner = |settings| {
        let planner = Planner::builder(Arc::clone(&model)).settings(settings);
        planner.outside(args.common.outside.outside()).build()
    };
    let without = planner(Settings { refine_rounds: 0, ..settings });
    let with = planner(settings);
    let spinner = session.spinner("refining");
    let report = session
        .compute(|| refinement_report([&without, &with], &library, args.seed, args.tasks as usize));
    spinner.finish_and_clear();
    let report = report.map_err(solve_error)?;
    args.common.form.show(session, &refinement_document(&report, &effort.to_string()))
}
