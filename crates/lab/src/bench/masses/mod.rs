//! Accuracy of masses estimated from pushes in which objects touch each other (Tekden 2020, section
//! 8.3).

mod suite;
mod summary;

pub use suite::{MassCase, MassRecord, MassSuite, SeenMass, SeenRatio};
pub use summary::{MassSummary, summarise_masses};
