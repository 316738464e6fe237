//! `pushplan-lab joints`: accuracy of joints inferred from observations.

use clap::Args;
use pushplan::internals::scene::{Engine, ModelSpec};
use pushplan_bench::store::RunManifest;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::KeepArgs;
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite, only};
use pushplan_command::error::CliError;
use pushplan_command::model;
use pushplan_command::regulator::RegulatorArgs;
use pushplan_command::session::Session;
use pushplan_command::value_enums::{ENGINES, possible_values};
use pushplan_learn::cli::value_enums::JOINTS;
use pushplan_learn::dataset::JointRule;
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{
    BeliefRecord, BeliefSuite, Circumstances, CrowdFamily, Sighting, summarise_beliefs,
    update_times,
};
use crate::cli::kept::cases_of;
use crate::cli::value_enums::{FAMILIES, SIGHTINGS};
use crate::report::joints_document;

/// Infer joints from observed crowds, and predict the remaining motion under each belief
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab joints --count 50 --out runs/joints
  pushplan-lab joints --on dense --seen exact --seen fine --regulator none

{}", keep::HELP))]
pub struct JointsArgs {
    /// Families of scenes [default: sparse and dense]
    #[arg(long, num_args = 1.., value_parser = possible_values(&FAMILIES), value_name = "FAMILY")]
    on: Vec<CrowdFamily>,
    /// Numbers of objects
    #[arg(long, value_name = "N", num_args = 1.., default_value = "9")]
    objects: Vec<usize>,
    /// Types of joints between near neighbours
    #[arg(long, value_parser = possible_values(&JOINTS[1..]), default_value = "mixed")]
    joints: JointRule,
    /// Qualities of the observations, one or more [default: all]
    #[arg(long, num_args = 1.., value_parser = possible_values(&SIGHTINGS), value_name = "HOW")]
    seen: Vec<Sighting>,
    /// Number of trajectories of each set
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Seed of the scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Engine of the trajectories
    #[arg(long, value_parser = possible_values(&ENGINES), value_name = "ENGINE",
          default_value = "planar")]
    engine: Engine,
    /// Give the observer wrong values: object friction 0.6 times and table friction 1.3 times the
    /// true value, and 0.6 kg for every mass
    #[arg(long)]
    misled: bool,
    /// Effect model for hypotheses and the remaining motion
    #[arg(long, value_name = "MODEL", default_value = "prior")]
    model: ModelSpec,
    /// Infer types only; skip the prediction of the remaining motion, which takes most of the time
    #[arg(long)]
    types_only: bool,
    #[command(flatten)]
    regulator: RegulatorArgs,
}

impl Suite for JointsArgs {
    const NAME: &'static str = "joints";
    type Record = BeliefRecord;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        _: &'a Session,
    ) -> Result<Cases<'a, BeliefRecord>, CliError> {
        let families = match &self.on[..] {
            [] => &[CrowdFamily::Sparse, CrowdFamily::Dense][..],
            some => some,
        };
        let sights = if self.seen.is_empty() { &Sighting::ALL[..] } else { &self.seen[..] };
        let (regulator, digest) = match self.regulator.load()? {
            Some((regulator, digest)) => (Some(regulator), Some(digest)),
            None => (None, None),
        };
        let sets = (families, &self.objects[..], self.joints);
        let circumstances = Circumstances { engine: self.engine, misled: self.misled };
        let suite = BeliefSuite::new(sets, sights, self.seed, (regulator, !self.types_only))
            .under(circumstances);
        if suite.cases().is_empty() {
            return Err(CliError::usage(
                "no set has this number of objects",
                "sparse sets have 6, 9 or 12 objects, dense sets 6, 8 or 9",
            ));
        }
        let model = model::load(&self.model)?;
        let settings = json!({
            "version": BeliefSuite::VERSION,
            "cases": suite.cases(),
            "rest": !self.types_only,
            "circumstances": circumstances,
        });
        let count = self.count as usize * suite.cases().len();
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &self.model.to_string())
            .with_weights(digest)
            .with_settings(settings);
        let measure = Measure::SideBySide(Box::new(move |index| suite.measure(&model, index)));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<BeliefRecord>]) -> Result<Document, CliError> {
        let (manifest, finished) = only(runs)?;
        let cases = cases_of(manifest);
        let records: Vec<_> = finished.iter().map(|one| &one.record).collect();
        Ok(joints_document(&summarise_beliefs(&cases, &records), &update_times(&cases, finished)))
    }
}
