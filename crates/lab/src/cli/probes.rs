//! `pushplan-lab probes`: information gained by exploratory pushes, for each rule that chooses
//! them.

use clap::Args;
use pushplan::internals::scene::ModelSpec;
use pushplan_act::act::ProbeRule;
use pushplan_bench::store::RunManifest;
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::KeepArgs;
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite, only};
use pushplan_command::error::CliError;
use pushplan_command::model;
use pushplan_command::session::Session;
use pushplan_command::value_enums::{PROBES, possible_values};
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{ProbeRecord, ProbeSuite, summarise_probes};
use crate::cli::kept::cases_of;
use crate::report::probes_document;

/// Choose exploratory pushes by several rules, and measure the inferred joints
#[derive(Args, Debug)]
#[command(after_help = format!("Makes three exploratory pushes of 10 cm in dense scenes of \
cylinders with all types of joints. The rule chooses each push among sixteen random pushes. After \
each push, the belief is compared with the ground truth, and used to predict four other pushes of \
20 cm.

Examples:
  pushplan-lab probes --count 100
  pushplan-lab probes --probe-rule information random --objects 9

{}", keep::HELP))]
pub struct ProbesArgs {
    /// Rules for choosing pushes, one or more [default: all but task, which needs a task]
    #[arg(long, num_args = 1.., value_parser = possible_values(&PROBES), value_name = "RULE")]
    probe_rule: Vec<ProbeRule>,
    /// Number of objects in a scene
    #[arg(long, value_name = "N", default_value_t = 6,
          value_parser = clap::value_parser!(u8).range(2..=12))]
    objects: u8,
    /// Number of scenes
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Seed of the scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Effect model for hypotheses and pushes
    #[arg(long, value_name = "MODEL", default_value = "prior")]
    model: ModelSpec,
}

impl Suite for ProbesArgs {
    const NAME: &'static str = "probes";
    type Record = ProbeRecord;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        _: &'a Session,
    ) -> Result<Cases<'a, ProbeRecord>, CliError> {
        let rules = match &self.probe_rule[..] {
            [] => &[
                ProbeRule::Information,
                ProbeRule::Random,
                ProbeRule::Uncertain,
                ProbeRule::Motion,
            ][..],
            some => some,
        };
        if rules.contains(&ProbeRule::Task) {
            let help = "use information, random, uncertain or motion, or measure tasks with \
                        `pushplan-lab run --probe-rule task`";
            return Err(CliError::usage("the rule `task` needs a task", help));
        }
        let suite = ProbeSuite::new(self.objects.into(), rules, self.seed);
        let model = model::load(&self.model)?;
        let settings = json!({"version": ProbeSuite::VERSION, "cases": suite.cases()});
        let count = self.count as usize * suite.cases().len();
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &self.model.to_string())
            .with_weights(keep::weights_digest(&self.model)?)
            .with_settings(settings);
        let measure = Measure::SideBySide(Box::new(move |index| suite.measure(&model, index)));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<ProbeRecord>]) -> Result<Document, CliError> {
        let (manifest, finished) = only(runs)?;
        let cases = cases_of(manifest);
        let records: Vec<_> = finished.iter().map(|one| &one.record).collect();
        Ok(probes_document(&summarise_probes(&cases, &records)))
    }
}
