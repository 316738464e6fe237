//! Information gained about joints from exploratory pushes, by the rule of their choice.

mod pushes;
mod suite;
mod summary;

pub use suite::{Learnt, ProbeCase, ProbeRecord, ProbeSuite};
pub use summary::{ProbeSummary, summarise_probes};
