//! From a state and a frame of tool motion to the nodes and relations of its graph.

use crate::{
    geometry::Vector,
    scene::{Body, FrameStep, State},
};

use super::{
    batch::{Batch, KINEMATIC, Touch},
    bodies::{Bodies, Motion},
    coast::coast,
    features::{node_features, relation_features},
    link::{Link, find_links},
    node::{Node, UNIT},
    prior::quasi_statics,
};

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
    let mut links = find_links(bodies, state, step, motions);
    if links.is_empty() {
        return;
    }
    let awake = awake(&links, motions, step);
    if !awake.contains(&true) {
        return;
    }
    links.retain(|link| awake[link.receiver]);
    let priors = quasi_statics(bodies, &mut links, motions, step.duration);

    let first = batch.node_count() as u32;
    let mut index = vec![KINEMATIC; bodies.objects.len()];
    let mut count = 0;
    for (object, body) in bodies.objects.iter().enumerate() {
        if !awake[object] {
            continue;
        }
        index[object] = first + count;
        count += 1;
        let mut node = Node {
            graph,
            object: object as u32,
            axis,
            duration: step.duration,
            support: body.support,
            prior: [0.0; 6],
        };
        node.prior = node.encode(&priors[object]);
        let pressed: f64 =
            links.iter().filter(|l| l.receiver == object).map(|l| l.overlap).sum::<f64>() / UNIT;
        let (even, odd) = node_features(&node, body, &motions[object], pressed);
        batch.push_node(node, even, odd);
    }
    for link in &links {
        let receiver = index[link.receiver];
        let sender = match link.sender {
            Body::Object(sender) => index[sender],
            _ => KINEMATIC,
        };
        let (even, odd) = relation_features(&batch.nodes[receiver as usize], link);
        batch.push_relation(receiver, sender, even, odd);
        if link.overlap > 0.0 {
            batch.touches.push(Touch { graph, object: link.receiver, with: link.sender });
        }
    }
}

/// Which objects may do anything but coast: those near a moving part, those that move near
/// anything, and those related to such an object.
fn awake(links: &[Link], coasts: &[Motion], step: &FrameStep) -> Vec<bool> {
    let tool_moves = step.from != step.to;
    let moving = |object: usize| coasts[object] != Motion::default();
    let mut awake = vec![false; coasts.len()];
    for link in links {
        let pushed = matches!(link.sender, Body::Part(_)) && tool_moves;
        if pushed || moving(link.receiver) {
            awake[link.receiver] = true;
        }
    }
    loop {
        let mut changed = false;
        for link in links {
            if let Body::Object(sender) = link.sender
                && awake[sender]
                && !awake[link.receiver]
            {
                awake[link.receiver] = true;
                changed = true;
            }
        }
        if !changed {
            return awake;
        }
    }
}
