//! `pushplan-lab masses`: how well masses are told from pushes.

use clap::Args;
use pushplan::cli::bench::keep;
use pushplan::cli::bench::keep::KeepArgs;
use pushplan::cli::error::CliError;
use pushplan::cli::form::Form;
use pushplan::cli::model;
use pushplan::cli::session::Session;
use pushplan::cli::words::words;
use pushplan::internals::report::Document;
use pushplan::internals::scene::ModelSpec;
use pushplan::internals::store::{Finished, RunManifest};
use pushplan_learn::dataset::{Controlled, MassSetup};
use serde_json::json;

use crate::bench::{MassCase, MassRecord, MassSuite, Sighting, summarise_masses};
use crate::cli::words::{CONTROLLED, SIGHTINGS};
use crate::report::masses_document;

/// Name of the suite in manifests.
pub const SUITE: &str = "masses";

/// Tell which of three ranges masses are in, from pushes in which objects touch
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab masses --count 100
  pushplan-lab masses --touching 2 3 --crowds 9 --seen exact --seen fine
  pushplan-lab masses --touching --controlled rows wedges

{}", keep::HELP))]
pub struct MassesArgs {
    /// Numbers of cylinders that touch each other, pushed once
    #[arg(long, value_name = "N", num_args = 0.., default_values_t = [2, 3, 4],
          value_parser = clap::value_parser!(u8).range(1..=8))]
    touching: Vec<u8>,
    /// Numbers of cylinders in a grid, pushed three times
    #[arg(long, value_name = "N", num_args = 0..,
          value_parser = clap::value_parser!(u8).range(2..=12))]
    crowds: Vec<u8>,
    /// Nine cylinders that always stand alike and are always pushed alike, only their masses differ
    #[arg(long, num_args = 1.., value_parser = words(&CONTROLLED), value_name = "SETUP")]
    controlled: Vec<Controlled>,
    /// How things are seen; may be given several times [default: exact, fine and coarse]
    #[arg(long, num_args = 1.., value_parser = words(&SIGHTINGS), value_name = "HOW")]
    seen: Vec<Sighting>,
    /// Friction values of the objects and the table are not known either
    #[arg(long)]
    frictions: bool,
    /// Trajectories of each
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Seed of the scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// What plays pushes again with other masses
    #[arg(long, value_name = "MODEL", default_value = "prior")]
    model: ModelSpec,
    #[command(flatten)]
    keep: KeepArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &MassesArgs, session: &Session) -> Result<(), CliError> {
    let touching = args.touching.iter().map(|count| MassSetup::Touching((*count).into()));
    let crowds = args.crowds.iter().map(|count| MassSetup::Crowd((*count).into()));
    let controlled = args.controlled.iter().map(|setup| MassSetup::Controlled(*setup));
    let setups: Vec<MassSetup> = touching.chain(crowds).chain(controlled).collect();
    let sights = match &args.seen[..] {
        [] => &[Sighting::Exact, Sighting::Fine, Sighting::Coarse][..],
        some => some,
    };
    let suite = MassSuite::new(&setups, sights, args.seed, args.frictions);
    if suite.cases().is_empty() {
        return Err(CliError::usage("no scenes", "name numbers of cylinders: --crowds 9"));
    }
    let model = model::load(&args.model)?;
    let settings = json!({
        "version": MassSuite::VERSION,
        "cases": suite.cases(),
        "frictions": args.frictions,
    });
    let count = args.count as usize * suite.cases().len();
    let manifest = RunManifest::new(SUITE, count, args.seed, &args.model.to_string())
        .with_weights(keep::weights_digest(&args.model)?)
        .with_settings(settings);
    let store =
        args.keep.measure_side_by_side(session, manifest, |index| suite.measure(&model, index))?;
    let document = document(suite.cases(), store.finished());
    keep::show(args.form, session, &document, args.keep.out.as_deref())
}

/// The report of what was measured of these cases.
pub fn document(cases: &[MassCase], finished: &[Finished<MassRecord>]) -> Document {
    let records: Vec<&MassRecord> = finished.iter().map(|one| &one.record).collect();
    masses_document(&summarise_masses(cases, &records))
}
