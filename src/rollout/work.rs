//! What rollouts took: how many frames, and how many of them needed a graph.

use serde::{Deserialize, Serialize};

/// Frames, graphs and nodes of many rollouts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Rollouts.
    pub rollouts: u64,
    /// Frames in which the tool moves.
    pub moving: u64,
    /// Those of them that geometry alone showed to change nothing.
    pub skipped: u64,
    /// Frames in which the tool stands still and objects come to rest.
    pub coasting: u64,
    /// Frames with a graph, or only its prior: something is pushed, or moves near something else.
    pub graphs: u64,
    /// Objects in all of them.
    pub nodes: u64,
    /// Relations of all graphs.
    pub relations: u64,
    /// Lists made of what a stroke can set in motion.
    pub lists: u64,
    /// Objects on those lists.
    pub listed: u64,
}

impl Work {
    /// Adds another's numbers.
    pub fn add(&mut self, other: &Work) {
        self.rollouts += other.rollouts;
        self.moving += other.moving;
        self.skipped += other.skipped;
        self.coasting += other.coasting;
        self.graphs += other.graphs;
        self.nodes += other.nodes;
        self.relations += other.relations;
        self.lists += other.lists;
        self.listed += other.listed;
    }
}
