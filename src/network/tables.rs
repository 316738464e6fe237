//! Flat feature tables of graphs of any kind.

use crate::graph::{
    Batch, GIVEN, GIVEN_EVEN, GIVEN_ODD, NOBODY, NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD,
    RELATION_EVEN, RELATION_ODD,
};

/// Numbers of table columns, each `[even, odd]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tables {
    /// Features of a node.
    pub node: [usize; 2],
    /// Features of a body with prescribed motion; zero if there are none.
    pub given: [usize; 2],
    /// Features of a relation.
    pub relation: [usize; 2],
    /// Outputs of a node after propagation.
    pub output: [usize; 2],
}

impl Tables {
    /// Column numbers of the graphs of pushes.
    pub const PUSHES: Self = Self {
        node: [NODE_EVEN, NODE_ODD],
        given: [GIVEN_EVEN, GIVEN_ODD],
        relation: [RELATION_EVEN, RELATION_ODD],
        output: [OUTPUT_EVEN, OUTPUT_ODD],
    };
}

/// Tables of several graphs: N nodes, K bodies with prescribed motion, R relations.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// Even node features, [N, even].
    pub node_even: &'a [f32],
    /// Odd node features, [N, odd].
    pub node_odd: &'a [f32],
    /// Even features of bodies with prescribed motion, [K, even].
    pub given_even: &'a [f32],
    /// Odd features of bodies with prescribed motion, [K, odd].
    pub given_odd: &'a [f32],
    /// Even relation features, [R, even].
    pub relation_even: &'a [f32],
    /// Odd relation features, [R, odd].
    pub relation_odd: &'a [f32],
    /// Receiver of every relation as a node index, `[R]`.
    pub receivers: &'a [u32],
    /// Sender of every relation, `[R]`: a node index, [`crate::graph::GIVEN`] plus the row of a
    /// body with prescribed motion, or [`crate::graph::NOBODY`].
    pub senders: &'a [u32],
}

impl Rows<'_> {
    /// Fills `senders` with row numbers of a table in which bodies with prescribed motion follow
    /// `nodes` nodes. [`crate::graph::NOBODY`] stays past its end.
    pub fn senders_after(&self, nodes: usize, senders: &mut Vec<u32>) {
        senders.clear();
        senders.extend(self.senders.iter().map(|&sender| match sender {
            NOBODY => NOBODY,
            given if given >= GIVEN => nodes as u32 + (given - GIVEN),
            node => node,
        }));
    }
}

impl<'a> From<&'a Batch> for Rows<'a> {
    fn from(batch: &'a Batch) -> Self {
        Self {
            node_even: &batch.node_even,
            node_odd: &batch.node_odd,
            given_even: &batch.given_even,
            given_odd: &batch.given_odd,
            relation_even: &batch.relation_even,
            relation_odd: &batch.relation_odd,
            receivers: &batch.receivers,
            senders: &batch.senders,
        }
    }
}
