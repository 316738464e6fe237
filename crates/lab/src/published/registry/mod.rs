//! Every published table, by subject.

mod belief;
mod cost;
mod engines;
mod inputs;
mod levering;
mod planning;
mod prediction;

use super::table::Published;

/// Tables by subject, in the order in which they are measured.
pub(super) const SUBJECTS: [&[Published]; 6] = [
    prediction::TABLES,
    planning::TABLES,
    belief::TABLES,
    levering::TABLES,
    engines::TABLES,
    cost::TABLES,
];
