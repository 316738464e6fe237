//! The single loop over time: contacts, integration, graphs for the network.
//!
//! Training and planning share this loop, which rolls out many motions side by side. It only
//! processes bodies that a motion can reach, from the first contact until rest. The caller chooses
//! the motions, and the network that corrects the analytic model.

mod correction;
mod doubt;
mod integrate;
mod pair_means;
mod pressing;
mod reach;
mod reads;
mod roll;
mod run;
mod settings;
mod stepper;
mod work;

pub use correction::{Read, Reading};
pub use integrate::integrate;
pub use pair_means::PairMeans;
pub use reach::reachable;
pub use roll::{Roller, roll};
pub use settings::RollSettings;
pub use stepper::{Corrector, Found, Stepper, Walk};
pub use work::Work;
