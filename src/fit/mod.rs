//! What recorded pushes say about what caused them.
//!
//! How far out an object rests, and how it rubs on the pusher. A grid of two
//! numbers, the *spread* of the support and the coefficient of friction of pusher and object, and for
//! every cell how far an effect model told these two ends from what was recorded: with a law of the noise that gives a posterior. It draws nothing and reads no files.

mod grid;
mod likelihood;
mod posterior;
mod run;

pub use grid::{Axis, Grid};
pub use likelihood::NoiseLaw;
pub use posterior::{Estimate, Posterior};
pub use run::{Fit, FitSettings, SupportError, fit};
