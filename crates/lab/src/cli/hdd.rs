//! `pushplan-lab hdd`: errors of models of boards that are levered out of drives.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::effect::{LeverPrior, PriorSettings};
use pushplan::internals::scene::LeverFeatures;
use pushplan::internals::sim::LeverSimulator;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::interrupt;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_learn::cli::generate::data_error;
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverPreset};
use pushplan_learn::lever_model::{LeverModel, SimulatedLevers};

use crate::bench::{LeverBaseline, Neighbour, drive_report};
use crate::cli::levers::Named;
use crate::report::hdd_document;

/// Measure models of boards levered out of drives against the 3-D engine, on unseen drives
#[derive(Args, Debug)]
#[command(after_help = "To train a network on drives:
  pushplan-learn generate data/hdd --preset hdd --episodes 500 --seed 1
  pushplan-learn generate data/hdd-held-out --preset hdd --episodes 1000 --seed 3
  pushplan-lab train memory runs/hdd --data data/hdd --held-out data/hdd-held-out
  pushplan-lab hdd --network runs/hdd/best.safetensors")]
pub struct HddArgs {
    /// Number of lever-ups, four per drive
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    cases: u64,
    /// Seed of the drives
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Number of remembered lever-ups of the models without physics
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    known: u64,
    /// Seed of the remembered lever-ups; it must differ from --seed
    #[arg(long, value_name = "N", default_value_t = 1)]
    known_seed: u64,
    /// Weights of networks trained on drives
    #[arg(long, value_name = "FILE", num_args = 1..)]
    network: Vec<PathBuf>,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &HddArgs, session: &Session) -> Result<(), CliError> {
    if args.seed == args.known_seed {
        let message = "remembered lever-ups and tested lever-ups have the same seed";
        return Err(CliError::usage(message, "choose another --known-seed"));
    }
    let load = |path: &PathBuf| Named::load(path, true);
    let networks = args.network.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    interrupt::watch();
    let draw = |seed, episodes| {
        let config = LeverConfig { seed, episodes, preset: LeverPreset::Drive };
        let following = TerminalProgress::bar(session, "simulating");
        let drawn = session.compute(|| LeverDataset::in_memory(&config, &following));
        following.finish()?;
        drawn.map_err(data_error)
    };
    let known = draw(args.known_seed, args.known)?;
    let asked = draw(args.seed, args.cases)?;
    let spinner = session.spinner("predicting");
    let report = session.compute(|| {
        let models = models(&known);
        let mut models: Vec<&dyn LeverModel> = models.iter().map(|model| &**model).collect();
        models.extend(networks.iter().map(|network| network as &dyn LeverModel));
        drive_report(args.seed, asked.episodes(), &models)
    });
    spinner.finish_and_clear();
    args.form.show(session, &hdd_document(&report))
}

/// Returns the models, simplest first.
fn models(known: &LeverDataset) -> Vec<Box<dyn LeverModel>> {
    let known = known.episodes();
    vec![
        Box::new(LeverBaseline::still()),
        Box::new(LeverBaseline::mean(known)),
        Box::new(LeverBaseline::like(Neighbour::Random, known, 1)),
        Box::new(LeverBaseline::like(Neighbour::Nearest(LeverFeatures::Support), known, 1)),
        Box::new(LeverPrior { settings: PriorSettings::FROM_REST }),
        Box::new(LeverPrior::default()),
        Box::new(LeverPrior { settings: PriorSettings::FINE }),
        Box::new(SimulatedLevers { simulator: LeverSimulator::COARSE }),
    ]
}
