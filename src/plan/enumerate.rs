//! Enumeration of the pushes worth a rollout from a state: every grip, direction, contacting face
//! and coarse offset that can be placed.

use std::collections::HashSet;

use rayon::prelude::*;

use crate::{
    scene::{Surface, pair_friction},
    task::{Offsets, Push, Task},
};

use super::cost_to_go::CostToGo;
use super::fine_offsets::between;
use super::node::Node;
use super::reached::Reached;
use super::scored::Scores;
use super::statistics::SearchStatistics;
use super::{CandidatePush, Infeasible, Start, Workspace};

/// Distance below which two placements count as one, metres.
const SAME_PLACE: f64 = 1e-4;

/// Maximum number of pushes considered for one node and grip. It far exceeds the number of faces of
/// tools and only bounds files with thousands of directions or offsets.
const MOST_PER_GRIP: usize = 20_000;

/// Grips of a search.
#[derive(Clone, Debug)]
pub(super) struct Grips {
    /// Pairs of a tool index and a grip yaw.
    pub all: Vec<(usize, f64)>,
    /// Maximum number of tool changes if the grip may change before every push; `None` for a fixed
    /// grip.
    pub changes: Option<usize>,
}

impl Grips {
    /// Returns the grips with changes allowed before every push; `None` if the task does not permit
    /// any change.
    pub fn changing(&self, workspace: &Workspace) -> Option<Self> {
        let (task, changes) = (workspace.task, workspace.task.tool_changes());
        let others = if changes > 0 { self.all.len() } else { task.pushes.grip_yaws.len() };
        let any = others > 1 && workspace.is_placed() && task.pushes.max_count > 1;
        any.then(|| Self { changes: Some(changes), ..self.clone() })
    }

    /// Returns the grips that may continue a node: all at the start.
    fn next(&self, node: &Node) -> Vec<(usize, f64)> {
        let last = node.candidate.as_ref().and_then(|candidate| candidate.pushes.last());
        let (Some(last), Some(candidate)) = (last, &node.candidate) else {
            return self.all.clone();
        };
        let left = |most: usize| most > candidate.tool_changes();
        let may_follow = |grip: &(usize, f64)| match self.changes {
            None => *grip == last.grip(),
            Some(most) => grip.0 == last.tool || left(most),
        };
        self.all.iter().copied().filter(may_follow).collect()
    }
}

/// Push that may continue a node of the search.
#[derive(Clone, Debug)]
pub(super) struct Extension {
    /// Index of the node.
    pub node: usize,
    /// The push, with its length limited by reach and obstacles.
    pub planned: CandidatePush,
    /// The push with its start position.
    pub push: Push,
    /// Index of its score.
    pub scored: Option<usize>,
    /// Whether its offset lies between coarse ones.
    pub fine: bool,
    /// Minimum remaining distance if the object moved straight along with the push: the order in
    /// which pushes are tried.
    pub promise: f64,
}

/// Resolution of the lateral offsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Resolution {
    /// Number of coarse offsets, if the task lists none.
    pub coarse: usize,
    /// Whether offsets between infeasible coarse ones are added.
    pub fine: bool,
}

/// A push and its extension, or the reason why it cannot be made.
type Tried = (CandidatePush, Result<Extension, Infeasible>);

/// Returns all pushes that can continue the given nodes, in the order of nodes, grips, directions,
/// parts and offsets. Fine offsets of a grip follow its coarse ones.
pub(super) fn extensions(
    workspace: &Workspace,
    field: &CostToGo,
    nodes: &[Node],
    (grips, reached): (&Grips, &Reached),
    offsets: Resolution,
    statistics: &mut SearchStatistics,
    scores: &mut Scores,
) -> Vec<Extension> {
    let work: Vec<(usize, (usize, f64))> = nodes
        .iter()
        .enumerate()
        .flat_map(|(k, node)| grips.next(node).into_iter().map(move |grip| (k, grip)))
        .collect();
    let found: Vec<[Vec<Tried>; 2]> = work
        .par_iter()
        .map(|&(node, grip)| {
            let movers = field.movers(&nodes[node].state);
            // A compound object can be pushed at any of its solids.
            let scene = &workspace.task.scene;
            let movers = movers.into_iter().flat_map(|k| [k].into_iter().chain(scene.parts_of(k)));
            let tried = |object| pushes(workspace, &nodes[node], (grip, object), offsets.coarse);
            let extended = |push| {
                let from = (&nodes[node], node);
                (push, extend(workspace, (field, reached), from, push))
            };
            let coarse: Vec<Tried> = movers.flat_map(tried).map(extended).collect();
            let adapts = offsets.fine && workspace.task.pushes.offsets == Offsets::Effort;
            let refused = |(push, tried): &Tried| (*push, tried.as_ref().err().copied());
            let fine = match adapts {
                true => between(&coarse.iter().map(refused).collect::<Vec<_>>()),
                false => Vec::new(),
            };
            [coarse, fine.into_iter().map(extended).collect()]
        })
        .collect();
    let mut kept = Vec::new();
    for ((_, grip), [coarse, fine]) in work.into_iter().zip(found) {
        let (first, count) =
            (scores.place(grip, coarse.iter().map(|(push, _)| *push)), coarse.len());
        let mut places = HashSet::new();
        for (k, (_, result)) in coarse.into_iter().chain(fine).enumerate() {
            statistics.considered += 1;
            // Fine offsets differ from state to state, so that they have no common score.
            let scored = first.filter(|_| k < count).map(|first| first + k);
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
                        kept.push(Extension { scored, fine: k >= count, ..extension });
                    } else {
                        statistics.repeated += 1;
                    }
                }
            }
        }
    }
    kept
}

