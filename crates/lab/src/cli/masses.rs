//! `pushplan-lab masses`: accuracy of masses estimated from pushes.

use clap::Args;
use pushplan::internals::scene::ModelSpec;
use pushplan_bench::store::RunManifest;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::KeepArgs;
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite, only};
use pushplan_command::error::CliError;
use pushplan_command::model;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::dataset::{Controlled, MassSetup};
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{MassRecord, MassSuite, Sighting, summarise_masses};
use crate::cli::kept::cases_of;
use crate::cli::value_enums::{CONTROLLED, SIGHTINGS};
use crate::report::masses_document;

/// Infer which of three ranges each mass is in, from pushes in which objects touch
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
    /// Setups of nine cylinders with fixed positions and pushes; only the masses vary
    #[arg(long, num_args = 1.., value_parser = possible_values(&CONTROLLED), value_name = "SETUP")]
    controlled: Vec<Controlled>,
    /// Qualities of the observations, one or more [default: exact, fine and coarse]
    #[arg(long, num_args = 1.., value_parser = possible_values(&SIGHTINGS), value_name = "HOW")]
    seen: Vec<Sighting>,
    /// Also treat friction coefficients of the objects and the table as unknown
    #[arg(long)]
    frictions: bool,
    /// Number of trajectories of each set
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Seed of the scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Effect model for replays with other masses
    #[arg(long, value_name = "MODEL", default_value = "prior")]
    model: ModelSpec,
}

impl Suite for MassesArgs {
    const NAME: &'static str = "masses";
    type Record = MassRecord;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        _: &'a Session,
    ) -> Result<Cases<'a, MassRecord>, CliError> {
        let touching = self.touching.iter().map(|count| MassSetup::Touching((*count).into()));
        let crowds = self.crowds.iter().map(|count| MassSetup::Crowd((*count).into()));
        let controlled = self.controlled.iter().map(|setup| MassSetup::Controlled(*setup));
        let setups: Vec<MassSetup> = touching.chain(crowds).chain(controlled).collect();
        let sights = match &self.seen[..] {
            [] => &[Sighting::Exact, Sighting::Fine, Sighting::Coarse][..],
            some => some,
        };
        let suite = MassSuite::new(&setups, sights, self.seed, self.frictions);
        if suite.cases().is_empty() {
            return Err(CliError::usage("no scenes", "give numbers of cylinders: --crowds 9"));
        }
        let model = model::load(&self.model)?;
        let settings = json!({
            "version": MassSuite::VERSION,
            "cases": suite.cases(),
            "frictions": self.frictions,
        });
        let count = self.count as usize * suite.cases().len();
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &self.model.to_string())
            .with_weights(keep::weights_digest(&self.model)?)
            .with_settings(settings);
        let measure = Measure::SideBySide(Box::new(move |index| suite.measure(&model, index)));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<MassRecord>]) -> Result<Document, CliError> {
        let (manifest, finished) = only(runs)?;
        let cases = cases_of(manifest);
        let records: Vec<_> = finished.iter().map(|one| &one.record).collect();
        Ok(masses_document(&summarise_masses(&cases, &records)))
    }
}
