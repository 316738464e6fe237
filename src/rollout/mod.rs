//! The single loop over time: graph, network, integration, new contacts.
//!
//! Training (single frames of episodes) and planning (whole motions) share this loop: [`Stepper`]
//! advances both, many side by side. It only processes bodies that a motion can reach, from the
//! first contact until rest. The caller chooses the motions, and the network that corrects the
//! analytic model.

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
