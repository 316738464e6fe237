//! Order of transports and clearing of obstructions, by a best-first search over the places of all
//! groups.

use std::collections::{HashMap, HashSet};

use crate::geometry::Vector;

use super::lattice::Solid;
use super::path::{PathSegment, Paths};
use super::reach::{Leg, Transport};

/// Clearance between a cleared group and the path that it makes free, metres: the error of final
/// positions.
const ASIDE: f64 = 0.012;

/// Number of clearing places tried for one group.
const ASIDES: usize = 3;

/// Distance between the clearing places of one group, metres.
const ASIDE_APART: f64 = 0.08;

/// Maximum number of places examined for clearing, cheapest first.
const LOOKED_AT: usize = 2000;

/// Maximum depth of the recursion if a group to clear is itself obstructed.
const DEEP: usize = 3;

/// Cost of obstructing another group, in pushes.
const IN_THE_WAY: f64 = 1.2;

/// Weight of the distance between a cleared group and its own goal, in pushes per metre.
const ASTRAY: f64 = 1.0;

/// Maximum number of expanded nodes: more than a plan of a dozen pushes needs.
const MOST: usize = 120;

/// Places of all groups at one point of a schedule.
#[derive(Clone)]
struct Node {
    places: Vec<usize>,
    moves: Vec<(usize, PathSegment)>,
    /// Cost so far, in pushes.
    cost: f64,
    /// Cost so far plus the estimated remaining cost.
    total: f64,
    /// Lower bound of the number of remaining pushes.
    left: usize,
}

