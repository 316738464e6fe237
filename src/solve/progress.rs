//! What a planner is doing, for whoever waits.

use std::fmt;

/// A stage of solving.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Rolling out candidates.
    Search,
    /// Refining the best ones.
    Refine,
    /// Replaying plans in the simulator.
    Verify,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stage::Search => "search",
            Stage::Refine => "refine",
            Stage::Verify => "verify",
        })
    }
}

/// How far a stage has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The stage.
    pub stage: Stage,
    /// Pushes in the plans that are being looked at.
    pub pushes: usize,
    /// Steps done.
    pub done: usize,
    /// Steps of this stage.
    pub total: usize,
}
