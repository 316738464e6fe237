//! Measuring on crowds and recordings, set by set.

use crate::bench::{CrowdReport, assumed, crowd_baselines};
use crate::cli::{
    error::CliError,
    follow::Following,
    form::Form,
    model::{self, OutsideArgs},
    output,
    session::Session,
};
use crate::effect::EffectModel;
use crate::judge::Trial;
use crate::report::{crowd_document, evaluation_document};
use crate::scene::{Job, ModelSpec, Warning};

use super::sources::{CrowdArgs, Sources};

/// What is asked for.
pub struct Crowds<'a> {
    pub sources: &'a Sources,
    pub model: &'a ModelSpec,
    pub outside: OutsideArgs,
    pub seed: u64,
    pub args: &'a CrowdArgs,
    pub form: Form,
}

impl Crowds<'_> {
    /// Measures set by set; tables are printed and the folder's files written as each is done.
    ///
    /// # Errors
    /// A model that cannot be read; results that cannot be written.
    pub fn run(&self, session: &Session) -> Result<Vec<CrowdReport>, CliError> {
        let (sets, recordings) = (&self.sources.sets, &self.sources.recordings);
        let mut reports = Vec::new();
        if let Some(folder) = self.args.out.iter().find(|_| sets.len() + recordings.len() > 0) {
            output::prepare(folder)?;
        }
        if !sets.is_empty() {
            let models = self.models(false)?;
            for set in sets {
                let count = self.args.count as usize;
                let following = Following::bar(session, &set.title());
                reports.push(session.compute(|| {
                    let trials = set.draw(self.seed, count, &following);
                    CrowdReport::of_set(set, self.seed, &trials, &models, &following)
                }));
                following.finish()?;
                self.show_newest(&reports, session)?;
            }
        }
        if !recordings.is_empty() {
            self.recordings(&mut reports, session)?;
        }
        Ok(reports)
    }

    /// Every recording by itself, and all together where there are several.
    fn recordings(
        &self,
        reports: &mut Vec<CrowdReport>,
        session: &Session,
    ) -> Result<(), CliError> {
        let models = self.models(true)?;
        self.warn(&*models[0], session);
        let recordings = &self.sources.recordings;
        let trials: Vec<Trial> = recordings.iter().map(Trial::of_recording).collect();
        let names = recordings.iter().map(|recording| recording.name.clone());
        let mut groups: Vec<(String, &[Trial])> = names.zip(trials.chunks(1)).collect();
        if trials.len() > 1 {
            groups.push((format!("{} recordings", trials.len()), &trials));
        }
        for (title, trials) in groups {
            let following = Following::bar(session, &title);
            reports.push(
                session.compute(|| CrowdReport::of_recordings(title, trials, &models, &following)),
            );
            following.finish()?;
            self.show_newest(reports, session)?;
        }
        Ok(())
    }

    /// Says which recordings the model was not made for, one line for each kind of doubt.
    fn warn(&self, model: &dyn EffectModel, session: &Session) {
        let mut kinds: Vec<(Warning, Vec<&str>)> = Vec::new();
        for recording in &self.sources.recordings {
            let job = Job::stated(&recording.scene, recording.replay().motion);
            for warning in model.trust(&recording.scene, &job).warnings() {
                match kinds.iter_mut().find(|(known, _)| known.is_like(&warning)) {
                    Some((_, names)) if names.last() != Some(&&*recording.name) => {
                        names.push(&recording.name);
                    }
                    Some(_) => {}
                    None => kinds.push((warning, vec![&recording.name])),
                }
            }
        }
        let all = self.sources.recordings.len();
        for (warning, names) in kinds {
            let more = match names.len() {
                1 => String::new(),
                count => format!(" (and the like in {} more of {all} recordings)", count - 1),
            };
            session.warn(&format!("{}: {warning}{more}", names[0]));
        }
    }

    /// Prints the newest report and writes the folder's files.
    fn show_newest(&self, reports: &[CrowdReport], session: &Session) -> Result<(), CliError> {
        self.form.show_part(session, &crowd_document(reports))?;
        if let Some(folder) = &self.args.out {
            let document = evaluation_document(&[], reports);
            output::write(folder, "evaluation.json", document.to_json().as_bytes())?;
            output::write_figures(folder, document.figures())?;
        }
        Ok(())
    }

    /// The model that is asked for, the same under other assumptions about joints, and what
    /// stands beside it.
    fn models(&self, recorded: bool) -> Result<Vec<Box<dyn EffectModel>>, CliError> {
        let mut models: Vec<Box<dyn EffectModel>> = vec![Box::new(self.outside.load(self.model)?)];
        if self.args.no_baselines {
            return Ok(models);
        }
        for spec in assumed(self.model) {
            models.push(Box::new(self.outside.load(&spec)?));
        }
        for spec in crowd_baselines(self.model, recorded) {
            models.push(Box::new(model::load(&spec)?));
        }
        Ok(models)
    }
}
