//! Tools as subgraphs: every part is a node, fixed joints connect the nodes, and the decomposition
//! into parts does not affect results.

use std::sync::Arc;

use pushplan::asset::ToolLibrary;
use pushplan::contact::Bodies;
use pushplan::effect::{EffectModel, EffectModels, Network, Prior};
use pushplan::geometry::{AreaMoments, Pose, Shape, Vector};
use pushplan::graph::{Batch, Corrections, GIVEN};
use pushplan::network::{Buffers, Forward};
use pushplan::{
    outcome::Record,
    scene::{Object, Obstacle, Part, Physics, Scene, State, Tool},
    task::{Job, Stroke, ToolMotion},
};
use pushplan_report::{Graph, NodeKind, RelationName};
use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::random_network::{batch, stroke, weights};

/// Maximum effect of another decomposition of the same tool over 20 cm: metres, radians.
const SAME: (f64, f64) = (1e-4, 1.745e-3);

/// Returns the tool with one of its cuboids cut in two, and its parts in another order.
fn cut(tool: &Tool, random: &mut Pcg64) -> Tool {
    let mut parts = tool.parts().to_vec();
    let which = random.random_range(0..parts.len());
    if let Shape::Cuboid { size } = parts[which].shape {
        let axis = random.random_range(0..2);
        let share = random.random_range(0.15..0.85);
        let half = |from: f64, to: f64, name: &str| {
            let (mut own, mut at) = (size, Vector::zeros());
            own[axis] = (to - from) * size[axis];
            at[axis] = ((from + to) / 2.0 - 0.5) * size[axis];
            let pose = parts[which].pose * Pose { position: at, heading: 0.0 };
            Part::cuboid(format!("{}-{name}", parts[which].name), own, pose)
        };
        let halves = [half(0.0, share, "a"), half(share, 1.0, "b")];
        parts.splice(which..=which, halves);
    }
    parts.shuffle(random);
    tool.clone().with_parts(parts).expect("one piece")
}

/// Returns a push of 20 cm by the tool that begins beside its middle, sometimes with an
/// obstruction.
fn push(tool: &Tool, random: &mut Pcg64) -> (Scene, Stroke) {
    let size = [random.random_range(0.04..0.1), random.random_range(0.04..0.1), 0.08];
    let way = random.random_range(-3.1..3.1f64);
    let along = Vector::new(way.cos(), way.sin());
    let from = Pose::new(0.1, 0.05, random.random_range(-3.1..3.1));
    let ahead = tool.outline().iter().map(|piece| {
        let pose = from * piece.pose;
        pose.position.dot(&along) + piece.footprint().extent(pose.local_vector(along))
    });
    let front = ahead.fold(f64::NEG_INFINITY, f64::max);
    let middle = from * tool.outline()[0].pose;
    let aside = Vector::new(-along.y, along.x);
    let off = random.random_range(-0.06..0.06);
    let at = along * (front + 0.075) + aside * (middle.position.dot(&aside) + off);
    let object =
        Object::cuboid("box", size).at(at.x, at.y, random.random_range(-3.1..3.1)).friction(0.4);
    let beyond = at + along * 0.15 + aside * 0.05;
    let wall = Obstacle::cuboid("wall", [0.05, 0.05, 0.1]).at(beyond.x, beyond.y, way);
    let scene = Scene::new([object]).on_table(0.5);
    let scene = if random.random_bool(0.3) { scene.with_obstacle(wall) } else { scene };
    let turn = if random.random_bool(0.3) { random.random_range(-0.5..0.5) } else { 0.0 };
    let to = Pose { position: from.position + 0.2 * along, heading: from.heading + turn };
    (scene, Stroke { from, to, duration: 2.0, settle: true })
}

fn end(model: &dyn EffectModel, scene: &Scene, tool: Tool, stroke: Stroke) -> State {
    let motion = ToolMotion { tool: Arc::new(tool), lift: 0.002, strokes: vec![stroke] };
    model.rollout(scene, &[Job::stated(scene, motion)], Record::Outcome)[0].outcome().clone()
}

#[test]
fn how_a_tool_is_cut_into_parts_and_in_which_order_changes_nothing() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let shipped = Network::new(EffectModels::weights().expect("the shipped weights"));
    let random = Network::new(weights(64));
    let models: [&dyn EffectModel; 3] = [&shipped, &random, &Prior::default()];
    let mut moved = 0;
    for seed in 0..1000 {
        let mut random = Pcg64::seed_from_u64(seed);
        let tools: Vec<_> = library.iter().filter(|tool| tool.pushes()).collect();
        let tool = Tool::clone(tools[seed as usize % tools.len()]);
        let (scene, stroke) = push(&tool, &mut random);
        let other = cut(&tool, &mut random);
        for model in models {
            let one = end(model, &scene, tool.clone(), stroke).poses[0];
            let two = end(model, &scene, other.clone(), stroke).poses[0];
            let apart = (one.position - two.position).norm();
            let turned = (one.heading - two.heading).abs();
            assert!(apart < SAME.0 && turned < SAME.1, "{seed} {}: {apart} m, {turned}", tool.name);
            moved += usize::from((one.position - scene.objects[0].pose.position).norm() > 0.01);
        }
    }
    assert!(moved > 1500, "{moved}");
}

