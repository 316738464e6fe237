//! `pushplan verify`: replays a plan and gives a verdict.

use std::path::PathBuf;

use clap::Args;

use crate::asset::PlanFile;
use crate::report::{replay_warnings, verdict_document};
use crate::scene::Situation;
use crate::verify::{Verifier, VerifySettings};

use super::{error::CliError, exit_code, form::Form, session::Session};

/// Replay a plan in both simulations, as written and disturbed
#[derive(Args, Debug)]
#[command(after_help = "Exit code 0: reaches the goal in the 3-D simulation. 5: it does not.

Example:
  pushplan verify plans/pull-back.plan.json --disturbed 64")]
pub struct VerifyArgs {
    /// The plan file; it holds the task and the tool as well
    plan: PathBuf,
    /// Disturbed replays in each simulation
    #[arg(long, value_name = "N", default_value_t = 16,
          value_parser = clap::value_parser!(u32).range(0..=100_000))]
    disturbed: u32,
    /// Seed of the disturbances
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &VerifyArgs, session: &Session) -> Result<u8, CliError> {
    let file = PlanFile::load(&args.plan)?;
    let settings = VerifySettings { disturbed: args.disturbed as usize, seed: args.seed };
    let situation = Situation::stated(&file.task.scene);
    let spinner = session.spinner("replaying");
    let verdict = session
        .compute(|| Verifier::new(settings).verify(&file.task, &situation, &file.tool, &file.plan));
    spinner.finish_and_clear();
    for warning in replay_warnings(&verdict) {
        session.warn(&warning);
    }
    args.form.show(session, &verdict_document(&file, &verdict))?;
    Ok(if verdict.passed { exit_code::DONE } else { exit_code::FAILED_VERIFICATION })
}
