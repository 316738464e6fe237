//! Feature tables of many graphs side by side: the network's input.

use crate::contact::PairId;
use crate::geometry::Vector;

use super::{
    features::{GIVEN_EVEN, NODE_EVEN, NODE_ODD, RELATION_EVEN, RELATION_ODD, given_features},
    node::Node,
    prescribed::PrescribedNode,
    relation::Relation,
};

/// First sender index of bodies with prescribed motion.
pub const GIVEN: u32 = 1 << 31;

/// Sender index of a relation whose sender is not a node of its graph.
pub const NOBODY: u32 = u32::MAX;

/// Feature tables of a batch of graphs: N nodes that move, K bodies with prescribed motion, R
/// relations.
///
/// *Even* features keep their sign when the scene is mirrored about the tool's line of motion, and
/// *odd* features change it. The network treats them separately, so that its output mirrors
/// exactly.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Nodes, N.
    pub nodes: Vec<Node>,
    /// Even node features, [N, NODE_EVEN].
    pub node_even: Vec<f32>,
    /// Odd node features, [N, NODE_ODD].
    pub node_odd: Vec<f32>,
    /// Even features of bodies with prescribed motion, [K, GIVEN_EVEN]; the parts of a tool share
    /// one row, see [`PrescribedNode`].
    pub given_even: Vec<f32>,
    /// Odd features of bodies with prescribed motion, [K, GIVEN_ODD].
    pub given_odd: Vec<f32>,
    /// Even relation features, [R, RELATION_EVEN].
    pub relation_even: Vec<f32>,
    /// Odd relation features, [R, RELATION_ODD].
    pub relation_odd: Vec<f32>,
    /// Receiver of every relation as a node index, `[R]`.
    pub receivers: Vec<u32>,
    /// Sender of every relation, `[R]`: a node index, or [`GIVEN`] plus the row of a body with
    /// prescribed motion.
    pub senders: Vec<u32>,
    /// Body pair of every relation, `[R]`. Its id is constant over the frames of a scene with a
    /// tool, and equal for both directions.
    pub pairs: Vec<PairId>,
    /// Number of graphs.
    pub graphs: usize,
    /// Scratch memory for the relations of one graph.
    pub(super) relations: Vec<Relation>,
    /// Rows of the tool and of the obstacles of one graph, where already added.
    pub(super) rows: Vec<Option<u32>>,
}

impl Batch {
    /// Clears the tables but keeps their memory.
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.node_even.clear();
        self.node_odd.clear();
        self.given_even.clear();
        self.given_odd.clear();
        self.relation_even.clear();
        self.relation_odd.clear();
        self.receivers.clear();
        self.senders.clear();
        self.pairs.clear();
        self.graphs = 0;
    }

    /// Returns the number of nodes, N.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the number of bodies with prescribed motion, K.
    pub fn given_count(&self) -> usize {
        self.given_even.len() / GIVEN_EVEN
    }

    /// Returns the number of relations, R.
    pub fn relation_count(&self) -> usize {
        self.receivers.len()
    }

    pub(super) fn push_node(&mut self, node: Node, even: [f64; NODE_EVEN], odd: [f64; NODE_ODD]) {
        self.nodes.push(node);
        self.node_even.extend(even.map(bounded));
        self.node_odd.extend(odd.map(bounded));
    }

    /// Adds a body with prescribed motion; returns its sender index.
    pub(super) fn push_given(&mut self, given: &PrescribedNode, axis: Vector) -> u32 {
        let row = (self.given_even.len() / GIVEN_EVEN) as u32;
        let (even, odd) = given_features(given, axis);
        self.given_even.extend(even.map(bounded));
        self.given_odd.extend(odd.map(bounded));
        GIVEN | row
    }

    pub(super) fn push_relation(
        &mut self,
        receiver: u32,
        sender: u32,
        pair: PairId,
        even: [f64; RELATION_EVEN],
        odd: [f64; RELATION_ODD],
    ) {
        self.receivers.push(receiver);
        self.senders.push(sender);
        self.pairs.push(pair);
        self.relation_even.extend(even.map(bounded));
        self.relation_odd.extend(odd.map(bounded));
    }
}

/// Clamps a feature to the range that the network can have seen, so that an extreme scene cannot
/// drive its output to infinity. An odd bound keeps the mirror symmetry.
fn bounded(value: f64) -> f32 {
    const BOUND: f64 = 20.0;
    value.clamp(-BOUND, BOUND) as f32
}
