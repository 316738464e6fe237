//! Parts of compound objects above the table, such as the handle of a pot, and the distribution of
//! their weight over the standing solids.

use crate::geometry::{Pose, Vector, clearance};

use super::balance::balanced;
use super::{Feet, JOIN_GAP, Object};

/// Load on the points under a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// Load as a share of the solid's own weight; zero for a part above the table.
    pub share: f64,
    /// Centre of the load in the solid's frame, metres.
    pub centre: Vector,
}

/// Returns the solids of a compound object without any connection to the ground: parts above the
/// table that touch neither a standing solid nor another connected part.
pub fn hanging(solids: &[Object]) -> Vec<usize> {
    let touch = |a: &Object, b: &Object| {
        let [one, other] = [a, b].map(|solid| (solid.shape.footprint(), solid.pose));
        let gap = clearance((&one.0, &one.1), (&other.0, &other.1), 2.0 * JOIN_GAP);
        let [low, high] = a.span();
        gap <= JOIN_GAP && b.meets([low - JOIN_GAP, high + JOIN_GAP])
    };
    let (mut held, mut hanging): (Vec<usize>, Vec<usize>) =
        (0..solids.len()).partition(|&k| !solids[k].is_raised());
    let mut next = 0;
    while let Some(&holds) = held.get(next) {
        let (more, left) =
            hanging.into_iter().partition::<Vec<_>, _>(|&k| touch(&solids[k], &solids[holds]));
        held.extend(more);
        hanging = left;
        next += 1;
    }
    hanging
}

/// Returns the load on every solid of a compound object, with the centre of all loads below the
/// centre of mass. Returns `None` if the standing solids cannot carry it there.
pub fn bearings(solids: &[&Object]) -> Option<Vec<Bearing>> {
    let place = |object: &Object| object.whole.map_or(Pose::default(), |whole| whole.place);
    let mass: f64 = solids.iter().map(|solid| solid.mass).sum();
    let moment = |solid: &&Object| solid.mass * place(solid).position;
    let centre = solids.iter().map(moment).sum::<Vector>() / mass;
    let feet: Vec<Feet> = solids.iter().map(|solid| solid.feet()).collect();
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    let stands = |solid: &Object| !solid.is_raised();
    for (solid, feet) in solids.iter().zip(&feet).filter(|(solid, _)| stands(solid)) {
        points.extend(feet.each().map(|(at, _)| place(solid).point(at) - centre));
        weights.extend(feet.each().map(|(_, load)| solid.mass / mass * load));
    }
    let mut loads = balanced(&points, &weights)?.into_iter();
    let bearing = |(solid, feet): (&&Object, &Feet)| {
        let count = if stands(solid) { feet.count } else { 0 };
        let own: Vec<(Vector, f64)> =
            feet.each().map(|(at, _)| at).zip(loads.by_ref().take(count)).collect();
        let load: f64 = own.iter().map(|(_, load)| load).sum();
        let moment: Vector = own.iter().map(|(at, load)| *load * at).sum();
        let centre = if load > 0.0 { moment / load } else { Vector::zeros() };
        Bearing { share: load * mass / solid.mass, centre }
    };
    Some(solids.iter().zip(&feet).map(bearing).collect())
}

/// Distributes the weight of parts above the table over the standing solids, in proportion to their
/// mass.
pub(super) fn by_mass(solids: &[&Object]) -> Vec<Bearing> {
    let sum = |raised: bool| -> f64 {
        let those = solids.iter().filter(|solid| raised || !solid.is_raised());
        those.map(|solid| solid.mass).sum()
    };
    let share = sum(true) / sum(false);
    let of = |solid: &&Object| if solid.is_raised() { 0.0 } else { share };
    let bearing = |solid| Bearing { share: of(solid), centre: Vector::zeros() };
    solids.iter().map(bearing).collect()
}
