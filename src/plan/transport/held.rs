//! Holds of a group, with the places at which they are free among fixed bodies.

use std::cell::OnceCell;

use crate::geometry::Vector;

use super::collision::Collisions;
use super::group::{Group, Hold};

/// Holds of a group.
pub(super) struct Held {
    pub holds: Vec<Hold>,
    /// Free holds at every place, as bits.
    pub free: Vec<u64>,
    /// Number for every place that changes where passages open or close.
    pub openings: Vec<u8>,
    /// Collisions of the tool behind the group with every group, computed on demand.
    pub behind: Vec<OnceCell<Collisions>>,
}

impl Held {
    /// Computes the places of these holds, at most 64, beside `others` groups. `is_free` returns
    /// `true` if a hold has room with the group at a position, metres.
    pub fn of(
        group: &Group,
        holds: Vec<Hold>,
        others: usize,
        steps: &[[i32; 2]],
        is_free: impl Fn(&Hold, Vector) -> bool,
    ) -> Self {
        let at = |place: usize| {
            if group.clear[place] < 0.0 {
                return 0;
            }
            let at = group.lattice.position(place);
            let free = |(k, hold): (usize, &Hold)| u64::from(is_free(hold, at)) << k;
            holds.iter().enumerate().map(free).fold(0, |all, one| all | one)
        };
        let free: Vec<u64> = (0..group.lattice.count()).map(at).collect();
        let of_step: Vec<u64> = steps.iter().map(|step| made_by(&holds, *step)).collect();
        let opening = |place: usize| {
            let bits = |(k, step): (usize, &[i32; 2])| {
                let next = group.lattice.next(place, *step);
                let open = next.is_some_and(|next| group.clear[next] >= 0.0);
                let held = free[place] & of_step[k] != 0;
                u8::from(open) << k | u8::from(held) << (4 + k)
            };
            steps.iter().enumerate().take(4).map(bits).fold(0, |all, one| all | one)
        };
        let openings = (0..group.lattice.count()).map(opening).collect();
        let behind = (0..holds.len() * others).map(|_| OnceCell::new()).collect();
        Self { holds, free, openings, behind }
    }
}

/// Returns the holds that push in a direction, as bits.
pub(super) fn made_by(holds: &[Hold], step: [i32; 2]) -> u64 {
    let made = |(k, hold): (usize, &Hold)| u64::from(hold.step == step) << k;
    holds.iter().enumerate().map(made).fold(0, |all, one| all | one)
}
