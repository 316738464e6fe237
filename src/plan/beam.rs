//! Choice of the states from which a search continues: the cheapest, but some for every grip,
//! direction and place, because the path to a goal may begin with a detour.

use std::collections::HashSet;

use crate::scene::State;

use super::enumerate::Extension;

/// Side of the square cells; stops whose pushed objects share a cell count as alike, metres.
const CELL: f64 = 0.03;

/// Point where a push may end and the next may begin.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    /// Index of the push in the list of rollouts.
    pub extension: usize,
    /// Travel up to the stop, metres.
    pub length: f64,
    /// Remaining cost from the stop.
    pub cost: f64,
    /// State from which to continue, if it is known exactly.
    pub known: Option<State>,
    grip: (usize, u64),
    /// Pushed object and direction.
    way: (usize, u64),
    cell: (i64, i64),
}

impl Stop {
    pub fn new(
        extension: &Extension,
        length: f64,
        cost: f64,
        rest: &State,
        known: Option<State>,
    ) -> Self {
        let object = extension.planned.object;
        let at = rest.poses[object].position;
        let cell = |v: f64| (v / CELL).floor() as i64;
        Self {
            extension: 0,
            length,
            cost,
            known,
            grip: (extension.planned.tool, extension.planned.grip_yaw.to_bits()),
            way: (object, extension.push.direction.to_bits()),
            cell: (cell(at.x), cell(at.y)),
        }
    }

    /// Returns this stop for the push with another index.
    pub fn of(self, extension: usize) -> Self {
        Self { extension, ..self }
    }
}

/// Chooses at most `width` stops, never two with one grip in one cell. Half of the beam goes to the
/// cheapest stop of each grip and direction, and the rest to the cheapest stops. Without a width,
/// all stops are kept.
pub(super) fn choose(mut offers: Vec<Stop>, width: Option<usize>) -> Vec<Stop> {
    offers.retain(|stop| stop.cost.is_finite());
    let Some(width) = width else { return offers };
    // The sort is stable, so that equal costs keep the order of enumeration.
    offers.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut taken = vec![false; offers.len()];
    let (mut ways, mut cells) = (HashSet::new(), HashSet::new());
    let mut count = 0;
    for (k, stop) in offers.iter().enumerate() {
        if count < width.div_ceil(2) && ways.insert((stop.grip, stop.way)) {
            cells.insert((stop.grip, stop.cell));
            taken[k] = true;
            count += 1;
        }
    }
    for (k, stop) in offers.iter().enumerate() {
        if count < width && !taken[k] && cells.insert((stop.grip, stop.cell)) {
            taken[k] = true;
            count += 1;
        }
    }
    let mut kept = taken.into_iter();
    offers.retain(|_| kept.next().unwrap_or(false));
    offers
}
