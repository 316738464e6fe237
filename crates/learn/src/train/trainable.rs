//! What a network has to say so that a [`Trainer`](super::Trainer) can train it.

use std::fmt::Display;

use pushplan::internals::network::{Card, Parameters, Weights};
use serde::{Serialize, de::DeserializeOwned};

use super::Descent;

/// A network with the data that it learns from and those that it is judged on.
pub trait Trainable: Sync + Sized {
    /// Key of the header in a checkpoint's metadata: which network it belongs to.
    const KEY: &'static str;

    /// Everything that decides a run; a checkpoint resumes only under the same.
    type Settings: Clone + PartialEq + Serialize + DeserializeOwned;

    /// Feature scales.
    type Scales: Sync + Serialize + DeserializeOwned;

    /// What it is judged by.
    type Score: Clone + Display + Serialize + DeserializeOwned;

    /// What its weights are.
    type Card: Card;

    /// Everything that decides this run.
    fn settings(&self) -> Self::Settings;

    /// How weights follow gradients.
    fn descent(&self) -> Descent;

    /// Whether there is nothing to learn from.
    fn is_empty(&self) -> bool;

    /// Feature scales, measured on the data.
    fn scales(&self) -> Self::Scales;

    /// First values of all parameters.
    fn fresh(&self, scales: &Self::Scales) -> Parameters;

    /// The mean loss of one replica's examples and its gradient: a pure function of these weights
    /// and scales, the step and the replica, and of what was last followed.
    ///
    /// # Errors
    /// Those of candle.
    fn gradient(
        &self,
        weights: &Parameters,
        scales: &Self::Scales,
        step_and_replica: (u64, usize),
    ) -> candle_core::Result<(f64, Parameters)>;

    /// How good weights are on what was not learned from.
    fn score(&self, weights: &Weights<Self::Card>) -> Self::Score;

    /// Whether the one score is better than the other.
    fn is_better(score: &Self::Score, than: &Self::Score) -> bool;

    /// The card of the weights after `step` steps, with their score, if they have one. The names and
    /// shapes that it states depend on the scales alone.
    fn card(&self, scales: &Self::Scales, step: u64, score: Option<&Self::Score>) -> Self::Card;

    /// Whether examples are taken from rollouts of the averaged weights of this step from here on.
    fn refreshes(&self, _step: u64) -> bool {
        false
    }

    /// Takes examples from rollouts of these weights from here on.
    fn follow(&mut self, _lead: &Parameters, _scales: &Self::Scales) {}
}
