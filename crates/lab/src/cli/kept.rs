//! The suites whose runs are stored in folders, and the conditions for a comparison of runs.

use pushplan_bench::store::RunManifest;
use pushplan_command::bench::saved::Kept;
use pushplan_command::bench::suite::{Run, load, only};
use pushplan_command::error::CliError;
use serde::de::DeserializeOwned;

use crate::bench::{Evaluated, TradeOff, by_kind};
use crate::report::evaluation_document;

use super::evaluate;
use super::joints::JointsArgs;
use super::lever_tasks::LeverTasksArgs;
use super::masses::MassesArgs;
use super::probes::ProbesArgs;
use super::random::RandomArgs;
use super::refinement::RefinementArgs;
use super::run::RunArgs;

/// The suites of this command.
pub const SUITES: [Kept; 9] = [
    Kept::of::<JointsArgs>(),
    Kept::of::<MassesArgs>(),
    Kept::of::<ProbesArgs>(),
    Kept::of::<LeverTasksArgs>(),
    Kept::of::<RefinementArgs>(),
    Kept::of::<RunArgs>(),
    Kept::of::<RandomArgs>(),
    Kept::apart(
        evaluate::SUITE,
        Some(|dirs| {
            let runs = load::<Evaluated>(dirs)?;
            let (_, finished) = only(&runs)?;
            let (suites, crowds) = by_kind(finished.iter().map(|part| &part.record));
            Ok(evaluation_document(&suites, &crowds))
        }),
    ),
    // Its report needs the measured networks, which only the command names.
    Kept::apart(TradeOff::SUITE, None),
];

/// Returns the cases of a run whose manifest lists them.
pub fn cases_of<C: DeserializeOwned>(manifest: &RunManifest) -> Vec<C> {
    serde_json::from_value(manifest.settings["cases"].clone()).unwrap_or_default()
}

/// Refuses runs of different tasks, because methods are compared on equal tasks only.
///
/// # Errors
/// Returns the difference.
pub fn same_tasks<R>(runs: &[Run<R>]) -> Result<(), CliError> {
    let tasks = |run: &RunManifest| {
        let decides =
            ["kinds", "tasks_version", "tools", "world"].map(|key| run.settings[key].to_string());
        (run.seed, run.tasks, run.shard, decides)
    };
    let Some((first, others)) = runs.split_first() else { return Ok(()) };
    match others.iter().find(|(run, _)| tasks(run) != tasks(&first.0)) {
        Some((other, _)) => Err(CliError::usage(
            format!(
                "the runs have different tasks: seed {}, {} tasks and seed {}, {} tasks",
                first.0.seed, first.0.tasks, other.seed, other.tasks
            ),
            "compare runs with the same --seed, --count, --kind, --shard and --tools",
        )),
        None => Ok(()),
    }
}
