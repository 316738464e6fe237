//! The cheapest way of one thing to all places: by the fewest pushes, then the shortest and roomiest.

use crate::geometry::Frontier;

use super::group::{Group, Hold, ROOMY};

/// Cost of a metre that is carried, in pushes.
const METRE: f64 = 1.0;

/// Cost of a metre in the narrowest gap, in pushes, and of a stop there.
const NARROW_METRE: f64 = 2.0;
const NARROW_STOP: f64 = 0.5;

/// A shorter push is none, metres: a tool moves half of it before it meets anything.
const SHORTEST: f64 = 0.015;

/// Places in which a thing, and the tool behind it, cannot be for what else can be carried.
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

/// Ways to places.
pub(super) struct Paths {
    /// Cost of every place, in pushes.
    pub cost: Vec<f64>,
    last: Vec<Option<(usize, usize)>>,
}

impl Paths {
    /// Of a thing from one place, with pushes of at most `longest` metres, as far as `enough` does not
    /// say of the next place and its cost that it is.
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
                    // One push, and one more for every full length.
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

    /// The pushes to a place; none if there is no way.
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
