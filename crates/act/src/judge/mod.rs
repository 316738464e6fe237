//! Errors of predictions against the ground truth; all published errors are computed here.
//!
//! A [`Trial`] is a scene, a tool motion and its true outcome. A [`Comparison`] evaluates a model's
//! rollout on it: pose errors, joint drift and overlap. [`Summary`] and [`RelativeErrors`]
//! aggregate these with confidence intervals.
//!
//! Held-out evaluation in training, benchmarks and robustness tests all use this module. It draws
//! no scenes, creates no ground truth and prints nothing.

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
