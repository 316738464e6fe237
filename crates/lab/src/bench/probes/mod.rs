//! How much pushes tell that were made to learn how objects hang together, by how they were chosen.

mod pushes;
mod suite;
mod summary;

pub use suite::{Learnt, ProbeCase, ProbeRecord, ProbeSuite};
pub use summary::{ProbeSummary, summarise_probes};
