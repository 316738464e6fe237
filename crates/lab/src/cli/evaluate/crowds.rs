//! Measuring on a set of crowds, and on recordings.

use crate::bench::{
    Asked, BeliefRecord, CrowdReport, CrowdSet, HeldOutReport, JointMethod, assumed, belief_steps,
    crowd_baselines, follow,
};
use crate::report::{crowd_document, evaluation_document, recorded_joints_document};
use pushplan::cli::error::CliError;
use pushplan::cli::follow::Following;
use pushplan::cli::form::Form;
use pushplan::cli::model::OutsideArgs;
use pushplan::cli::poses::PosesArgs;
use pushplan::cli::recordings::RecordingSet;
use pushplan::cli::session::Session;
use pushplan::cli::{model, output};
use pushplan::internals::effect::EffectModel;
use pushplan::internals::geometry::Pose;
use pushplan::internals::judge::{Comparison, Trial};
use pushplan::internals::recording::Recording;
use pushplan::internals::report::{PoseRow, RECORDED};
use pushplan::internals::scene::{Job, ModelSpec, Warning};
use pushplan::internals::watch::Count;

use crate::cli::evaluate::sources::{CrowdArgs, Sources};

/// What is asked for.
pub struct Crowds<'a> {
    pub sources: &'a Sources,
    pub model: &'a ModelSpec,
    pub outside: OutsideArgs,
    pub seed: u64,
    pub args: &'a CrowdArgs,
    pub poses: &'a PosesArgs,
    pub form: Form,
}

