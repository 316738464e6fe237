//! Search for sequences of pushes among many groups: their order, their ends, and the groups that
//! are carried along.
//!
//! A best-first search with two queues. One prefers states near the goals, estimated by the
//! distances of all groups among fixed bodies and by the groups in the way. The other prefers
//! states in which groups, or pairs of them, are at new places (Lipovetzky and Geffner 2017,
//! "Best-first width search"). The budget is a number of expanded states.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};
use std::rc::Rc;

use crate::progress::Progress;

use super::distance::{METRE, Sample};
use super::lattice::Shift;
use super::legs::{Failed, Leg, is_like, legs_of};
use super::moves::{MOVERS, Move, moves, pushing, tool_after};
use super::reach::Transport;
use super::travel::Flood;

/// Maximum numbers of expanded states, without and with pushes that carry several groups. Pushes of
/// one group are safer.
const PASSES: [(usize, usize); 2] = [(300, 1), (3000, MOVERS)];

/// Maximum number of states.
const MOST: usize = 250_000;

/// Number of groups above which only the relevant ones are pushed.
const MANY: usize = 24;

/// Weight of the estimated remaining cost: plans may be longer than the shortest.
const GREED: f64 = 2.5;

/// Cost of a group in the way, in pushes: without a goal, on its way to a goal, and at its goal,
/// to which it must return.
const IN_THE_WAY: f64 = 1.2;
const ON_ITS_WAY: f64 = 0.4;
const AT_ITS_GOAL: f64 = 3.5;

/// Additional cost of carrying a group along, and of a contact that may rotate it, in pushes.
const CARRIED: f64 = 0.6;
const LOOSE: f64 = 1.5;

/// Handicap of states in which nothing relevant has moved, in pushes.
const ASIDE: f64 = 1.5;

/// Number of states taken from the first queue for each one of the second.
const TURNS: usize = 3;

/// Side of the cells in which places count as old, in steps of the grid.
const OLD: i16 = 8;

struct Node {
    shifts: Vec<Shift>,
    /// Index of the previous node, and the push from it.
    before: Option<(usize, Move)>,
    cost: f64,
    pushes: usize,
    expanded: bool,
}

/// Samples of a path and its number of pushes.
type SampledPath = (Vec<Sample>, usize);

/// Entry of a queue: lowest key first, then the oldest.
type Entry = Reverse<(u64, usize)>;

/// Estimate for one state.
struct Estimate {
    /// Remaining cost, in pushes.
    left: f64,
    /// Lower bound of the number of pushes.
    pushes: usize,
    /// Whether each group is relevant: not at its goal, or in the way.
    relevant: Vec<bool>,
}

struct Sequences<'t, 'a> {
    transport: &'t Transport<'a>,
    failed: &'t [Failed],
    /// Maximum number of expanded states.
    budget: usize,
    /// Maximum number of groups that a push carries.
    movers: usize,
    nodes: Vec<Node>,
    near: BinaryHeap<Entry>,
    novel: BinaryHeap<Entry>,
    known: HashMap<Vec<Shift>, f64>,
    old: HashSet<(u16, Shift)>,
    old_pairs: HashSet<(u16, Shift, u16, Shift)>,
    /// Shortest paths of groups from their displacements, with the numbers of pushes.
    paths: HashMap<(usize, Shift), Rc<SampledPath>>,
}

/// Returns the legs of up to `count` plans with at most `most` pushes each.
/// Returns none if `progress` stops the search.
pub fn find_legs(
    transport: &Transport,
    most: usize,
    count: usize,
    progress: &dyn Progress,
) -> Vec<Vec<Leg>> {
    legs_without(transport, &[], (most, count), progress)
}

/// Returns the legs of plans that avoid pushes which failed.
pub(super) fn legs_without(
    transport: &Transport,
    failed: &[Failed],
    counts: (usize, usize),
    progress: &dyn Progress,
) -> Vec<Vec<Leg>> {
    for pass in PASSES {
        let found = sequences(transport, failed, counts, pass, progress);
        if !found.is_empty() {
            return found;
        }
    }
    Vec::new()
}

/// Returns the legs of plans whose pushes carry up to `movers` groups.
fn sequences(
    transport: &Transport,
    failed: &[Failed],
    (most, count): (usize, usize),
    (budget, movers): (usize, usize),
    progress: &dyn Progress,
) -> Vec<Vec<Leg>> {
    let mut search = Sequences {
        transport,
        failed,
        budget,
        movers,
        nodes: Vec::new(),
        near: BinaryHeap::new(),
        novel: BinaryHeap::new(),
        known: HashMap::new(),
        old: HashSet::new(),
        old_pairs: HashSet::new(),
        paths: HashMap::new(),
    };
    search.run((most, count), progress).into_iter().map(|node| search.legs_to(node)).collect()
}

