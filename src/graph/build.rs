//! Conversion of a solved frame into the nodes and relations of its graph.

use crate::contact::{AwakeIndex, FrameForces, FrameSolution, Partner};
use crate::geometry::{Vector, cross};

use super::{
    batch::Batch,
    features::{Underside, node_features, relation_features},
    node::{Node, UNIT},
    prescribed::PrescribedNode,
    relation::{Relation, RelationKind, add_contact, add_joint},
};

impl Batch {
    /// Adds the graph of a solved frame under the number `graph`: a node for every object that is
    /// awake, and their relations. Returns the number of nodes.
    pub fn add(&mut self, graph: u32, frame: &FrameSolution, forces: &FrameForces) -> usize {
        let before = self.node_count();
        let mut relations = std::mem::take(&mut self.relations);
        relations.clear();
        for (index, contact) in frame.contacts.iter().enumerate() {
            add_contact(frame, forces, index, contact, &mut relations);
        }
        for index in 0..frame.bodies.joints.len() {
            add_joint(frame, forces, index, &mut relations);
        }
        for (object, body) in frame.bodies.objects.iter().enumerate() {
            let mut node = Node {
                graph,
                object: frame.listed(AwakeIndex(object)),
                axis: frame.axis,
                duration: frame.step.duration,
                support: body.support,
                prior: [0.0; 6],
            };
            node.prior = node.encode(&frame.motions[object]);
            let pressed: f64 =
                relations.iter().filter(|r| r.receiver == object).map(overlap).sum::<f64>() / UNIT;
            let (sin, cos) = frame.state.poses[object].heading.sin_cos();
            let along = Vector::new(cos, sin);
            let underside = Underside {
                feet: frame.bodies.feet(object),
                turn: Vector::new(along.dot(&node.axis), cross(node.axis, along)),
                push_height_known: frame.bodies.push_height_known,
                supports_known: frame.bodies.supports_known,
            };
            let coast = &frame.coasts[object];
            let (even, odd) = node_features(&node, body, &underside, coast, pressed);
            self.push_node(node, even, odd);
        }
        self.rows.clear();
        self.rows.resize(1 + frame.bodies.obstacles.len(), None);
        for relation in &relations {
            let receiver = before + relation.receiver;
            let sender = match relation.sender {
                Partner::Object(k) => (before + k) as u32,
                Partner::Part(k) => {
                    let part = &frame.bodies.parts[k];
                    self.given(0, frame, |frame| PrescribedNode::part(frame, part))
                }
                Partner::Obstacle(k) => {
                    let obstacle = &frame.bodies.obstacles[k];
                    self.given(1 + k, frame, |frame| PrescribedNode::obstacle(frame, obstacle))
                }
            };
            let (even, odd) = relation_features(&self.nodes[receiver], relation);
            self.push_relation(receiver as u32, sender, relation.pair, even, odd);
        }
        self.relations = relations;
        self.graphs += usize::from(self.node_count() > before);
        self.node_count() - before
    }

    /// Returns the sender index of a body with prescribed motion, and adds the body if it is
    /// missing.
    fn given(
        &mut self,
        place: usize,
        frame: &FrameSolution,
        body: impl FnOnce(&FrameSolution) -> PrescribedNode,
    ) -> u32 {
        match self.rows[place] {
            Some(sender) => sender,
            None => {
                let sender = self.push_given(&body(frame), frame.axis);
                *self.rows[place].insert(sender)
            }
        }
    }
}

fn overlap(relation: &Relation) -> f64 {
    match relation.kind {
        RelationKind::Contact { overlap, .. } => overlap,
        RelationKind::Joint { .. } => 0.0,
    }
}
