//! Judges predictions against the truth: every published error comes from here.
//!
//! A [`Trial`] is a scene, a tool motion and what really happened; a [`Comparison`] puts a model's
//! rollout to it and says how far each object is off, how far joints drift and how deep bodies
//! overlap; [`Summary`] and [`RelativeErrors`] turn many of these into numbers with intervals.
//! Training's held-out criterion, benchmarks and robustness tests all judge here, which is why the
//! module comes right after `effect`. It draws no scenes, makes no truth and prints nothing.

mod baselines;
mod comparison;
mod error;
mod model_errors;
mod physical;
mod statistics;
mod trial;

pub use baselines::{SHIFTED_START, assumed, mistaken_frictions, recorded_baselines};
pub use comparison::Comparison;
pub use error::{MOVED, ObjectError, object_errors};
pub use model_errors::{
    CurvePoint, ModelErrors, OneError, Phases, RecordedErrors, TrialErrors, own_spread,
};
pub use physical::{Drift, DriftSums};
pub use statistics::{RelativeErrors, Summary, mean, percentile};
pub use trial::{Moment, Trial, When};
