//! From a state and a frame of tool motion to the nodes and relations of its graph.

use crate::{
    geometry::Vector,
    scene::{Body, FrameStep, State},
};

use super::{
    batch::{Batch, KINEMATIC, Touch},
    bodies::{Bodies, Motion},
    coast::coast,
    contact::{Contact, find_contacts},
    features::{node_features, relation_features},
    node::{Node, UNIT},
    prior::Prior,
    relation::{Relation, Tie, of_contact, of_joint},
};

/// Memory that building a graph reuses.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    contacts: Vec<Contact>,
    prior: Prior,
    awake: Vec<bool>,
    index: Vec<u32>,
    relations: Vec<Relation>,
}

/// Adds the graph of one frame to `batch` under the number `graph`, and fills `motions` with
/// what every object of the scene does if it is left alone. Those that the network decides
/// have a node; the others keep their entry in `motions`, which for them is exact.
///
/// `axis` is the unit vector of the tool's motion, the last one while it stands still.
pub fn add_graph(
    bodies: &Bodies,
    state: &State,
    step: &FrameStep,
    axis: Vector,
    graph: u32,
    batch: &mut Batch,
    motions: &mut Vec<Motion>,
) {
    motions.clear();
    motions.extend(
        bodies
            .objects
            .iter()
            .zip(&state.velocities)
            .map(|(body, velocity)| coast(body, velocity, step.duration)),
    );
    let mut scratch = std::mem::take(&mut batch.scratch);
    let Scratch { contacts, prior, awake, index, relations } = &mut scratch;
    find_contacts(bodies, state, step, motions, contacts);
    find_awake(bodies, contacts, motions, step, awake);
    if awake.contains(&true) {
        contacts.retain(|contact| awake[contact.object]);
        prior.solve(bodies, state, step, axis, motions, contacts);
        relations.clear();
        for (k, contact) in contacts.iter().enumerate() {
            relations.extend(
                of_contact(bodies, state, motions, prior, k, contact).into_iter().flatten(),
            );
        }
        for k in 0..bodies.joints.len() {
            if awake[bodies.joints[k].between[0]] {
                relations.extend(of_joint(bodies, state, motions, prior, k));
            }
        }
        index.clear();
        index.resize(bodies.objects.len(), KINEMATIC);
        for (object, body) in bodies.objects.iter().enumerate().filter(|(k, _)| awake[*k]) {
            index[object] = batch.node_count() as u32;
            let mut node = Node {
                graph,
                object: object as u32,
                axis,
                duration: step.duration,
                support: body.support,
                prior: [0.0; 6],
            };
            node.prior = node.encode(&prior.motions[object]);
            let pressed: f64 =
                relations.iter().filter(|r| r.receiver == object).map(overlap).sum::<f64>() / UNIT;
            let (even, odd) = node_features(&node, body, &motions[object], pressed);
            batch.push_node(node, even, odd);
        }
        for relation in relations.iter() {
            let receiver = index[relation.receiver];
            let sender = match relation.sender {
                Body::Object(sender) => index[sender],
                _ => KINEMATIC,
            };
            let (even, odd) = relation_features(&batch.nodes[receiver as usize], relation);
            batch.push_relation(receiver, sender, even, odd);
            if overlap(relation) > 0.0 {
                let (object, with) = (relation.receiver, relation.sender);
                batch.touches.push(Touch { graph, object, with });
            }
        }
    }
    batch.scratch = scratch;
}

fn overlap(relation: &Relation) -> f64 {
    match relation.tie {
        Tie::Contact { overlap, .. } => overlap,
        Tie::Joint { .. } => 0.0,
    }
}

/// Which objects may do anything but coast: those near a moving part, those that move near
/// anything or in a joint, and those in touch or jointed with such an object.
fn find_awake(
    bodies: &Bodies,
    contacts: &[Contact],
    coasts: &[Motion],
    step: &FrameStep,
    awake: &mut Vec<bool>,
) {
    let tool_moves = step.from != step.to;
    let moving = |object: usize| coasts[object] != Motion::default();
    awake.clear();
    awake.resize(coasts.len(), false);
    for contact in contacts {
        let pushed = matches!(contact.with, Body::Part(_)) && tool_moves;
        if pushed || moving(contact.object) {
            awake[contact.object] = true;
        }
        if let Body::Object(other) = contact.with
            && moving(other)
        {
            awake[other] = true;
        }
    }
    for joint in &bodies.joints {
        for object in joint.between {
            awake[object] |= moving(object);
        }
    }
    let contacts = contacts.iter().filter_map(|contact| match contact.with {
        Body::Object(other) => Some([contact.object, other]),
        _ => None,
    });
    let pairs: Vec<[usize; 2]> =
        contacts.chain(bodies.joints.iter().map(|joint| joint.between)).collect();
    loop {
        let mut changed = false;
        for &[a, b] in &pairs {
            if awake[a] != awake[b] {
                (awake[a], awake[b]) = (true, true);
                changed = true;
            }
        }
        if !changed {
            return;
        }
    }
}
