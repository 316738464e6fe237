//! Cheapest paths of one group to all places: fewest pushes first, then shortest and widest.

use crate::geometry::Frontier;

use super::group::{Group, Hold, ROOMY};

/// Cost of a metre of transport, in pushes.
const METRE: f64 = 1.0;

/// Additional cost of a metre in the narrowest gap, in pushes.
const NARROW_METRE: f64 = 2.0;

/// Cost of a stop in the narrowest gap, in pushes.
const NARROW_STOP: f64 = 0.5;

/// Length of the shortest useful push, metres: a tool moves half of it before contact.
const SHORTEST: f64 = 0.015;

/// Places blocked by other movable objects, for a group and for the tool behind it.
pub(super) struct Taken {
    pub thing: Vec<bool>,
    pub holds: Vec<Vec<bool>>,
}

/// Push from a place, with a hold, to another place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PathSegment {
    pub from: usize,
    pub hold: usize,
    pub to: usize,
}

/// Paths to all places.
pub(super) struct Paths {
    /// Cost of the path to every place, in pushes.
    pub cost: Vec<f64>,
    last: Vec<Option<(usize, usize)>>,
}

impl Paths {
    /// Computes the paths of a group from the place `start` with pushes of at most `longest`
    /// metres. The search ends when `enough` returns `true` for the next place and its cost.
    pub fn from(
        (group, holds): (&Group, &[Hold]),
        start: usize,
        taken: &Taken,
        longest: f64,
        mut enough: impl FnMut(usize, f64) -> bool,
    ) -> Self {
        let (lattice, count) = (&group.lattice, group.lattice.count());
        let mut ways = Self { cost: vec![f64::INFINITY; count], last: vec![None; count] };
        let mut passed = vec![vec![f64::INFINITY; count]; holds.len()];
        let mut frontier = Frontier::default();
        ways.cost[start] = 0.0;
        frontier.push(0.0, start);
        let narrow = |place: usize| 1.0 - f64::from(group.clear[place]) / ROOMY;
        while let Some((cost, place)) = frontier.pop() {
            if cost > ways.cost[place] {
                continue;
            }
            if enough(place, cost) {
                break;
            }
            for (k, hold) in holds.iter().enumerate() {
                let free = |at: usize| {
                    hold.free[at] && !taken.holds[k][at] && (at == start || !taken.thing[at])
                };
                if !free(place) {
                    continue;
                }
                let (mut at, mut length, mut on_the_way) = (place, 0.0, cost);
                while let Some(next) = lattice.next(at, hold.step).filter(|next| free(*next)) {
                    at = next;
                    length += lattice.spacing;
                    on_the_way += lattice.spacing * (METRE + NARROW_METRE * narrow(at));
                    // A path costs one push, and another for every full length.
                    let so_far = on_the_way + 1.0 + ((length - 1e-9) / longest).floor();
                    if passed[k][at] <= so_far {
                        break;
                    }
                    passed[k][at] = so_far;
                    let end = so_far + NARROW_STOP * narrow(at);
                    if length >= SHORTEST && end < ways.cost[at] {
                        ways.cost[at] = end;
                        ways.last[at] = Some((place, k));
                        frontier.push(end, at);
                    }
                }
            }
        }
        ways
    }

    /// Returns the pushes to a place; empty if no path exists.
    pub fn to(&self, place: usize) -> Vec<PathSegment> {
        let mut way = Vec::new();
        let mut at = place;
        while let Some((from, hold)) = self.last[at] {
            way.push(PathSegment { from, hold, to: at });
            at = from;
        }
        way.reverse();
        way
    }
}
