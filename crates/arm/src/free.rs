//! Free motion between pushes: a line in joint space if it is free of collisions, otherwise a path
//! through the home configuration, otherwise a path of bidirectional rapidly exploring random trees
//! (Kuffner and LaValle 2000, doi:10.1109/ROBOT.2000.844730), by the crate `rrt`.

#[cfg(feature = "search")]
use std::{cell::Cell, f64::consts::PI};

use super::hull::PlacedHull;
#[cfg(feature = "search")]
use super::inverse::kronecker;
use super::model::Arm;
use super::room::Room;
use pushplan::scene::ArmFault;

/// Interval of collision checks on linear joint motion, radians or metres.
const LOOK: f64 = 0.06;

/// Step of the trees in joint space, and the maximum number of samples.
#[cfg(feature = "search")]
const STRIDE: f64 = 0.15;
#[cfg(feature = "search")]
const SAMPLES: usize = 600;

/// Distance of a carried tool from other bodies, metres, where both ends of a motion allow it:
/// bodies are not exactly where they are expected.
const APART: f64 = 0.005;

/// Objects, and the distance that the tool keeps from them, metres.
type Bodies<'a> = (&'a [(&'a str, PlacedHull)], f64);

/// Returns joint positions on a path between two configurations with the tool lifted, without
/// collisions and without the first. Trees are grown only to `search`.
///
/// # Errors
/// Returns the first collision on the line if no path is found.
pub(super) fn way(
    room: &Room<'_>,
    [from, to]: [&[f64]; 2],
    objects: &[(&str, PlacedHull)],
    search: bool,
) -> Result<Vec<Vec<f64>>, ArmFault> {
    let free = |at: &[f64]| room.met(&room.stance(at), objects, Some(APART)).is_none();
    let objects = (objects, if free(from) && free(to) { APART } else { 0.0 });
    let Some(between) = swept(room, [from, to], objects) else { return Ok(vec![to.to_vec()]) };
    let turn = first_turn(room.arm);
    let folded = |at: &[f64]| {
        let mut folded = room.arm.home.clone();
        folded[turn] = at[turn];
        folded
    };
    let by = [folded(from), folded(to), to.to_vec()];
    let starts = [from, &by[0], &by[1]];
    if starts.into_iter().zip(&by).all(|(a, b)| swept(room, [a, b], objects).is_none()) {
        return Ok(by.to_vec());
    }
    let found = if search { searched(room, [from, to], objects) } else { None };
    found.ok_or(ArmFault::NoWay { between })
}

/// Returns the index of the first revolute joint, or 0.
pub(super) fn first_turn(arm: &Arm) -> usize {
    arm.joints.iter().position(|joint| !joint.slides).unwrap_or(0)
}

/// Returns no path, because this build has no search.
#[cfg(not(feature = "search"))]
fn searched(_: &Room<'_>, _: [&[f64]; 2], _: Bodies) -> Option<Vec<Vec<f64>>> {
    None
}

/// Returns a path of random trees, shortened, without its first configuration.
#[cfg(feature = "search")]
fn searched(room: &Room<'_>, [from, to]: [&[f64]; 2], objects: Bodies) -> Option<Vec<Vec<f64>>> {
    let is_free = |at: &[f64]| room.met(&room.stance(at), objects.0, Some(objects.1)).is_none();
    if !is_free(from) || !is_free(to) {
        return None;
    }
    // Joints without limits move by at most half a turn beyond both ends.
    let spans = room.arm.joints.iter().zip(from.iter().zip(to)).map(|(joint, (a, b))| {
        let [low, high] = joint.range().unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        [low.max(a.min(*b) - PI), high.min(a.max(*b) + PI)]
    });
    let spans: Vec<[f64; 2]> = spans.collect();
    // An even sequence instead of random numbers: a plan does not depend on the time it is made.
    let count = Cell::new(0);
    let sample = || {
        count.set(count.get() + 1);
        kronecker(&spans, count.get())
    };
    let path = rrt::dual_rrt_connect(from, to, is_free, sample, STRIDE, SAMPLES).ok()?;
    let path: Vec<Vec<f64>> = [vec![from.to_vec()], path, vec![to.to_vec()]].concat();
    let mut kept = Vec::new();
    let mut at = 0;
    while at + 1 < path.len() {
        let mut next = path.len() - 1;
        while swept(room, [&path[at], &path[next]], objects).is_some() {
            if next == at + 1 {
                return None;
            }
            next = at + (next - at) / 2;
        }
        kept.push(path[next].clone());
        at = next;
    }
    Some(kept)
}

/// Returns the first collision on linear joint motion.
fn swept(room: &Room<'_>, [from, to]: [&[f64]; 2], objects: Bodies) -> Option<[String; 2]> {
    let far = from.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let steps = (far / LOOK).ceil().max(1.0) as usize;
    (0..=steps).find_map(|step| {
        let share = step as f64 / steps as f64;
        let at: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + share * (b - a)).collect();
        room.met(&room.stance(&at), objects.0, Some(objects.1))
    })
}
