//! Common trait of benchmarks. An implementation defines the cases and measures one; resuming,
//! splitting, merging and reports are shared.

use std::path::PathBuf;

use clap::builder::StyledStr;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use serde::{Serialize, de::DeserializeOwned};

use crate::{error::CliError, form::Form, session::Session};
use pushplan_bench::SolvedTask;
use pushplan_bench::store::{Finished, Measured, RunManifest, Store};
use pushplan_report::Document;

use super::keep::{self, KeepArgs, Kept};

/// Benchmark, defined by its arguments.
pub trait Suite: Args {
    /// Name in manifests.
    const NAME: &'static str;

    /// Record of a case.
    type Record: Serialize + DeserializeOwned + Send;

    /// Returns the manifest and the measurement of the cases; `keep` selects a part of them.
    ///
    /// # Errors
    /// Returns an error for inconsistent arguments, and for files and models that cannot be read.
    fn cases<'a>(
        &'a self,
        keep: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, Self::Record>, CliError>;

    /// Returns the report of one run, or of several side by side if the suite supports it.
    ///
    /// # Errors
    /// Returns an error for runs that cannot be compared.
    fn document(runs: &[Run<Self::Record>]) -> Result<Document, CliError>;

    /// Returns the seed of the perturbed replays and the solved tasks of a run, if it has plans.
    fn solved(_: &Run<Self::Record>) -> Option<(u64, Vec<SolvedTask>)> {
        None
    }
}

/// Manifest and finished cases of a run.
pub type Run<R> = (RunManifest, Vec<Finished<R>>);

/// Manifest of a run and the measurement of its cases.
pub struct Cases<'a, R> {
    /// Suite, number of cases, seed, settings.
    pub manifest: RunManifest,
    /// Measurement of a case.
    pub measure: Measure<'a, R>,
}

/// Measurement of a case.
pub enum Measure<'a, R> {
    /// Sequential measurement, each case on all threads of the session.
    InTurn(Box<dyn FnMut(usize) -> Result<Measured<R>, CliError> + 'a>),
    /// Parallel measurement, one case on each of the session's threads, without shared work.
    SideBySide(Box<dyn Fn(usize) -> Measured<R> + Sync + 'a>),
}

/// Arguments of a suite and the common arguments of all suites.
#[derive(Debug)]
pub struct SuiteArgs<S> {
    /// Arguments of the suite.
    pub suite: S,
    /// Folder and shard of the results.
    pub keep: KeepArgs,
    /// Output format.
    pub form: Form,
}

/// Implemented by hand, because a derived help would show this struct's docs for every suite.
impl<S: Args> Args for SuiteArgs<S> {
    fn augment_args(command: Command) -> Command {
        let command = S::augment_args(command);
        let text = |of: Option<&StyledStr>| of.cloned().unwrap_or_default();
        let (about, after) = (text(command.get_about()), text(command.get_after_help()));
        Form::augment_args(KeepArgs::augment_args(command)).about(about).after_help(after)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<S: FromArgMatches> FromArgMatches for SuiteArgs<S> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self {
            suite: S::from_arg_matches(matches)?,
            keep: KeepArgs::from_arg_matches(matches)?,
            form: Form::from_arg_matches(matches)?,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<S: Suite> SuiteArgs<S> {
    /// Measures the remaining cases of the run and shows all of them.
    ///
    /// # Errors
    /// Returns the errors of [`Suite::cases`] and of measuring, an interruption, and errors of
    /// writing results.
    pub fn run(&self, session: &Session) -> Result<(), CliError> {
        let Cases { manifest, measure } = self.suite.cases(&self.keep, session)?;
        let Kept { store, interruption } = match measure {
            Measure::InTurn(measure) => self.keep.measure(session, manifest, measure)?,
            Measure::SideBySide(measure) => {
                self.keep.measure_side_by_side(session, manifest, measure)?
            }
        };
        if let Some(interruption) = interruption {
            if !store.finished().is_empty() {
                let document = S::document(&[store.into_parts()])?;
                self.form.show_rest(session, &document, false)?;
            }
            return Err(interruption);
        }
        let document = S::document(&[store.into_parts()])?;
        keep::show(self.form, session, &document, self.keep.out.as_deref())
    }
}

/// Loads the runs in folders.
///
/// # Errors
/// Returns an error if a folder contains no such run.
pub fn load<R: Serialize + DeserializeOwned>(dirs: &[PathBuf]) -> Result<Vec<Run<R>>, CliError> {
    dirs.iter().map(|dir| Ok(Store::<R>::load(dir)?.into_parts())).collect()
}

/// Returns the only run, for a suite whose runs are not compared.
///
/// # Errors
/// Returns an error for several runs.
pub fn only<R>(runs: &[Run<R>]) -> Result<&Run<R>, CliError> {
    match runs {
        [run] => Ok(run),
        _ => Err(CliError::usage("runs of this suite cannot be shown together", "name one folder")),
    }
}
