//! Cost of rollouts: the number of frames, and of frames that needed a graph.

use serde::{Deserialize, Serialize};

/// Numbers of frames, graphs and nodes of many rollouts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Number of rollouts.
    pub rollouts: u64,
    /// Number of frames in which the tool moves.
    pub moving: u64,
    /// Number of moving frames skipped because geometry alone excludes any change.
    pub skipped: u64,
    /// Number of frames in which the tool stands still while objects decelerate.
    pub coasting: u64,
    /// Number of frames with an awake object: one that is pushed, or moves near another body.
    pub graphs: u64,
    /// Number of nodes of all graphs.
    pub nodes: u64,
    /// Number of relations of all graphs.
    pub relations: u64,
    /// Number of lists of bodies that a stroke can set in motion.
    pub lists: u64,
    /// Number of objects on these lists.
    pub listed: u64,
}

impl Work {
    /// Adds the numbers of `other`.
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
