//! Parameters of a table, estimated from recorded pushes.
//!
//! The parameters are the *spread* of the support and the friction coefficient between pusher and
//! object. For every cell of a grid over both, an effect model with these values is rolled out and
//! compared with the recordings. A noise model turns the errors into a posterior. A linear head on
//! the network's propagated states can be fitted to the remaining error. This module draws nothing
//! and reads no files.

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
