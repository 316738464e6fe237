//! Which pushes are worth a rollout from a given state: every grip, direction, contacting face
//! and coarse offset that can be placed.

use std::collections::HashSet;

use rayon::prelude::*;

use crate::scene::{Offsets, Push, Surface, Task, pair_friction};

use super::field::Field;
use super::scored::Scores;
use super::search::Node;
use super::statistics::SearchStatistics;
use super::{CandidatePush, Infeasible, Start, Workspace};

/// Two placements closer than this are one, metres.
const SAME_PLACE: f64 = 1e-4;

/// The most pushes of one node and grip that are considered: far more than tools have faces,
/// it only bounds what a file with thousands of directions or offsets can ask for.
const MOST_PER_GRIP: usize = 20_000;

/// A push that may continue a node of the search.
#[derive(Clone, Debug)]
pub(super) struct Extension {
    /// Index of the node.
    pub node: usize,
    /// Tool and grip yaw.
    pub pair: (usize, f64),
    /// The push, its length cut to what reach and obstacles allow.
    pub planned: CandidatePush,
    /// The same with its start.
    pub push: Push,
    /// Where its score is kept.
    pub scored: Option<usize>,
    /// Least cost left if the object were carried straight along: the order in which pushes are
    /// tried.
    pub promise: f64,
}

/// All pushes that can continue the given nodes; a node that has no grip yet takes every one of
/// `grips`. In the order of nodes, grips, directions, parts and offsets.
pub(super) fn extensions(
    workspace: &Workspace,
    field: &Field,
    nodes: &[Node],
    grips: &[(usize, f64)],
    offsets: usize,
    statistics: &mut SearchStatistics,
    scores: &mut Scores,
) -> Vec<Extension> {
    let work: Vec<(usize, (usize, f64))> = nodes
        .iter()
        .enumerate()
        .flat_map(|(k, node)| {
            let own = node.candidate.as_ref().map(|c| vec![(c.tool, c.grip_yaw)]);
            own.unwrap_or_else(|| grips.to_vec()).into_iter().map(move |pair| (k, pair))
        })
        .collect();
    let found: Vec<Vec<(CandidatePush, Result<Extension, Infeasible>)>> = work
        .par_iter()
        .map(|&(node, pair)| {
            let movers = field.movers(&nodes[node].state);
            // A thing can be pushed at any of its solids.
            let scene = &workspace.task.scene;
            let movers = movers.into_iter().flat_map(|k| [k].into_iter().chain(scene.parts_of(k)));
            let tried = |object| pushes(workspace, &nodes[node], (pair, object), offsets);
            movers
                .flat_map(tried)
                .map(|push| (push, extend(workspace, field, &nodes[node], node, pair, push)))
                .collect()
        })
        .collect();
    let mut kept = Vec::new();
    for ((_, pair), group) in work.into_iter().zip(found) {
        let first = scores.place(pair, group.iter().map(|(push, _)| *push));
        let mut places = HashSet::new();
        for (k, (_, result)) in group.into_iter().enumerate() {
            statistics.considered += 1;
            let scored = first.map(|first| first + k);
            match result {
                Err(reason) => {
                    statistics.refuse(reason);
                    scores.refuse(scored, reason);
                }
                Ok(extension) => {
                    let grid = |v: f64| (v / SAME_PLACE).round() as i64;
                    let push = &extension.push;
                    let place = (grid(push.start.x), grid(push.start.y), push.direction.to_bits());
                    if places.insert(place) {
                        kept.push(Extension { scored, ..extension });
                    } else {
                        statistics.repeated += 1;
                    }
                }
            }
        }
    }
    kept
}

