//! What motions say about their causes.
//!
//! Of recorded pushes: how far out an object rests, and how it rubs on the pusher. A grid of two
//! numbers, the *spread* of the support and the coefficient of friction of pusher and object, and
//! for every cell how far an effect model told these two ends from what was recorded: with a law of
//! the noise that gives a posterior. Of the first frames of a lever-up: where the blade is, see
//! [`LeverSearch`]. It draws nothing and reads no files.

mod grid;
mod lever_point;
mod likelihood;
mod posterior;
mod run;

pub use grid::{Axis, Grid};
pub use lever_point::{LeverPoint, LeverSearch};
pub use likelihood::NoiseLaw;
pub use posterior::{Estimate, Posterior};
pub use run::{Fit, FitSettings, SupportError, fit};
