//! Benchmarks behind one trait: whoever says what the cases are and measures one of them has runs that
//! are kept, resumed, split, merged and shown.

use std::path::PathBuf;

use clap::builder::StyledStr;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use serde::{Serialize, de::DeserializeOwned};

use crate::{error::CliError, form::Form, session::Session};
use pushplan_bench::SolvedTask;
use pushplan_bench::store::{Finished, Measured, RunManifest, Store};
use pushplan_report::Document;

use super::keep::{self, KeepArgs};

/// A benchmark by its arguments.
pub trait Suite: Args {
    /// Its name in manifests.
    const NAME: &'static str;

    /// What is kept of a case.
    type Record: Serialize + DeserializeOwned + Send;

    /// What decides the records, and what measures one of them; `keep` says which are asked for.
    ///
    /// # Errors
    /// Arguments that do not fit together; files and models that cannot be read.
    fn cases<'a>(
        &'a self,
        keep: &KeepArgs,
        session: &'a Session,
    ) -> Result<Cases<'a, Self::Record>, CliError>;

    /// The report of one run; of several side by side where the suite compares them.
    ///
    /// # Errors
    /// Runs that cannot be compared.
    fn document(runs: &[Run<Self::Record>]) -> Result<Document, CliError>;

    /// The solved tasks of a run and the seed of their disturbed replays, where it has plans.
    fn solved(_: &Run<Self::Record>) -> Option<(u64, Vec<SolvedTask>)> {
        None
    }
}

/// What a run is of, and what it has measured.
pub type Run<R> = (RunManifest, Vec<Finished<R>>);

/// What decides the records of a run, and what measures them.
pub struct Cases<'a, R> {
    /// Suite, number of cases, seed, settings.
    pub manifest: RunManifest,
    /// What measures a case.
    pub measure: Measure<'a, R>,
}

/// What measures a case.
pub enum Measure<'a, R> {
    /// One after another, each on all threads of the session.
    InTurn(Box<dyn FnMut(usize) -> Result<Measured<R>, CliError> + 'a>),
    /// One on each of the session's threads, which share no work.
    SideBySide(Box<dyn Fn(usize) -> Measured<R> + Sync + 'a>),
}

/// The arguments of a suite, with those that all of them have.
#[derive(Debug)]
pub struct SuiteArgs<S> {
    /// What is measured.
    pub suite: S,
    /// Where results are kept.
    pub keep: KeepArgs,
    /// How they are shown.
    pub form: Form,
}

/// Written out, since what is derived would say of every suite what is said of this struct.
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
    /// Measures what is left of the run and shows all of it.
    ///
    /// # Errors
    /// Those of [`Suite::cases`] and of measuring; an interruption; results that cannot be written.
    pub fn run(&self, session: &Session) -> Result<(), CliError> {
        let Cases { manifest, measure } = self.suite.cases(&self.keep, session)?;
        let store = match measure {
            Measure::InTurn(measure) => self.keep.measure(session, manifest, measure)?,
            Measure::SideBySide(measure) => {
                self.keep.measure_side_by_side(session, manifest, measure)?
            }
        };
        let document = S::document(&[store.into_parts()])?;
        keep::show(self.form, session, &document, self.keep.out.as_deref())
    }
}

/// The runs in folders.
///
/// # Errors
/// Folders that hold no such run.
pub fn load<R: Serialize + DeserializeOwned>(dirs: &[PathBuf]) -> Result<Vec<Run<R>>, CliError> {
    dirs.iter().map(|dir| Ok(Store::<R>::load(dir)?.into_parts())).collect()
}

/// The only run, of a suite whose runs are not compared.
///
/// # Errors
/// Several of them.
pub fn only<R>(runs: &[Run<R>]) -> Result<&Run<R>, CliError> {
    match runs {
        [run] => Ok(run),
        _ => {
            Err(CliError::usage("runs of this suite are not shown side by side", "name one folder"))
        }
    }
}
