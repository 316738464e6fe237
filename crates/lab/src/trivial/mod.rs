//! Baseline effect models without physics, which any useful model must beat.
//!
//! They use frames like every other model, but objects move only when the tool does, so everything
//! rests as soon as a stroke ends. Masses and frictions have no effect.

mod bodies;
mod follow;
mod named;
mod play;
mod projection;

pub use follow::Follow;
pub use named::{load, spec};
pub use projection::Projection;
