//! The one loop over time: graph, network, integration, new contacts.
//!
//! Shared by training (one frame at a time) and planning (whole motions, many side by side).
//! Only what a motion can reach is looked at, and only from the first contact until rest.
//! Which network corrects the prior is the caller's business, and so is which motions to try.

mod doubt;
mod hold;
mod integrate;
mod pressing;
mod reach;
mod roll;
mod run;
mod work;

pub use hold::hold;
pub use integrate::integrate;
pub use reach::reachable;
pub use roll::{Corrector, RollSettings, Roller, apply, roll};
pub use work::Work;