impl Transport<'_> {
    /// Returns the legs of up to `count` plans with at most `most` pushes each, cheapest first.
    pub fn legs(&self, most: usize, count: usize) -> Vec<Vec<Leg>> {
        let mut found = Vec::new();
        let start =
            Node { places: self.start(), moves: Vec::new(), cost: 0.0, total: 0.0, left: 0 };
        let mut open = vec![start];
        let mut seen: HashMap<Vec<usize>, f64> = HashMap::new();
        for _ in 0..MOST {
            // Ties go to the first node, so that the order is deterministic.
            let next = (0..open.len()).min_by(|a, b| open[*a].total.total_cmp(&open[*b].total));
            let Some(next) = next else { break };
            let node = open.remove(next);
            let known = seen.entry(node.places.clone()).or_insert(f64::INFINITY);
            if *known <= node.cost {
                continue;
            }
            *known = node.cost;
            if self.wanting(&node.places).is_empty() {
                found.push(self.legs_of(&node.moves));
                if found.len() == count {
                    break;
                }
                continue;
            }
            for child in self.children(&node) {
                let known = seen.get(&child.places).is_some_and(|cost| *cost <= child.cost);
                if child.moves.len() + child.left <= most && !known {
                    open.push(child);
                }
            }
        }
        found
    }

    /// Returns the next moves.
    fn children(&self, node: &Node) -> Vec<Node> {
        let mut children = Vec::new();
        let wanting = self.wanting(&node.places);
        for &k in &wanting {
            let Some((_, goal)) = self.groups[k].goal else { continue };
            let taken = self.taken_by_others(k, &node.places);
            let ways = self.ways(k, node.places[k], &taken, |place, _| place == goal);
            if ways.cost[goal].is_finite() {
                children.extend(self.child(node, k, goal, &ways));
            }
            let course = self.alone(k, node.places[k]);
            if ways.cost[goal] > course.cost + IN_THE_WAY {
                self.make_room(node, &[(k, &course.way)], DEEP, &mut children);
            }
        }
        children
    }

    /// Adds moves that clear the obstructions of the last path in `ways`, to places outside all
    /// these paths.
    fn make_room(
        &self,
        node: &Node,
        ways: &[(usize, &[PathSegment])],
        deep: usize,
        children: &mut Vec<Node>,
    ) {
        let Some(&(k, way)) = ways.last() else { return };
        for other in self.blocking(k, way, &node.places) {
            if ways.iter().any(|(k, _)| *k == other) {
                continue;
            }
            let asides = |found: &Paths| self.asides(other, ways, found, node);
            let taken = self.taken_by_others(other, &node.places);
            let found = self.ways(other, node.places[other], &taken, |_, _| false);
            let free = asides(&found);
            for place in &free {
                children.extend(self.child(node, other, *place, &found));
            }
            if free.is_empty() && deep > 1 {
                let occupied = self.taken(other, &[]);
                let found = self.ways(other, node.places[other], &occupied, |_, _| false);
                for place in asides(&found).into_iter().take(1) {
                    let own = found.to(place);
                    let more: Vec<_> = ways.iter().copied().chain([(other, &own[..])]).collect();
                    self.make_room(node, &more, deep - 1, children);
                }
            }
        }
    }

    /// Returns the best places for a group outside these paths.
    fn asides(
        &self,
        k: usize,
        ways: &[(usize, &[PathSegment])],
        found: &Paths,
        node: &Node,
    ) -> Vec<usize> {
        let group = &self.groups[k];
        let lattice = &group.lattice;
        let passed: Vec<(Vector, &[Solid])> =
            ways.iter().flat_map(|(other, way)| self.passed(*other, way)).collect();
        let mut order: Vec<(f64, usize)> = (0..lattice.count())
            .filter(|&place| found.cost[place].is_finite() && place != node.places[k])
            .map(|place| {
                let off =
                    group.goal.map_or(0.0, |(goal, _)| (goal - lattice.position(place)).norm());
                (found.cost[place] + ASTRAY * off, place)
            })
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<usize> = Vec::new();
        for (_, place) in order.into_iter().take(LOOKED_AT) {
            let at = lattice.position(place);
            let near = |other: &usize| (lattice.position(*other) - at).norm() < ASIDE_APART;
            if taken.iter().any(near) {
                continue;
            }
            let clear = passed.iter().all(|(position, solids)| {
                solids.iter().all(|solid| {
                    let still = solid.at(*position);
                    let clear = |own: &Solid| {
                        !own.meets(solid) || own.gap(at, (&solid.footprint, &still), ASIDE) >= ASIDE
                    };
                    group.solids.iter().all(clear)
                })
            });
            if clear {
                taken.push(place);
                if taken.len() == ASIDES {
                    break;
                }
            }
        }
        taken
    }

    /// Returns the node after a group has moved to a place.
    fn child(&self, node: &Node, k: usize, place: usize, ways: &Paths) -> Option<Node> {
        let mut child = node.clone();
        child.places[k] = place;
        child.cost += ways.cost[place];
        child.moves.extend(ways.to(place).into_iter().flat_map(|stretch| self.parted(k, stretch)));
        let mut in_the_way = HashSet::new();
        let mut left = 0.0;
        child.left = 0;
        let wanting = self.wanting(&child.places);
        for &k in &wanting {
            let course = self.alone(k, child.places[k]);
            if !course.cost.is_finite() {
                return None;
            }
            left += course.cost;
            child.left += course.pushes;
            // Groups with a move ahead leave the path anyway.
            let blocking = self.blocking(k, &course.way, &child.places);
            in_the_way.extend(blocking.into_iter().filter(|other| !wanting.contains(other)));
        }
        child.total = child.cost + left + IN_THE_WAY * in_the_way.len() as f64;
        Some(child)
    }

    fn legs_of(&self, moves: &[(usize, PathSegment)]) -> Vec<Leg> {
        let leg = |&(k, stretch): &(usize, PathSegment)| {
            let group = &self.groups[k];
            let arrived = group.goal.filter(|(_, goal)| *goal == stretch.to);
            Leg {
                object: group.thing,
                direction: self.holds(k)[stretch.hold].direction,
                from: group.lattice.position(stretch.from),
                to: arrived.map_or(group.lattice.position(stretch.to), |(goal, _)| goal),
                last: arrived.is_some(),
            }
        };
        moves.iter().map(leg).collect()
    }
}
