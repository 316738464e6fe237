//! Evaluation on a set of crowds.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::scene::ModelSpec;
use pushplan_act::judge::assumed;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::model::OutOfRangeArgs;
use pushplan_command::output;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;

use crate::bench::{CrowdReport, CrowdSet, HeldOutReport, crowd_baselines};
use crate::report::{crowd_document, evaluation_document};
use crate::trivial;

use super::sources::CrowdArgs;

/// An evaluation on crowds.
pub struct Crowds<'a> {
    pub sets: &'a [CrowdSet],
    pub model: &'a ModelSpec,
    pub out_of_range: OutOfRangeArgs,
    pub seed: u64,
    pub args: &'a CrowdArgs,
    pub form: Form,
}

impl Crowds<'_> {
    /// Returns the errors on a set of scenes.
    ///
    /// # Errors
    /// Returns an error if a model cannot be read.
    pub fn set(&self, set: &CrowdSet, session: &Session) -> Result<CrowdReport, CliError> {
        let models = self.models()?;
        let following = TerminalProgress::bar(session, &set.title());
        let report = session.compute(|| {
            let trials = set.draw(self.seed, self.args.count as usize, &following);
            CrowdReport::of((set, self.seed), &trials, &models, &following)
        });
        following.finish()?;
        Ok(report)
    }

    /// Prints the newest report, unless only a summary table is requested.
    ///
    /// # Errors
    /// Returns errors of [`Form::show`].
    pub fn show_part(&self, reports: &[CrowdReport], session: &Session) -> Result<(), CliError> {
        match self.args.summary {
            true => Ok(()),
            false => self.form.show_part(session, &crowd_document(reports)),
        }
    }

    /// Writes the folder's files, if there is a folder.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn write(&self, suites: &[HeldOutReport], crowds: &[CrowdReport]) -> Result<(), CliError> {
        let Some(folder) = &self.args.out else { return Ok(()) };
        let document = evaluation_document(suites, crowds);
        output::write(folder, "evaluation.json", document.to_json().as_bytes())?;
        output::write_figures(folder, document.figures())?;
        Ok(())
    }

    /// Returns the requested model, the model under other assumptions about joints, and its
    /// baselines.
    fn models(&self) -> Result<Vec<Box<dyn EffectModel>>, CliError> {
        let mut models: Vec<Box<dyn EffectModel>> = vec![self.load(self.model)?];
        if self.args.no_baselines {
            return Ok(models);
        }
        for spec in assumed(self.model) {
            models.push(self.load(&spec)?);
        }
        for spec in crowd_baselines(self.model) {
            models.push(Box::new(trivial::load(&spec)?));
        }
        Ok(models)
    }

    /// Builds a model that is used only where it can be trusted.
    ///
    /// # Errors
    /// Returns an error if a model cannot be read.
    pub fn load(&self, spec: &ModelSpec) -> Result<Box<dyn EffectModel>, CliError> {
        Ok(Box::new(trivial::load(spec)?.out_of_range(self.out_of_range.out_of_range())))
    }
}