/// The pushes of an object to try from a node, before anything is checked.
fn pushes(
    workspace: &Workspace,
    node: &Node,
    (pair, object): ((usize, f64), usize),
    count: usize,
) -> Vec<CandidatePush> {
    let rules = &workspace.task.pushes;
    let mut list = Vec::new();
    for direction in rules.directions.headings() {
        let mut add = |start| {
            if list.len() < MOST_PER_GRIP {
                let room = node.room;
                list.push(CandidatePush { object, start, direction, length: rules.length, room });
            }
        };
        if !workspace.is_placed() {
            add(Start::Chained);
            continue;
        }
        for part in 0..workspace.tools[pair.0].parts().len() {
            match &rules.offsets {
                Offsets::List(offsets) => {
                    offsets.iter().for_each(|&offset| add(Start::Placed { part, offset }));
                }
                Offsets::Effort => {
                    let span = workspace.offset_span(pair, (&node.state, object), part, direction);
                    for k in 0..count {
                        let share = (2 * k + 1) as f64 / count as f64 - 1.0;
                        // Ends included from two offsets on.
                        let share = share * count as f64 / (count.max(2) - 1) as f64;
                        add(Start::Placed { part, offset: share * span });
                    }
                }
            }
        }
    }
    list
}

fn extend(
    workspace: &Workspace,
    field: &Field,
    node: &Node,
    index: usize,
    pair: (usize, f64),
    mut planned: CandidatePush,
) -> Result<Extension, Infeasible> {
    let depth = node.candidate.as_ref().map_or(0, |c| c.pushes.len());
    let start = workspace.place(pair, &node.state, &planned, node.end)?;
    if workspace.is_placed() && topples(workspace, (pair.0, planned.object)) {
        return Err(Infeasible::Topples);
    }
    planned.length = workspace.free_travel(pair, start, planned.direction, planned.length)?;
    let push = Push {
        start,
        direction: planned.direction,
        length: planned.length,
        speed: workspace.task.pushes.speed,
    };
    let set_down = (workspace.is_placed() || depth == 0).then_some(planned.room);
    let pushed = (&node.state, planned.object);
    if let Some(reason) = workspace.margins(pair, pushed, &push, set_down).broken() {
        return Err(reason);
    }
    let promise = (0..=2)
        .map(|k| field.carried(pushed, push.heading() * (push.length * k as f64 / 2.0)))
        .fold(f64::INFINITY, f64::min);
    Ok(Extension { node: index, pair, planned, push, scored: None, promise })
}

/// Whether an object turns over rather than slide, in whatever direction the tool pushes it at its lowest:
/// the models that search are of the plane and cannot see it. With a force F at height z, friction m with
/// the table and t with the tool, and the farthest edge at d, moments about that edge hold the object down
/// while F z <= W d + 2 d t F, where F = m (W + t F): while m z <= d (1 + m t). What hangs together is left to
/// the 3-D engine.
fn topples(workspace: &Workspace, (tool, object): (usize, usize)) -> bool {
    let Task { scene, pushes, .. } = workspace.task;
    let one = &scene.objects[object];
    let joined = scene.joints.iter().any(|joint| joint.between.contains(&object))
        || scene.mounts.iter().any(|mount| mount.object == object);
    let friction =
        |with, value| pair_friction(&scene.frictions, object, with, [one.friction, value]);
    let table = friction(Surface::Table, scene.table_friction);
    let held = 1.0 + table * friction(Surface::Tool, workspace.tools[tool].friction);
    let edge = one.shape.footprint().bounding_radius();
    !joined && !one.may_fall && table * pushes.lift > edge * held
}

/// Cuts a list to the budget, keeping the most promising and the order; returns how many fell
/// away. Equal promise is broken by a fixed scatter, so that no tool is favoured for its place
/// in the list.
pub(super) fn keep_promising(list: &mut Vec<Extension>, budget: usize) -> usize {
    if list.len() <= budget {
        return 0;
    }
    /// The golden section: its multiples scatter evenly over [0, 1).
    const SCATTER: f64 = 0.618_033_988_749_894_9;
    let mut order: Vec<usize> = (0..list.len()).collect();
    let scatter = |k: usize| (k as f64 * SCATTER).fract();
    order.sort_by(|&a, &b| {
        let promise = list[a].promise.total_cmp(&list[b].promise);
        promise.then(scatter(a).total_cmp(&scatter(b))).then(a.cmp(&b))
    });
    order.truncate(budget);
    order.sort_unstable();
    let dropped = list.len() - budget;
    *list = order.into_iter().map(|k| list[k].clone()).collect();
    dropped
}
