//! `pushplan verify`: replays a plan and gives a verdict.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::asset::{PlanFile, SCHEMA_VERSION};
use crate::report::{goal_line, outcomes_text, plan_line, push_table, replay_warnings};
use crate::scene::Situation;
use crate::verify::{Verifier, VerifySettings};

use super::{error::CliError, exit_code, session::Session};

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
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

pub fn run(args: &VerifyArgs, session: &Session) -> Result<u8, CliError> {
    let file = PlanFile::load(&args.plan)?;
    let settings = VerifySettings { disturbed: args.disturbed as usize, seed: args.seed };
    let verifier = Verifier::new(settings);
    let spinner = session.spinner("replaying");
    let situation = Situation::stated(&file.task.scene);
    let verdict =
        session.compute(|| verifier.verify(&file.task, &situation, &file.tool, &file.plan));
    spinner.finish_and_clear();
    for warning in replay_warnings(&verdict) {
        session.warn(&warning);
    }
    if args.json {
        let report = json!({
            "schema_version": SCHEMA_VERSION, "task": file.task.name, "plan": file.plan,
            "verdict": verdict,
        });
        session.print(&format!("{report:#}\n"))?;
    } else {
        let predicted = file.model.as_ref().zip(file.predicted.as_ref());
        let (name, plan) = (&file.task.name, plan_line(&file.plan));
        let (goal, pushes) = (goal_line(&file.task), push_table(&file.plan).to_text());
        let outcomes = outcomes_text(&file.task, predicted, Some(&verdict));
        session.print(&format!("{name}: {plan}\ngoal: {goal}\n\n{pushes}\n{outcomes}"))?;
    }
    Ok(if verdict.passed { exit_code::DONE } else { exit_code::FAILED_VERIFICATION })
}
