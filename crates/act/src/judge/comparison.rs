//! A prediction compared with the truth of a trial.

use pushplan::{
    effect::EffectModel,
    geometry::Pose,
    outcome::{Record, Trajectory, Warning},
    scene::State,
};

use super::{
    error::{ObjectError, object_errors},
    physical::{DriftSums, Joints, Overlaps},
    trial::Trial,
};

/// A model's rollout and the truth of a trial.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    trial: &'a Trial,
    start: State,
    predicted: Trajectory,
}

impl<'a> Comparison<'a> {
    /// What was `predicted` for the trial, with its truth. Without frames there is no answer.
    pub fn new(trial: &'a Trial, predicted: Trajectory) -> Self {
        Self { trial, start: trial.scene.start(), predicted }
    }

    /// Rolls `model` out on the trial: frame by frame, unless only the end is known.
    pub fn of(model: &dyn EffectModel, trial: &'a Trial) -> Self {
        let record = if trial.is_of_the_end() { Record::Outcome } else { Record::Frames };
        let rolled = model.rollout(&trial.scene, &[trial.job()], record);
        let nothing = || Trajectory::new(model.spec().clone());
        Self::new(trial, rolled.into_iter().next().unwrap_or_else(nothing))
    }

    /// What the model predicts.
    pub fn predicted(&self) -> &Trajectory {
        &self.predicted
    }

    /// Whether the model gave an answer and did not refuse.
    pub fn is_answered(&self) -> bool {
        !self.predicted.frames.is_empty() && !self.predicted.warnings.contains(&Warning::Refused)
    }

    /// Whether it gave a finite answer.
    pub fn is_finite(&self) -> bool {
        self.is_answered() && !self.predicted.warnings.contains(&Warning::NotFinite)
    }

    /// Errors of the predicted end against these poses; undefined without an answer.
    pub fn end_against(&self, truth: &[Pose]) -> Vec<ObjectError> {
        let end = self.predicted.frames.last().filter(|_| self.is_answered());
        self.errors(end.map(|frame| &frame.state), truth)
    }

    /// Errors at the last moment at which the truth is known; undefined without an answer.
    pub fn end(&self) -> Vec<ObjectError> {
        let last = self.trial.truth.last();
        last.map_or_else(Vec::new, |moment| self.end_against(&moment.poses))
    }

    /// Errors at every moment at which the truth is known. No answer counts as predicting that
    /// nothing moves.
    pub fn moments(&self) -> Vec<Vec<ObjectError>> {
        let pairs = self.states().into_iter().zip(&self.trial.truth);
        pairs.map(|(state, moment)| self.errors(Some(state), &moment.poses)).collect()
    }

    /// Deepest overlap of two predicted objects, or of one with an obstacle, at any moment,
    /// metres.
    pub fn overlap(&self) -> f64 {
        let overlaps = Overlaps::new(&self.trial.scene);
        let depths = self.states().into_iter().map(|state| overlaps.deepest(state));
        depths.fold(0.0, f64::max)
    }

    /// How far predicted joints drift at all moments.
    pub fn drift(&self) -> DriftSums {
        Joints::new(&self.trial.scene).drift(&self.states())
    }

    /// The trial as if the prediction had really happened.
    pub fn as_truth(&self) -> Trial {
        let poses = self.states().into_iter().map(|state| state.poses.clone());
        let mut trial = self.trial.clone();
        for (moment, poses) in trial.truth.iter_mut().zip(poses) {
            moment.poses = poses;
        }
        trial
    }

    /// Predicted states at every moment at which the truth is known.
    pub fn states(&self) -> Vec<&State> {
        match self.predicted.frames.is_empty() {
            true => vec![&self.start; self.trial.truth.len()],
            false => self.trial.aligned(&self.predicted),
        }
    }

    fn errors(&self, predicted: Option<&State>, truth: &[Pose]) -> Vec<ObjectError> {
        let poses = predicted.map(|state| state.poses.as_slice());
        let mut errors = object_errors(&self.trial.scene, &self.start.poses, poses, truth);
        for (error, known) in errors.iter_mut().zip(&self.trial.headings) {
            error.heading = error.heading.filter(|_| *known);
        }
        errors
    }
}
