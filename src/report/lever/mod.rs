//! Lever-ups for people: plans, predictions and verdicts in words, tables and pictures.

mod figure;
mod prediction;
mod solution;
mod verdict;
pub(super) mod words;

pub use figure::lever_figure;
pub use prediction::{PredictedLever, lever_prediction_document};
pub use solution::lever_solution_document;
pub use verdict::{lever_verdict_document, lever_verdict_line};
