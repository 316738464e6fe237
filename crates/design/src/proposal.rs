//! Result of designing a tool.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pushplan::scene::Tool;

use pushplan::solve::{PlanStatus, Solution};

/// A tool with what it does for the task.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// The tool.
    pub tool: Arc<Tool>,
    /// The task solved with it alone.
    pub solution: Solution,
}

/// The result of [`design`](crate::design).
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The task solved with the tools that there are, whichever it names.
    pub known: Solution,
    /// The tool to make. `None` where those that there are solve the task and none was found that does so
    /// with more margin, or where no tool can push at all. Where no tool works it is the nearest.
    pub proposal: Option<Proposal>,
    /// Cost.
    pub spent: Spent,
    /// Whether it was stopped before it was over.
    pub stopped: bool,
}

/// Cost of designing a tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spent {
    /// Tools that were looked at.
    pub looked_at: usize,
    /// Rollouts of the model that screens for these.
    pub rollouts: usize,
    /// Number of these tools that were predicted to reach the goal.
    pub promising: usize,
    /// Tools with which the task was solved in full.
    pub solved: usize,
}

impl Design {
    /// How well the task can be solved: with the tool that is proposed, or with those that there are.
    pub fn status(&self) -> PlanStatus {
        self.best().status
    }

    /// The solution that [`Self::status`] speaks of.
    pub fn best(&self) -> &Solution {
        self.proposal.as_ref().map_or(&self.known, |proposal| &proposal.solution)
    }
}