impl Crowds<'_> {
    /// Errors on a set of scenes.
    ///
    /// # Errors
    /// A model that cannot be read.
    pub fn set(&self, set: &CrowdSet, session: &Session) -> Result<CrowdReport, CliError> {
        let models = self.models(false)?;
        let following = Following::bar(session, &set.title());
        let report = session.compute(|| {
            let trials = set.draw(self.seed, self.args.count as usize, &following);
            CrowdReport::of_set(set, self.seed, &trials, &models, &following)
        });
        following.finish()?;
        Ok(report)
    }

    /// Every set of recordings by itself, and all together where there are several; beside them
    /// stand in the folder's files what was measured before.
    ///
    /// # Errors
    /// A model that cannot be read; results that cannot be written.
    pub fn recordings(
        &self,
        suites: &[HeldOutReport],
        reports: &mut Vec<CrowdReport>,
        session: &Session,
    ) -> Result<(), CliError> {
        let models = self.models(true)?;
        self.warn(&*models[0], session);
        let sets = &self.sources.recordings;
        let all: Vec<&Recording> = sets.iter().flat_map(|set| &set.recordings).collect();
        let trials: Vec<Trial> =
            all.iter().map(|recording| Trial::of_recording(recording)).collect();
        let names: Vec<String> = all.iter().map(|recording| recording.name.clone()).collect();
        let mut groups = Vec::new();
        let mut first = 0;
        for RecordingSet { title, recordings } in sets {
            groups.push((title.clone(), first..first + recordings.len()));
            first += recordings.len();
        }
        if groups.len() > 1 {
            groups.push((format!("{} recordings", trials.len()), 0..trials.len()));
        }
        for (title, range) in groups {
            let following = Following::bar(session, &title);
            let (trials, names) = (&trials[range.clone()], names[range].to_vec());
            reports.push(session.compute(|| {
                let report = CrowdReport::of_recordings(title, names, trials, &models, &following);
                match self.args.no_baselines {
                    true => report,
                    false => report.with_own_spread(trials, &following),
                }
            }));
            following.finish()?;
            self.show_part(reports, session)?;
            self.write(suites, reports)?;
        }
        let told = self.args.told();
        if !told.is_empty() {
            self.rest_of_the_way(&all, &told, session)?;
        }
        if self.poses.wanted() {
            let rows = session.compute(|| poses(&all, &trials, &models));
            self.poses.write(&rows)?;
        }
        Ok(())
    }

    /// Prints the newest report, unless only one table of all is wanted.
    ///
    /// # Errors
    /// Those of [`Form::show`].
    pub fn show_part(&self, reports: &[CrowdReport], session: &Session) -> Result<(), CliError> {
        match self.args.summary {
            true => Ok(()),
            false => self.form.show_part(session, &crowd_document(reports)),
        }
    }

    /// Predicts the rest of the way of every recording with the joints by each of these methods.
    fn rest_of_the_way(
        &self,
        recordings: &[&Recording],
        told: &[JointMethod],
        session: &Session,
    ) -> Result<(), CliError> {
        let model = self.outside.load(self.model)?;
        let regulator = match told.contains(&JointMethod::Regulator) {
            true => self.args.regulator.load()?.map(|(regulator, _)| regulator),
            false => None,
        };
        let following = Following::bar(session, "inferring");
        let count = Count::new(&following, 0, recordings.len());
        let records: Vec<BeliefRecord> = session.compute(|| {
            let of = |recording: &&Recording| {
                let observations = recording.observations();
                let seen = (&recording.scene, &observations[..], self.args.noise());
                let by = (&model as &dyn EffectModel, regulator.as_ref(), true);
                let (record, _) = follow(recording, seen, by, Asked::AfterContact, 0);
                count.one();
                record
            };
            recordings.iter().map(of).collect()
        });
        following.finish()?;
        let steps = belief_steps(&records.iter().collect::<Vec<_>>());
        let document =
            recorded_joints_document(&model.spec().to_string(), recordings.len(), &steps, told);
        self.form.show_part(session, &document)
    }

    /// Says which recordings the model was not made for, one line for each kind of doubt.
    fn warn(&self, model: &dyn EffectModel, session: &Session) {
        let mut kinds: Vec<(Warning, Vec<&str>)> = Vec::new();
        let sets = &self.sources.recordings;
        for recording in sets.iter().flat_map(|set| &set.recordings) {
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
        let all: usize = sets.iter().map(|set| set.recordings.len()).sum();
        for (warning, names) in kinds {
            let more = match names.len() {
                1 => String::new(),
                count => format!(" (and the like in {} more of {all} recordings)", count - 1),
            };
            session.warn(&format!("{}: {warning}{more}", names[0]));
        }
    }

    /// Writes the folder's files, if there is a folder.
    ///
    /// # Errors
    /// If that cannot be done.
    pub fn write(&self, suites: &[HeldOutReport], crowds: &[CrowdReport]) -> Result<(), CliError> {
        let Some(folder) = &self.args.out else { return Ok(()) };
        let document = evaluation_document(suites, crowds);
        output::write(folder, "evaluation.json", document.to_json().as_bytes())?;
        output::write_figures(folder, document.figures())?;
        Ok(())
    }

    /// The model that is asked for, the same under other assumptions about joints, and what
    /// stands beside it.
    fn models(&self, recorded: bool) -> Result<Vec<Box<dyn EffectModel>>, CliError> {
        let mut models: Vec<Box<dyn EffectModel>> = vec![Box::new(self.outside.load(self.model)?)];
        if self.args.no_baselines {
            return Ok(models);
        }
        let recorded_joints = || {
            let sets = self.sources.recordings.iter();
            sets.flat_map(|set| &set.recordings).any(|one| !one.scene.joints.is_empty())
        };
        if !recorded || recorded_joints() {
            for spec in assumed(self.model) {
                models.push(Box::new(self.outside.load(&spec)?));
            }
        }
        for spec in crowd_baselines(self.model, recorded) {
            models.push(Box::new(model::load(&spec)?));
        }
        Ok(models)
    }
}

/// Every object at every recorded instant that is compared: as recorded, and by every model.
fn poses(
    recordings: &[&Recording],
    trials: &[Trial],
    models: &[Box<dyn EffectModel>],
) -> Vec<PoseRow> {
    let mut rows = Vec::new();
    for (recording, trial) in recordings.iter().zip(trials) {
        let replay = recording.replay();
        let times: Vec<f64> =
            replay.instants.iter().map(|instant| recording.frames[instant.frame].time).collect();
        let mut add = |by: &str, moments: &[&[Pose]]| {
            for (time, poses) in times.iter().zip(moments) {
                for (object, pose) in recording.scene.objects.iter().zip(*poses) {
                    rows.push(PoseRow {
                        name: recording.name.clone(),
                        by: by.into(),
                        object: object.name.clone(),
                        time: *time,
                        pose: *pose,
                    });
                }
            }
        };
        let truth: Vec<&[Pose]> = trial.truth.iter().map(|moment| &*moment.poses).collect();
        add(RECORDED, &truth);
        for model in models {
            let comparison = Comparison::of(&**model, trial);
            let states: Vec<&[Pose]> =
                comparison.states().into_iter().map(|state| &*state.poses).collect();
            add(&model.spec().to_string(), &states);
        }
    }
    rows
}
