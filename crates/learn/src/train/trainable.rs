//! Interface of a network to its [`Trainer`](super::Trainer).

use std::fmt::Display;

use pushplan::internals::network::{Card, Parameters, Weights};
use serde::{Serialize, de::DeserializeOwned};

use super::Descent;

/// Network with its training and held-out data.
pub trait Trainable: Sync + Sized {
    /// Key of the header in a checkpoint's metadata, which identifies the network.
    const KEY: &'static str;

    /// Settings of a run; a checkpoint resumes only under equal settings.
    type Settings: Clone + PartialEq + Serialize + DeserializeOwned;

    /// Feature scales.
    type Scales: Sync + Serialize + DeserializeOwned;

    /// Held-out score.
    type Score: Clone + Display + Serialize + DeserializeOwned;

    /// Card of the weights.
    type Card: Card;

    /// Returns the settings of this run.
    fn settings(&self) -> Self::Settings;

    /// Returns the optimisation settings.
    fn descent(&self) -> Descent;

    /// Returns `true` if there are no examples.
    fn is_empty(&self) -> bool;

    /// Measures the feature scales on the data.
    fn scales(&self) -> Self::Scales;

    /// Returns the initial values of all parameters.
    fn fresh(&self, scales: &Self::Scales) -> Parameters;

    /// Returns the mean loss of one replica's examples and its gradient.
    ///
    /// The result depends only on the weights, the scales, the step, the replica, and the weights
    /// of the last [`Self::follow`].
    ///
    /// # Errors
    /// Returns errors of candle.
    fn gradient(
        &self,
        weights: &Parameters,
        scales: &Self::Scales,
        step_and_replica: (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)>;

    /// Evaluates weights on the held-out data.
    fn score(&self, weights: &Weights<Self::Card>) -> Self::Score;

    /// Returns `true` if `score` is better than `than`.
    fn is_better(score: &Self::Score, than: &Self::Score) -> bool;

    /// Returns the card of the weights after `step` steps, with their score, if any. Its names and
    /// shapes depend only on the scales.
    fn card(&self, scales: &Self::Scales, step: u64, score: Option<&Self::Score>) -> Self::Card;

    /// Returns `true` if examples must come from rollouts of this step's averaged weights from now
    /// on.
    fn refreshes(&self, _step: u64) -> bool {
        false
    }

    /// Takes examples from rollouts of these weights from now on.
    fn follow(&mut self, _lead: &Parameters, _scales: &Self::Scales) {}
}
