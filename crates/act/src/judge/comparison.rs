//! Comparison of a prediction with the ground truth of a trial.

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

/// Rollout of a model and the ground truth of a trial.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    trial: &'a Trial,
    start: State,
    predicted: Trajectory,
}

impl<'a> Comparison<'a> {
    /// Compares `predicted` with the ground truth of a trial. Without frames there is no
    /// prediction.
    pub fn new(trial: &'a Trial, predicted: Trajectory) -> Self {
        Self { trial, start: trial.scene.start(), predicted }
    }

    /// Rolls out `model` on the trial: frame by frame, unless only the end is known.
    pub fn of(model: &dyn EffectModel, trial: &'a Trial) -> Self {
        let record = if trial.is_of_the_end() { Record::Outcome } else { Record::Frames };
        let rolled = model.rollout(&trial.scene, &[trial.job()], record);
        let nothing = || Trajectory::new(model.spec().clone());
        Self::new(trial, rolled.into_iter().next().unwrap_or_else(nothing))
    }

    /// Returns the prediction.
    pub fn predicted(&self) -> &Trajectory {
        &self.predicted
    }

    /// Returns `true` if the model returned a prediction and did not refuse the job.
    pub fn is_answered(&self) -> bool {
        !self.predicted.frames.is_empty() && !self.predicted.warnings.contains(&Warning::Refused)
    }

    /// Returns `true` if the prediction is finite.
    pub fn is_finite(&self) -> bool {
        self.is_answered() && !self.predicted.warnings.contains(&Warning::NotFinite)
    }

    /// Returns the final errors against these poses; undefined without a prediction.
    pub fn end_against(&self, truth: &[Pose]) -> Vec<ObjectError> {
        let end = self.predicted.frames.last().filter(|_| self.is_answered());
        self.errors(end.map(|frame| &frame.state), truth)
    }

    /// Returns the errors at the last moment with ground truth; undefined without a prediction.
    pub fn end(&self) -> Vec<ObjectError> {
        let last = self.trial.truth.last();
        last.map_or_else(Vec::new, |moment| self.end_against(&moment.poses))
    }

    /// Returns the errors at every moment with ground truth. Without a prediction all objects stay
    /// in place.
    pub fn moments(&self) -> Vec<Vec<ObjectError>> {
        let pairs = self.states().into_iter().zip(&self.trial.truth);
        pairs.map(|(state, moment)| self.errors(Some(state), &moment.poses)).collect()
    }

    /// Returns the maximum overlap of two predicted objects, or of an object with an obstacle,
    /// metres.
    pub fn overlap(&self) -> f64 {
        let overlaps = Overlaps::new(&self.trial.scene);
        let depths = self.states().into_iter().map(|state| overlaps.deepest(state));
        depths.fold(0.0, f64::max)
    }

    /// Returns the drift of the predicted joints over all moments.
    pub fn drift(&self) -> DriftSums {
        Joints::new(&self.trial.scene).drift(&self.states())
    }

    /// Returns the trial with the prediction as its ground truth.
    pub fn as_truth(&self) -> Trial {
        let poses = self.states().into_iter().map(|state| state.poses.clone());
        let mut trial = self.trial.clone();
        for (moment, poses) in trial.truth.iter_mut().zip(poses) {
            moment.poses = poses;
        }
        trial
    }

    /// Returns the predicted states at every moment with ground truth.
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
