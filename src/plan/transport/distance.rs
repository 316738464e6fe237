//! Distances of a group to its goal among fixed bodies, in pushes, from every place of its grid.

use crate::geometry::Frontier;

use super::group::{Group, ROOMY};
use super::held::{Held, made_by};
use super::lattice::Shift;

/// Cost of a metre of transport, in pushes.
pub(super) const METRE: f64 = 1.0;

/// Additional cost of a metre in the narrowest gap, in pushes.
const NARROW_METRE: f64 = 2.0;

/// Additional cost of a push for which the tool has no place, so that another object must make it.
const BY_ANOTHER: f64 = 1.5;

/// Length of the shortest useful push, metres: a tool moves half of it before contact.
pub(super) const SHORTEST: f64 = 0.015;

/// Straight stretch of the shortest path from a place.
#[derive(Clone, Copy)]
struct Stretch {
    step: [i32; 2],
    count: u16,
    /// Index of a hold that makes the push; `None` if only another object can.
    hold: Option<u8>,
}

/// Distances of a group to its goal.
pub(super) struct Distances {
    cost: Vec<f32>,
    next: Vec<Option<Stretch>>,
}

/// Sample of a path: displacement of the group, and index of the hold behind it.
pub(super) type Sample = (Shift, Option<u8>);

impl Distances {
    /// Computes the distances to the places `goals` with pushes of at most `longest` metres.
    pub fn to(
        goals: &[usize],
        (group, held): (&Group, &Held),
        steps: &[[i32; 2]],
        longest: f64,
    ) -> Self {
        let (lattice, count) = (&group.lattice, group.lattice.count());
        let mut own = Self { cost: vec![f32::INFINITY; count], next: vec![None; count] };
        let mut passed = vec![vec![f64::INFINITY; count]; steps.len()];
        let mut frontier = Frontier::default();
        for &goal in goals.iter().filter(|goal| group.clear[**goal] >= 0.0) {
            own.cost[goal] = 0.0;
            frontier.push(0.0, goal);
        }
        let narrow = |place: usize| 1.0 - f64::from(group.clear[place]) / ROOMY;
        let of_step: Vec<u64> = steps.iter().map(|step| made_by(&held.holds, *step)).collect();
        while let Some((cost, place)) = frontier.pop() {
            if cost as f32 > own.cost[place] {
                continue;
            }
            for (k, &step) in steps.iter().enumerate() {
                let mut free = of_step[k] & held.free[place];
                let (mut at, mut length, mut on_the_way) = (place, 0.0, cost);
                let back = step.map(|s| -s);
                while let Some(before) = lattice.next(at, back).filter(|at| group.clear[*at] >= 0.0)
                {
                    at = before;
                    length += lattice.spacing;
                    on_the_way += lattice.spacing * (METRE + NARROW_METRE * narrow(at));
                    free &= held.free[at];
                    let own_push = if free == 0 { BY_ANOTHER } else { 0.0 };
                    let so_far = on_the_way + own_push + 1.0 + ((length - 1e-9) / longest).floor();
                    if passed[k][at] <= so_far {
                        break;
                    }
                    passed[k][at] = so_far;
                    if length >= SHORTEST && (so_far as f32) < own.cost[at] {
                        own.cost[at] = so_far as f32;
                        let count = (length / lattice.spacing).round() as u16;
                        let hold = (free != 0).then(|| free.trailing_zeros() as u8);
                        own.next[at] = Some(Stretch { step, count, hold });
                        frontier.push(f64::from(so_far as f32), at);
                    }
                }
            }
        }
        own
    }

    /// Returns the distance from a place, in pushes; infinite if there is no path.
    pub fn cost(&self, place: usize) -> f64 {
        f64::from(self.cost[place])
    }

    /// Returns samples of the shortest path from a displacement, and its number of pushes.
    pub fn path(&self, group: &Group, from: Shift, longest: f64) -> (Vec<Sample>, usize) {
        let (mut samples, mut pushes, mut at) = (Vec::new(), 0, from.map(i32::from));
        while let Some(stretch) = group.lattice.at(at).and_then(|place| self.next[place]) {
            let count = i32::from(stretch.count);
            for k in (0..=count).filter(|k| k % 2 == 0 || *k == count) {
                let there = [at[0] + stretch.step[0] * k, at[1] + stretch.step[1] * k];
                samples.push((there.map(|v| v as i16), stretch.hold));
            }
            at = [at[0] + stretch.step[0] * count, at[1] + stretch.step[1] * count];
            let length = f64::from(count) * group.lattice.spacing;
            pushes += pushes_for(length, longest);
        }
        (samples, pushes)
    }
}

/// Returns the number of pushes of at most `longest` metres for a length, metres.
pub(super) fn pushes_for(length: f64, longest: f64) -> usize {
    ((length - 1e-9) / longest).floor() as usize + 1
}