impl Sequences<'_, '_> {
    /// Returns the nodes at which all goals are met.
    fn run(&mut self, (most, count): (usize, usize), progress: &dyn Progress) -> Vec<usize> {
        let start = vec![[0, 0]; self.transport.groups.len()];
        self.add(Node { shifts: start, before: None, cost: 0.0, pushes: 0, expanded: false }, most);
        let (mut found, mut budget) = (Vec::new(), self.budget);
        let mut turn = 0;
        while turn < budget && self.nodes.len() < MOST && !progress.cancelled() {
            turn += 1;
            let queue = match turn % (TURNS + 1) {
                0 => &mut self.novel,
                _ => &mut self.near,
            };
            let Some(Reverse((_, index))) = queue.pop().or_else(|| self.near.pop()) else { break };
            if std::mem::replace(&mut self.nodes[index].expanded, true) {
                continue;
            }
            let (shifts, cost, pushes) = {
                let node = &self.nodes[index];
                (node.shifts.clone(), node.cost, node.pushes)
            };
            if self.is_solved(&shifts) {
                found.push(index);
                if found.len() == count {
                    break;
                }
                budget = budget.min(2 * turn);
                continue;
            }
            let Some(estimate) = self.remaining(&shifts) else { continue };
            let flood = self.flood(index);
            let all = shifts.len() <= MANY;
            for k in (0..shifts.len()).filter(|k| all || estimate.relevant[*k]) {
                for one in moves(self.transport, k, &shifts, self.movers, flood.as_ref()) {
                    let again = |failed| is_like(self.transport, failed, &one, &shifts);
                    if self.failed.iter().any(again) {
                        continue;
                    }
                    let length = self.transport.length(one.steps);
                    let count = self.transport.pushes(length);
                    let carried = one.train.movers().count() - 1;
                    let own = count as f64
                        + METRE * length
                        + CARRIED * carried as f64
                        + LOOSE * f64::from(one.train.loose);
                    let mut after = shifts.clone();
                    one.train.movers().for_each(|(k, at)| after[k] = at);
                    let helps = one.train.movers().any(|(k, _)| estimate.relevant[k]);
                    let node = Node {
                        shifts: after,
                        before: Some((index, one)),
                        cost: cost + own,
                        pushes: pushes + count,
                        expanded: false,
                    };
                    match helps {
                        true => self.add(node, most),
                        false => self.defer(node, estimate.left),
                    }
                }
            }
        }
        found
    }

    /// Returns the positions that a tool that stays down reaches from a node.
    fn flood(&self, node: usize) -> Option<Flood> {
        let (transport, node) = (self.transport, &self.nodes[node]);
        let pushed = node.before.as_ref().map(|(_, one)| one);
        let from = pushed.map_or(transport.home, |one| tool_after(transport, one));
        let step = pushed.map(|one| pushing(transport, one).1.step);
        transport.flood(from, step, &node.shifts)
    }

    fn is_solved(&self, shifts: &[Shift]) -> bool {
        self.transport.groups.iter().zip(shifts).all(|(group, at)| group.is_at_goal(*at))
    }

    /// Adds a state to both queues, unless it is known, hopeless or too far.
    fn add(&mut self, node: Node, most: usize) {
        if !self.is_new(&node) {
            return;
        }
        let Some(estimate) = self.remaining(&node.shifts) else { return };
        if node.pushes + estimate.pushes > most {
            return;
        }
        let total = node.cost + GREED * estimate.left;
        let index = self.nodes.len();
        self.near.push(Reverse((total.to_bits(), index)));
        self.queue_novel(node, estimate.left);
    }

    /// Adds a state in which nothing relevant has moved to the second queue, if it is novel.
    fn defer(&mut self, node: Node, left: f64) {
        if self.is_new(&node) {
            let total = node.cost + GREED * left + ASIDE;
            self.near.push(Reverse((total.to_bits(), self.nodes.len())));
            self.queue_novel(node, left);
        }
    }

