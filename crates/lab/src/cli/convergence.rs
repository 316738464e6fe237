//! `pushplan-lab convergence`: accuracy of simulated lever-ups.

use clap::Args;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::cli::value_enums::LEVER_PRESETS;
use pushplan_learn::dataset::LeverPreset;

use crate::bench::convergence;
use crate::report::convergence_document;

/// Compare simulated lever-ups in coarser and finer steps, and with the start a little off
#[derive(Args, Debug)]
pub struct ConvergenceArgs {
    /// Families of lever-ups [default: levers, levers-varied and hdd]
    #[arg(value_parser = possible_values(&LEVER_PRESETS), value_name = "FAMILY")]
    families: Vec<LeverPreset>,
    /// Number of lever-ups of each family, every one of another shape
    #[arg(long, value_name = "N", default_value_t = 256,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    cases: u32,
    /// Seed of the lever-ups
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &ConvergenceArgs, session: &Session) -> Result<(), CliError> {
    let usual = [LeverPreset::Fixed, LeverPreset::Varied, LeverPreset::Drive];
    let families = if args.families.is_empty() { &usual[..] } else { &args.families };
    let spinner = session.spinner("simulating");
    let reports: Vec<_> = session.compute(|| {
        families.iter().map(|preset| convergence(*preset, args.seed, args.cases as usize)).collect()
    });
    spinner.finish_and_clear();
    args.form.show(session, &convergence_document(&reports))
}
