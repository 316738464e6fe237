//! `pushplan-lab run`: the closed loop on random tasks that do not know their scene.

use clap::Args;
use pushplan::cli::bench::common::Common;
use pushplan::cli::bench::keep;
use pushplan::cli::bench::keep::{KeepArgs, value_digest, weights_digest};
use pushplan::cli::bench::suite::{Cases, Measure, Run, Suite};
use pushplan::cli::error::CliError;
use pushplan::cli::model;
use pushplan::cli::session::Session;
use pushplan::cli::words::{EFFORTS, ENGINES, PROBES, words};
use pushplan::internals::act::{ProbeRule, RunSettings};
use pushplan::internals::report::Document;
use pushplan::internals::scene::Engine;
use pushplan::internals::solve::{Effort, Planner};
use pushplan::internals::store::RunManifest;
use serde_json::json;

use crate::bench::{ClosedRecord, HiddenWorld, RandomSuite, TaskKind};
use crate::cli::kept::same_tasks;
use crate::cli::random::random_error;
use crate::cli::words::KINDS;
use crate::report::closed_document;

/// Run random tasks with joints, masses, frictions and supports hidden
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab run --count 200 --out runs/closed
  pushplan-lab run --kind cluster --count 50 --rule random

{}", keep::HELP))]
pub struct RunArgs {
    #[command(flatten)]
    common: Common,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// Seed of the tasks
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Only tasks of this kind; may be given several times [default: all that `pushplan-lab random` has, in
    /// turn]
    #[arg(long = "kind", value_parser = words(&KINDS), value_name = "KIND")]
    kinds: Vec<TaskKind>,
    /// How hard to try with every plan
    #[arg(long, value_parser = words(&EFFORTS), default_value = "draft")]
    effort: Effort,
    /// Engine of the worlds
    #[arg(long, value_parser = words(&ENGINES), default_value = "planar")]
    engine: Engine,
    /// Tolerance of the goals as a share of the usual 2 cm
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, value_parser = tolerance)]
    tolerance: f64,
    /// Most pushes of a run
    #[arg(long, value_name = "N", default_value_t = 12,
          value_parser = clap::value_parser!(u16).range(1..=1000))]
    pushes: u16,
    /// Most pushes of a run that are made only to learn something
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    probes: u16,
    /// How these are chosen
    #[arg(long, value_parser = words(&PROBES), value_name = "RULE", default_value = "task")]
    rule: ProbeRule,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "a quarter is 0.25".to_owned())?;
    let sound = (0.05..=10.0).contains(&value);
    sound.then_some(value).ok_or_else(|| "it must be 0.05 to 10".to_owned())
}

impl Suite for RunArgs {
    const NAME: &'static str = "run";
    type Record = ClosedRecord;

    fn cases<'a>(
        &'a self,
        _: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, ClosedRecord>, CliError> {
        let library = self.common.library.load()?;
        let mut kinds: Vec<TaskKind> = self.kinds.clone();
        kinds.sort_unstable();
        kinds.dedup();
        let suite = RandomSuite::new(&library, self.seed, &kinds);
        let spec = self.common.spec(self.effort);
        let planner = Planner::builder(model::load(&spec)?)
            .effort(self.effort)
            .outside(self.common.outside.outside())
            .build();
        let settings = RunSettings {
            pushes: self.pushes.into(),
            probes: self.probes.into(),
            rule: self.rule,
            ..RunSettings::default()
        };
        let world = HiddenWorld { engine: self.engine, tolerance: self.tolerance };
        let count = self.count as usize;
        let tools: Vec<_> = library.iter().map(|tool| &**tool).collect();
        let mut noted = json!({
            "effort": self.effort,
            "budget": planner.settings(),
            "run": settings,
            "world": world,
            "kinds": suite.kinds(),
            "tasks_version": RandomSuite::VERSION,
            "tools": value_digest(&tools)?,
        });
        self.common.outside.note(&mut noted);
        let manifest = RunManifest::new(Self::NAME, count, self.seed, &spec.to_string())
            .with_weights(weights_digest(&spec)?)
            .with_settings(noted);
        let measure = Measure::InTurn(Box::new(move |index| {
            session
                .compute(|| suite.run_hidden(&planner, &library, (settings, world), index))
                .map_err(random_error)
        }));
        Ok(Cases { manifest, measure })
    }

    fn document(runs: &[Run<ClosedRecord>]) -> Result<Document, CliError> {
        same_tasks(runs)?;
        Ok(closed_document(runs))
    }
}
