//! The one loop over time: graph, network, integration, new contacts.
//!
//! Shared by training (one frame at a time) and planning (whole motions, many side by side).
//! Which network corrects the prior is the caller's business, and so is which motions to try.

mod hold;
mod integrate;
mod roll;

pub use hold::hold;
pub use integrate::integrate;
pub use roll::{Corrector, RollSettings, apply, roll};
