//! Effect models that know no physics: what any model must beat to be worth its name.
//!
//! They use frames like every other model, but nothing of theirs moves unless the tool does, so
//! everything rests as soon as a stroke ends. Masses and frictions do not enter.

mod bodies;
mod follow;
mod named;
mod play;
mod projection;

pub use follow::Follow;
pub use named::{load, spec};
pub use projection::Projection;
