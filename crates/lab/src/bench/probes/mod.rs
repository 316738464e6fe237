//! Information gained about joints from exploratory pushes, for each rule that chooses them.

mod pushes;
mod suite;
mod summary;

pub use suite::{Learnt, ProbeCase, ProbeRecord, ProbeSuite};
pub use summary::{ProbeSummary, summarise_probes};
