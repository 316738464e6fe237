//! What recorded pushes say about what caused them.
//!
//! How far out an object rests, and how it rubs on the pusher. For every cell of a grid of two
//! numbers, the *spread* of the support and the coefficient of friction of pusher and object, it is
//! measured how far from the recording an effect model that is told them ends; with a model of the
//! noise, that gives a posterior. What those numbers leave a linear head on the network's last hidden
//! row can learn. It draws nothing and reads no files.

mod grid;
mod head;
mod likelihood;
mod posterior;
mod run;

pub use grid::{Axis, Grid};
pub use head::{Basis, HeadSettings, Sensitivity, learn};
pub use likelihood::NoiseLaw;
pub use posterior::{Estimate, Posterior};
pub use run::{AsStated, Fit, FitSettings, SupportError, fit};
