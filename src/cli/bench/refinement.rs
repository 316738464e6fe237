//! `pushplan bench refinement`: what refinement brings.

use clap::Args;

use crate::bench::refinement_report;
use crate::cli::{error::CliError, session::Session};
use crate::report::refinement_table;
use crate::solve::Effort;

use super::common::Common;

/// Final errors of plans before and after refinement, over random solvable tasks
#[derive(Args, Debug)]
pub struct RefinementArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: u32,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

pub fn run(args: &RefinementArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let model = args.common.load_model()?;
    let settings = Effort::Standard.settings();
    let spinner = session.spinner("refining");
    let report = session
        .compute(|| refinement_report(&model, &library, &settings, args.seed, args.tasks as usize));
    spinner.finish_and_clear();
    let head = format!(
        "{} random tasks of seed {}, {} at standard effort; {} with a push to refine\n\n",
        report.tasks, report.seed, report.model, report.planned
    );
    args.common.form.print(session, "refinement", &report, &head, &[refinement_table(&report)])
}
