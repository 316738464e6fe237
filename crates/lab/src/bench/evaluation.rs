//! What one part of an evaluation gives: all pushes of a kind, or all trajectories of a set.

use serde::{Deserialize, Serialize};

use super::crowd::CrowdReport;
use super::heldout::HeldOutReport;

/// Errors of several models on one part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Evaluated {
    /// On pushes of the shipped tools.
    Tools(HeldOutReport),
    /// On a set of crowds.
    Crowd(CrowdReport),
}

/// The reports of several parts by what they are on, each kind in order.
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
