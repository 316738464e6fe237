//! The result of a part of an evaluation: all pushes of a kind, or all trajectories of a set.

use serde::{Deserialize, Serialize};

use super::crowd::CrowdReport;
use super::heldout::HeldOutReport;

/// Errors of several models on a part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Evaluated {
    /// Errors on pushes of the shipped tools.
    Tools(HeldOutReport),
    /// Errors on a set of crowds.
    Crowd(CrowdReport),
}

/// Sorts the reports of several parts by kind, each kind in order.
pub fn by_kind<'a>(
    parts: impl IntoIterator<Item = &'a Evaluated>,
) -> (Vec<HeldOutReport>, Vec<CrowdReport>) {
    let (mut tools, mut crowds) = (Vec::new(), Vec::new());
    for part in parts {
        match part {
            Evaluated::Tools(report) => tools.push(report.clone()),
            Evaluated::Crowd(report) => crowds.push(report.clone()),
        }
    }
    (tools, crowds)
}
