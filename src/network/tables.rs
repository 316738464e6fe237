//! Graphs as flat feature tables, whatever they are graphs of.

use crate::graph::{
    Batch, NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD, RELATION_EVEN, RELATION_ODD,
};

/// Columns of the tables, each `[even, odd]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tables {
    /// Features of a node.
    pub node: [usize; 2],
    /// Features of a relation.
    pub relation: [usize; 2],
    /// What is read from a node after propagation.
    pub output: [usize; 2],
}

impl Tables {
    /// Those of pushes.
    pub const PUSHES: Self = Self {
        node: [NODE_EVEN, NODE_ODD],
        relation: [RELATION_EVEN, RELATION_ODD],
        output: [OUTPUT_EVEN, OUTPUT_ODD],
    };
}

/// Graphs side by side: N nodes, R relations.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// [N, even].
    pub node_even: &'a [f32],
    /// [N, odd].
    pub node_odd: &'a [f32],
    /// [R, even].
    pub relation_even: &'a [f32],
    /// [R, odd].
    pub relation_odd: &'a [f32],
    /// `[R]`, node index of every relation's receiver.
    pub receivers: &'a [u32],
    /// `[R]`, node index of every relation's sender, or [`crate::graph::KINEMATIC`].
    pub senders: &'a [u32],
}

impl<'a> From<&'a Batch> for Rows<'a> {
    fn from(batch: &'a Batch) -> Self {
        Self {
            node_even: &batch.node_even,
            node_odd: &batch.node_odd,
            relation_even: &batch.relation_even,
            relation_odd: &batch.relation_odd,
            receivers: &batch.receivers,
            senders: &batch.senders,
        }
    }
}
