//! Result of designing a tool.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pushplan::scene::Tool;

use pushplan::solve::{PlanStatus, Solution};

/// Proposed tool with its solution of the task.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// Proposed tool.
    pub tool: Arc<Tool>,
    /// Solution of the task with this tool only.
    pub solution: Solution,
}

/// Result of [`design`](crate::design).
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Solution of the task with the existing tools, regardless of its tool choice.
    pub known: Solution,
    /// Proposed tool; if no tool works, the nearest one.
    ///
    /// `None` if the existing tools solve the task and no candidate has more margin, or if no
    /// candidate can push at all.
    pub proposal: Option<Proposal>,
    /// Cost of the search.
    pub spent: Spent,
    /// Whether the search was cancelled.
    pub stopped: bool,
}

/// Cost of designing a tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spent {
    /// Number of screened tools.
    pub looked_at: usize,
    /// Number of rollouts of the screening model.
    pub rollouts: usize,
    /// Number of screened tools that were predicted to reach the goal.
    pub promising: usize,
    /// Number of tools with which the task was solved in full.
    pub solved: usize,
}

impl Design {
    /// Returns the status of the best solution, with the proposed tool or with the existing ones.
    pub fn status(&self) -> PlanStatus {
        self.best().status
    }

    /// Returns the solution with the proposed tool, or with the existing tools if none is proposed.
    pub fn best(&self) -> &Solution {
        self.proposal.as_ref().map_or(&self.known, |proposal| &proposal.solution)
    }
}
