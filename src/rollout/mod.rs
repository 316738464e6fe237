//! The one loop over time: graph, network, integration, new contacts.
//!
//! Shared by training (single frames of episodes) and planning (whole motions): [`Stepper`] takes
//! both on, many side by side. Only what a motion can reach is looked at, and only from the first
//! contact until rest. The caller decides which network corrects the prior, and which motions to
//! try.

mod doubt;
mod integrate;
mod pair_means;
mod pressing;
mod reach;
mod roll;
mod run;
mod settings;
mod stepper;
mod work;

pub use integrate::integrate;
pub use pair_means::PairMeans;
pub use reach::reachable;
pub use roll::{Roller, roll};
pub use settings::RollSettings;
pub use stepper::{Corrector, Found, Stepper, Walk};
pub use work::Work;