    fn queue_novel(&mut self, node: Node, left: f64) {
        let novelty = self.novelty(&node.shifts, node.before.as_ref().map(|(_, one)| one));
        if novelty < 2.0 {
            self.novel.push(Reverse(((novelty * 1e4 + left).to_bits(), self.nodes.len())));
        }
        self.nodes.push(node);
    }

    /// Returns `true` if no cheaper way to the same places is known, and goals can be reached.
    fn is_new(&mut self, node: &Node) -> bool {
        let transport = self.transport;
        let is_lost = |(k, at)| !transport.distance(k, at).is_finite();
        if node.before.as_ref().is_some_and(|(_, one)| one.train.movers().any(is_lost)) {
            return false;
        }
        let mut key = node.shifts.clone();
        if let (Some(floor), Some((_, one))) = (&self.transport.floor, &node.before) {
            let cell = floor.cell(tool_after(self.transport, one));
            key.push(cell.map(|v| v.div_euclid(OLD)));
        }
        if self.known.get(&key).is_some_and(|known| *known <= node.cost) {
            return false;
        }
        self.known.insert(key, node.cost);
        true
    }

    /// Returns 0 if a moved group is at a new place, 1 if a pair is, otherwise 2.
    fn novelty(&mut self, shifts: &[Shift], made: Option<&Move>) -> f64 {
        let place = |k: usize| (k as u16, shifts[k].map(|v| v.div_euclid(OLD)));
        let mut novelty = 2.0;
        let moved: Vec<usize> = match made {
            Some(made) => made.train.movers().map(|(k, _)| k).collect(),
            None => (0..shifts.len()).collect(),
        };
        for &k in &moved {
            let (own, at) = place(k);
            for other in (0..shifts.len()).filter(|other| *other != k) {
                let (its, there) = place(other);
                let pair = if own < its { (own, at, its, there) } else { (its, there, own, at) };
                if self.old_pairs.insert(pair) {
                    novelty = f64::min(novelty, 1.0);
                }
            }
            if self.old.insert((own, at)) {
                novelty = 0.0;
            }
        }
        novelty
    }

    /// Returns the estimated remaining cost; `None` if a goal can no longer be reached.
    fn remaining(&mut self, shifts: &[Shift]) -> Option<Estimate> {
        let transport = self.transport;
        let mut estimate = Estimate { left: 0.0, pushes: 0, relevant: Vec::new() };
        let mut wanting = vec![false; shifts.len()];
        let mut blocking = wanting.clone();
        for (k, group) in transport.groups.iter().enumerate() {
            let at = shifts[k];
            let Some(distances) = &transport.distances[k] else { continue };
            if group.is_at_goal(at) {
                continue;
            }
            wanting[k] = true;
            let cost = transport.distance(k, at);
            if !cost.is_finite() {
                return None;
            }
            estimate.left += cost;
            let path = self
                .paths
                .entry((k, at))
                .or_insert_with(|| Rc::new(distances.path(group, at, transport.longest)));
            let path = Rc::clone(path);
            estimate.pushes += path.1;
            for other in (0..shifts.len()).filter(|other| *other != k) {
                let (between, there) = (transport.beside((k, other)), shifts[other]);
                let blocks = path.0.iter().any(|(at, hold)| {
                    let tool = |hold| transport.beside_tool((k, usize::from(hold)), other);
                    between.meet(*at, there) || hold.is_some_and(|hold| tool(hold).meet(*at, there))
                });
                blocking[other] |= blocks;
            }
        }
        for (k, group) in transport.groups.iter().enumerate() {
            if blocking[k] {
                estimate.left += match (wanting[k], group.goal) {
                    (true, _) => ON_ITS_WAY,
                    (false, Some(_)) => AT_ITS_GOAL,
                    (false, None) => IN_THE_WAY,
                };
            }
        }
        estimate.relevant = wanting.iter().zip(&blocking).map(|(a, b)| *a || *b).collect();
        Some(estimate)
    }

    /// Returns the legs that lead to a node.
    fn legs_to(&self, node: usize) -> Vec<Leg> {
        let (mut stretches, mut at) = (Vec::new(), node);
        while let Some((before, one)) = &self.nodes[at].before {
            let (group, hold) = pushing(self.transport, one);
            let from = group.position(self.nodes[*before].shifts[one.group]) + hold.effector;
            let travel = self.transport.travel(self.flood(*before).as_ref(), from);
            let shifts = &self.nodes[*before].shifts;
            stretches.push(legs_of(self.transport, one, shifts, travel.unwrap_or_default()));
            at = *before;
        }
        stretches.into_iter().rev().flatten().collect()
    }
}
