//! `pushplan-lab lever-points`: lever points inferred from the first motion of plates.

use clap::Args;
use pushplan::internals::effect::LeverPrior;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::interrupt;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::cli::generate::data_error;
use pushplan_learn::cli::value_enums::LEVER_PRESETS;
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverPreset};

use crate::bench::point_report;
use crate::report::lever_points_document;

/// Lever points inferred from the first frames, and what they say of the rest
#[derive(Args, Debug)]
pub struct LeverPointsArgs {
    /// Families of lever-ups [default: disc and pcb]
    #[arg(value_parser = possible_values(&LEVER_PRESETS), value_name = "FAMILY")]
    families: Vec<LeverPreset>,
    /// Number of lever-ups of each family
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    cases: u64,
    /// Seed of the lever-ups
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &LeverPointsArgs, session: &Session) -> Result<(), CliError> {
    let usual = [LeverPreset::Disc, LeverPreset::Board];
    let families = if args.families.is_empty() { &usual[..] } else { &args.families };
    interrupt::watch();
    let mut reports = Vec::new();
    for preset in families {
        let config = LeverConfig { seed: args.seed, episodes: args.cases, preset: *preset };
        let following = TerminalProgress::bar(session, "simulating");
        let drawn = session.compute(|| LeverDataset::in_memory(&config, &following));
        following.finish()?;
        let drawn = drawn.map_err(data_error)?;
        let spinner = session.spinner("inferring");
        reports.push(session.compute(|| {
            point_report((*preset, args.seed), drawn.episodes(), &LeverPrior::default())
        }));
        spinner.finish_and_clear();
    }
    args.form.show(session, &lever_points_document(&reports))
}
