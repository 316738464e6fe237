//! Graphs of levered bodies side by side, in the form that the network reads.

use pushplan::internals::graph::NOBODY;
use pushplan::internals::network::Rows;

use super::card::PARTS;

/// Columns of nodes and of relations.
pub(super) const NODE: [usize; 2] = PARTS.node;
pub(super) const RELATION: [usize; 2] = PARTS.relation;

/// Feature tables of N nodes and R relations; even and odd features under a mirror are separate.
#[derive(Clone, Debug, Default)]
pub struct PartGraphs {
    node_even: Vec<f32>,
    node_odd: Vec<f32>,
    relation_even: Vec<f32>,
    relation_odd: Vec<f32>,
    receivers: Vec<u32>,
    senders: Vec<u32>,
    firsts: Vec<u32>,
}

impl PartGraphs {
    /// Empties the tables but keeps their memory.
    pub fn clear(&mut self) {
        let Self { node_even, node_odd, relation_even, relation_odd, .. } = self;
        for table in [node_even, node_odd, relation_even, relation_odd] {
            table.clear();
        }
        for list in [&mut self.receivers, &mut self.senders, &mut self.firsts] {
            list.clear();
        }
    }

    /// Returns the tables in the form that the network reads.
    pub fn rows(&self) -> Rows<'_> {
        Rows {
            node_even: &self.node_even,
            node_odd: &self.node_odd,
            given_even: &[],
            given_odd: &[],
            relation_even: &self.relation_even,
            relation_odd: &self.relation_odd,
            receivers: &self.receivers,
            senders: &self.senders,
        }
    }

    /// Returns the node of every graph from which the motion of the body is read.
    pub fn firsts(&self) -> &[u32] {
        &self.firsts
    }

    /// Begins a graph; its nodes are counted from its first one.
    pub(super) fn begin(&mut self) {
        self.firsts.push(self.nodes());
    }

    pub(super) fn node(&mut self, even: [f64; NODE[0]], odd: [f64; NODE[1]]) {
        self.node_even.extend(even.map(bounded));
        self.node_odd.extend(odd.map(bounded));
    }

    /// Adds a relation within the graph. A relation without a sender comes from a body that is not
    /// a node.
    pub(super) fn relation(
        &mut self,
        (receiver, sender): (usize, Option<usize>),
        even: [f64; RELATION[0]],
        odd: [f64; RELATION[1]],
    ) {
        let first = self.firsts.last().copied().unwrap_or(0);
        self.receivers.push(first + receiver as u32);
        self.senders.push(sender.map_or(NOBODY, |sender| first + sender as u32));
        self.relation_even.extend(even.map(bounded));
        self.relation_odd.extend(odd.map(bounded));
    }

    fn nodes(&self) -> u32 {
        (self.node_even.len() / NODE[0]) as u32
    }
}

/// Clamps a feature to the range of training, so that no scene drives the network to infinity.
fn bounded(value: f64) -> f32 {
    const BOUND: f64 = 20.0;
    value.clamp(-BOUND, BOUND) as f32
}