#[test]
fn touching_obstacles_are_one_body_however_they_are_cut() {
    let pose = Pose::new(0.3, 0.1, 0.7);
    let wall = |name: &str, length: f64, along: f64| {
        let pose = pose * Pose::new(along, 0.0, 0.0);
        Obstacle { pose, ..Obstacle::cuboid(name, [length, 0.05, 0.1]) }
    };
    let box_ahead = || Object::cuboid("box", [0.05, 0.05, 0.1]).at(0.0, 0.0, 0.0);
    let state = |walls: Vec<Obstacle>| {
        let scene = walls.into_iter().fold(Scene::new([box_ahead()]), Scene::with_obstacle);
        let physics = Physics::stated(&scene);
        let bodies = Bodies::new(&scene, &crate::random_network::tool(), 0.002, &physics);
        bodies.obstacles.iter().map(|one| one.body).collect::<Vec<_>>()
    };
    let whole = state(vec![wall("wall", 0.3, 0.0)]);
    let cut = state(vec![wall("a", 0.1, -0.1), wall("b", 0.2, 0.05)]);
    let apart = state(vec![wall("a", 0.1, -0.11), wall("b", 0.2, 0.05)]);
    let numbers = |one: &AreaMoments| {
        [one.area, one.first.x, one.first.y, one.second[0], one.second[1], one.second[2]]
    };
    for part in &cut {
        for (a, b) in numbers(part).iter().zip(numbers(&whole[0])) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
    assert!(apart[0].area < 0.5 * whole[0].area, "a gap separates them");
}

#[test]
fn parts_with_separate_rows_are_equal_to_the_bit() {
    // The graph has a row for every part; the computation uses one row for all.
    let weights = weights(64);
    // Two boxes before one part.
    let cuboid = |name: &str, y| Object::cuboid(name, [0.05, 0.05, 0.1]).at(0.046, y, 0.1);
    let scene = Scene::new([cuboid("left", 0.055), cuboid("right", -0.01)]);
    let whole = batch(&scene, &scene.start(), &stroke());
    let mut apart = whole.clone();
    apart.given_even.clear();
    apart.given_odd.clear();
    for (relation, &sender) in whole.senders.iter().enumerate().filter(|(_, s)| **s >= GIVEN) {
        let row = (sender - GIVEN) as usize;
        apart.senders[relation] = GIVEN + apart.given_count() as u32;
        let columns = [&whole.given_even, &whole.given_odd].map(|t| t.len() / whole.given_count());
        apart.given_even.extend_from_slice(&whole.given_even[row * columns[0]..][..columns[0]]);
        apart.given_odd.extend_from_slice(&whole.given_odd[row * columns[1]..][..columns[1]]);
    }
    assert!(apart.given_count() > whole.given_count() && whole.given_count() > 0);
    let forward = Forward::new(&weights);
    let run = |batch: &Batch| {
        let mut corrections = Corrections::default();
        forward.run(batch, &mut Buffers::default(), &mut corrections);
        corrections.nodes
    };
    assert_eq!(run(&whole), run(&apart));

    // The inputs also have an effect.
    let mut silent = whole.clone();
    silent.given_even.iter_mut().for_each(|value| *value = 0.0);
    assert_ne!(run(&whole), run(&silent));
}

#[test]
fn the_graph_of_a_moment_names_parts_obstacles_and_what_relates_them() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let tool = library.iter().find(|tool| tool.parts().len() > 1).expect("a tool of parts");
    let (scene, stroke) = (0..)
        .map(|seed| push(tool, &mut Pcg64::seed_from_u64(seed)))
        .find(|(scene, _)| !scene.obstacles.is_empty())
        .expect("one with an obstacle");
    let motion = ToolMotion { tool: Arc::clone(tool), lift: 0.002, strokes: vec![stroke] };
    let job = Job::stated(&scene, motion);
    let trajectory =
        Prior::default().rollout(&scene, std::slice::from_ref(&job), Record::Frames).remove(0);
    let graphs: Vec<Graph> =
        (0..).map_while(|frame| Graph::at(&scene, &job, &trajectory, frame)).collect();
    assert_eq!(graphs.len(), trajectory.frames.len() - 1);
    for graph in &graphs {
        let kinds: Vec<NodeKind> = graph.nodes.iter().map(|node| node.kind).collect();
        let parts = tool.parts().len();
        assert_eq!(kinds[0], NodeKind::Object);
        assert!(kinds[1..=parts].iter().all(|kind| *kind == NodeKind::Part));
        assert_eq!(kinds[parts + 1..], [NodeKind::Obstacle]);
        let fixed = graph.relations.iter().filter(|r| r.kind == RelationName::Fixed);
        assert_eq!(fixed.count(), 2 * tool.joints().len());
        for relation in graph.relations.iter().filter(|r| r.kind == RelationName::Contact) {
            assert_eq!(graph.nodes[relation.receiver].kind, NodeKind::Object);
        }
    }
    let pushed = |graph: &&Graph| {
        let contact = graph.relations.iter().find(|r| r.kind == RelationName::Contact);
        contact.is_some_and(|r| graph.nodes[r.sender].kind == NodeKind::Part)
    };
    let touching = graphs.iter().find(pushed).expect("a push that touches");
    // The end effector moves all parts equally.
    let shift = touching.nodes[1].shift;
    assert!((shift.norm() - 0.01).abs() < 1e-9 || stroke.to.heading != stroke.from.heading);
}
