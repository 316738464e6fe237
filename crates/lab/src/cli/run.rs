//! `pushplan-lab run`: the closed loop on random tasks with unknown scenes.

use clap::Args;
use pushplan::internals::scene::Engine;
use pushplan::internals::solve::Effort;
use pushplan_act::act::{ProbeRule, RunSettings};
use pushplan_command::bench::keep;
use pushplan_command::bench::keep::KeepArgs;
use pushplan_command::bench::suite::{Cases, Measure, Run, Suite};
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::value_enums::{EFFORTS, ENGINES, PROBES, possible_values};
use pushplan_report::Document;
use serde_json::json;

use crate::bench::{ClosedRecord, HiddenWorld, TaskKind};
use crate::cli::kept::same_tasks;
use crate::cli::random::random_error;
use crate::cli::tasks::TasksArgs;
use crate::report::closed_document;

/// Run random tasks with joints, masses, frictions and supports hidden
#[derive(Args, Debug)]
#[command(after_help = format!("Examples:
  pushplan-lab run --count 200 --out runs/closed
  pushplan-lab run --kind cluster --count 50 --probe-rule random

{}", keep::HELP))]
pub struct RunArgs {
    #[command(flatten)]
    tasks: TasksArgs,
    /// Number of tasks
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    count: u32,
    /// How hard to try with every plan
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "draft")]
    effort: Effort,
    /// Engine of the worlds
    #[arg(long, value_parser = possible_values(&ENGINES), default_value = "planar")]
    engine: Engine,
    /// Tolerance of the goals as a share of the usual 2 cm
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, value_parser = tolerance)]
    tolerance: f64,
    /// Most pushes of a run
    #[arg(long, value_name = "N", default_value_t = 12,
          value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_pushes: u16,
    /// Most pushes of a run that are made only to learn something
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    max_probes: u16,
    /// How these are chosen
    #[arg(long, value_parser = possible_values(&PROBES), value_name = "RULE", default_value = "task")]
    probe_rule: ProbeRule,
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
        let TasksArgs { common, .. } = &self.tasks;
        let library = common.library.load()?;
        let suite = self.tasks.suite(&library);
        if let Some(kind) = suite.kinds().iter().find(|kind| TaskKind::EVERYDAY.contains(kind)) {
            let message = format!("tasks of the kind `{kind}` are not run in a closed loop here");
            return Err(CliError::usage(message, "use `pushplan-lab random`, which plans them"));
        }
        let planner = common.planner(self.effort)?.build();
        let settings = RunSettings {
            max_pushes: self.max_pushes.into(),
            max_probes: self.max_probes.into(),
            probe_rule: self.probe_rule,
            ..RunSettings::default()
        };
        let world = HiddenWorld { engine: self.engine, tolerance: self.tolerance };
        let count = self.count as usize;
        let mut manifest =
            self.tasks.manifest((Self::NAME, count), &suite, (self.effort, &planner))?;
        manifest.settings["run"] = json!(settings);
        manifest.settings["world"] = json!(world);
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
