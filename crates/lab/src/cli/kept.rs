//! The suites whose runs are kept in folders, and what is shown of each.

use std::path::PathBuf;

use pushplan::cli::bench::saved::{Kept, one};
use pushplan::cli::error::CliError;
use pushplan::internals::report::Document;
use pushplan::internals::store::{Finished, RunManifest, Store, StoreError};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::bench::{ClosedRecord, Evaluated, LeverRecord, RandomRecord, TradeOff, by_kind};
use crate::report::{closed_document, evaluation_document, lever_tasks_document, random_document};

use super::{evaluate, joints, lever_tasks, masses, probes, random, refinement, run};

/// The suites of this command.
pub const SUITES: [Kept; 9] = [
    Kept {
        suite: joints::SUITE,
        document: Some(|runs| cases(runs, joints::document)),
        solved: None,
    },
    Kept {
        suite: masses::SUITE,
        document: Some(|runs| cases(runs, masses::document)),
        solved: None,
    },
    Kept {
        suite: probes::SUITE,
        document: Some(|runs| cases(runs, probes::document)),
        solved: None,
    },
    Kept {
        suite: lever_tasks::SUITE,
        document: Some(|runs| one::<LeverRecord>(runs, lever_tasks_document)),
        solved: None,
    },
    Kept {
        suite: refinement::SUITE,
        document: Some(|runs| one(runs, refinement::document)),
        solved: None,
    },
    Kept {
        suite: run::SUITE,
        document: Some(|runs| Ok(closed_document(&same_tasks::<ClosedRecord>(runs)?))),
        solved: None,
    },
    Kept {
        suite: random::SUITE,
        document: Some(|runs| Ok(random_document(&same_tasks::<RandomRecord>(runs)?))),
        solved: Some(|dir| {
            let (manifest, finished) = Store::<RandomRecord>::load(dir)?.into_parts();
            // The seed of a random run is that of its tasks; its planner has the default one.
            Ok((manifest, 0, finished.into_iter().map(|task| task.record.solved).collect()))
        }),
    },
    Kept {
        suite: evaluate::SUITE,
        document: Some(|runs| {
            one::<Evaluated>(runs, |_, finished| {
                let (suites, crowds) = by_kind(finished.iter().map(|part| &part.record));
                evaluation_document(&suites, &crowds)
            })
        }),
        solved: None,
    },
    // Its report needs the networks that were measured, which only the command names.
    Kept { suite: TradeOff::SUITE, document: None, solved: None },
];

/// The report of a run whose manifest lists its cases.
fn cases<C: DeserializeOwned, R: Serialize + DeserializeOwned>(
    runs: &[PathBuf],
    document: impl Fn(&[C], &[Finished<R>]) -> Document,
) -> Result<Document, CliError> {
    one(runs, |manifest: &RunManifest, finished: &[Finished<R>]| {
        let cases = serde_json::from_value(manifest.settings["cases"].clone());
        let cases: Vec<C> = cases.unwrap_or_default();
        document(&cases, finished)
    })
}

/// Runs that are compared: of the same tasks only.
fn same_tasks<R: Serialize + DeserializeOwned>(
    runs: &[PathBuf],
) -> Result<Vec<(RunManifest, Vec<Finished<R>>)>, CliError> {
    let runs: Vec<(RunManifest, Vec<Finished<R>>)> = runs
        .iter()
        .map(|dir| Ok(Store::<R>::load(dir)?.into_parts()))
        .collect::<Result<_, StoreError>>()?;
    let tasks = |run: &RunManifest| {
        let decides =
            ["kinds", "tasks_version", "tools", "world"].map(|key| run.settings[key].to_string());
        (run.seed, run.tasks, run.shard, decides)
    };
    let Some((first, others)) = runs.split_first() else { return Ok(runs) };
    if let Some((other, _)) = others.iter().find(|(run, _)| tasks(run) != tasks(&first.0)) {
        return Err(CliError::usage(
            format!(
                "the runs are of different tasks: seed {}, {} tasks beside seed {}, {} tasks",
                first.0.seed, first.0.tasks, other.seed, other.tasks
            ),
            "compare runs with the same --seed, --count, --kind, --shard and --tools",
        ));
    }
    Ok(runs)
}