/// Returns the pushes of an object to try from a node, before any check.
fn pushes(
    workspace: &Workspace,
    node: &Node,
    (grip, object): ((usize, f64), usize),
    count: usize,
) -> Vec<CandidatePush> {
    let rules = &workspace.task.pushes;
    let mut list = Vec::new();
    for direction in rules.directions.headings() {
        let mut add = |start| {
            if list.len() < MOST_PER_GRIP {
                let ((tool, grip_yaw), room, length) = (grip, node.room, rules.length);
                let push = CandidatePush { tool, grip_yaw, object, start, direction, length, room };
                list.push(push);
            }
        };
        if !workspace.is_placed() {
            add(Start::Chained);
            continue;
        }
        for part in 0..workspace.tools[grip.0].parts().len() {
            match &rules.offsets {
                Offsets::List(offsets) => {
                    offsets.iter().for_each(|&offset| add(Start::Placed { part, offset }));
                }
                Offsets::Effort => {
                    let span = workspace.offset_span(grip, (&node.state, object), part, direction);
                    for k in 0..count {
                        let share = (2 * k + 1) as f64 / count as f64 - 1.0;
                        // Both ends are included if there are at least two offsets.
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
    (field, reached): (&CostToGo, &Reached),
    (node, index): (&Node, usize),
    mut planned: CandidatePush,
) -> Result<Extension, Infeasible> {
    let depth = node.candidate.as_ref().map_or(0, |c| c.pushes.len());
    let placement = workspace.place(&node.state, &planned, node.end)?;
    let start = placement.start;
    if workspace.is_placed() && topples(workspace, &planned) {
        return Err(Infeasible::Topples);
    }
    planned.length =
        workspace.free_travel(planned.grip(), start, planned.direction, planned.length)?;
    let push = Push {
        start,
        direction: planned.direction,
        length: planned.length,
        speed: workspace.task.pushes.speed,
    };
    let set_down = (workspace.is_placed() || depth == 0).then_some(placement);
    let pushed = (&node.state, planned.object);
    if let Some(reason) = workspace.margins(planned.grip(), pushed, &push, set_down).violation() {
        return Err(reason);
    }
    if workspace.is_placed() && !reached.reach(planned.grip(), start, depth == 0) {
        return Err(Infeasible::NoWay);
    }
    let carried = (push.length - placement.back).max(0.0);
    let promise = (0..=2)
        .map(|k| field.carried(pushed, push.heading() * (carried * k as f64 / 2.0)))
        .fold(f64::INFINITY, f64::min);
    Ok(Extension { node: index, planned, push, scored: None, fine: false, promise })
}

/// Returns `true` if an object topples instead of sliding, for any direction of a push at the
/// tool's lowest height. The planar search models cannot predict this. Jointed objects are left to
/// the 3-D engine.
///
/// Let F be a force at height z and W the weight. The friction coefficients are m with the table
/// and t with the tool, and the farthest edge is at distance d. The object stays down while the
/// moments about that edge satisfy F z <= W d + 2 d t F, with F = m (W + t F). This is equivalent
/// to m z <= d (1 + m t).
fn topples(workspace: &Workspace, push: &CandidatePush) -> bool {
    let object = push.object;
    let Task { scene, pushes, .. } = workspace.task;
    let one = &scene.objects[object];
    let joined = scene.joints.iter().any(|joint| joint.between.contains(&object))
        || scene.mounts.iter().any(|mount| mount.object == object);
    let friction =
        |with, value| pair_friction(&scene.frictions, object, with, [one.friction, value]);
    let table = friction(Surface::Table, scene.table_friction);
    let held = 1.0 + table * friction(Surface::Tool, workspace.tools[push.tool].friction);
    let edge = one.shape.footprint().bounding_radius();
    !joined && !one.may_fall && table * pushes.lift > edge * held
}

/// Returns the indices of the most promising pushes, at most `budget`, most promising first. Ties
/// are broken by a fixed scatter, so that no tool is favoured by its place in the list.
pub(super) fn by_promise(list: &[Extension], budget: usize) -> Vec<usize> {
    /// Golden section, whose multiples modulo 1 are spread evenly over [0, 1).
    const SCATTER: f64 = 0.618_033_988_749_894_9;
    let mut order: Vec<usize> = (0..list.len()).collect();
    let scatter = |k: usize| (k as f64 * SCATTER).fract();
    order.sort_by(|&a, &b| {
        let promise = list[a].promise.total_cmp(&list[b].promise);
        promise.then(scatter(a).total_cmp(&scatter(b))).then(a.cmp(&b))
    });
    order.truncate(budget);
    order
}
