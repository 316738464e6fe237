//! How much is learnt from pushes that were made to learn how objects are joined, by how they were
//! chosen.

mod pushes;
mod suite;
mod summary;

pub use suite::{Learnt, ProbeCase, ProbeRecord, ProbeSuite};
pub use summary::{ProbeSummary, summarise_probes};
