//! Many graphs side by side, as flat feature tables: what the network reads.

use crate::contact::PairId;
use crate::geometry::Vector;

use super::{
    features::{GIVEN_EVEN, NODE_EVEN, NODE_ODD, RELATION_EVEN, RELATION_ODD, given_features},
    given::Given,
    node::Node,
    relation::Relation,
};

/// From here on, sender indices are those of bodies whose motion is given.
pub const GIVEN: u32 = 1 << 31;

/// Sender index of a relation whose sender is no node of its graph.
pub const NOBODY: u32 = u32::MAX;

/// Feature tables of a batch of graphs. N nodes that move, K bodies whose motion is given, R relations.
///
/// *Even* features keep their sign when the scene is mirrored about the tool's line of motion,
/// *odd* ones change it; the network treats the two so that its output mirrors exactly.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// N nodes.
    pub nodes: Vec<Node>,
    /// [N, NODE_EVEN].
    pub node_even: Vec<f32>,
    /// [N, NODE_ODD].
    pub node_odd: Vec<f32>,
    /// [K, GIVEN_EVEN]; all parts of a tool are one row, see [`Given`].
    pub given_even: Vec<f32>,
    /// [K, GIVEN_ODD].
    pub given_odd: Vec<f32>,
    /// [R, RELATION_EVEN].
    pub relation_even: Vec<f32>,
    /// [R, RELATION_ODD].
    pub relation_odd: Vec<f32>,
    /// `[R]`, node index of every relation's receiver.
    pub receivers: Vec<u32>,
    /// `[R]`, node index of every relation's sender, or [`GIVEN`] and the row of a body whose motion is
    /// given.
    pub senders: Vec<u32>,
    /// `[R]`, which two bodies every relation is about: the same id in every frame of a scene
    /// with a tool, and for both directions.
    pub pairs: Vec<PairId>,
    /// Memory for those of one graph.
    pub(super) relations: Vec<Relation>,
    /// Rows of the tool and of the obstacles of one graph, where they have one.
    pub(super) rows: Vec<Option<u32>>,
}

impl Batch {
    /// Empties the tables but keeps their memory.
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
    }

    /// Number of nodes, N.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of bodies whose motion is given, K.
    pub fn given_count(&self) -> usize {
        self.given_even.len() / GIVEN_EVEN
    }

    /// Number of relations, R.
    pub fn relation_count(&self) -> usize {
        self.receivers.len()
    }

    pub(super) fn push_node(&mut self, node: Node, even: [f64; NODE_EVEN], odd: [f64; NODE_ODD]) {
        self.nodes.push(node);
        self.node_even.extend(even.map(bounded));
        self.node_odd.extend(odd.map(bounded));
    }

    /// Adds a body whose motion is given; returns its index as a sender.
    pub(super) fn push_given(&mut self, given: &Given, axis: Vector) -> u32 {
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

/// Features stay within what the network can have seen, so that an extreme scene cannot drive
/// it to infinity; an odd bound keeps the mirror symmetry.
fn bounded(value: f64) -> f32 {
    const BOUND: f64 = 20.0;
    value.clamp(-BOUND, BOUND) as f32
}
