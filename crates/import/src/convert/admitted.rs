//! Solids, masses and frictions that a task can state, of those in a file.

use nalgebra::Point3;

use crate::diagnostic::{Effect, Ledger};
use crate::model::{Body, Outline, Solid};

use super::upright::{Upright, cloud};

/// Collision solid, with the index of its body.
pub(super) type Owned<'a> = (usize, &'a Solid);

/// Minimum mass of an object, kg, and range of friction values that a task can state.
pub(super) const MASS: f64 = 1e-3;
pub(super) const FRICTIONS: [f64; 2] = [0.05, 2.0];

/// Radius below which a sphere is a contact point of other solids, metres.
const POINT: f64 = 2e-3;

/// Height above the lowest point up to which a sphere is a foot, metres.
const REACHES: f64 = 1e-4;

/// Returns the collision solids of bodies without those that are too flat to be pushed.
pub(super) fn without_flat<'a>(all: Vec<Owned<'a>>, ledger: &mut Ledger) -> Vec<Owned<'a>> {
    let (flat, kept): (Vec<Owned<'a>>, Vec<Owned<'a>>) =
        all.iter().copied().partition(|(_, solid)| !is_sphere(solid) && is_flat(solid));
    let note = format!("{} solids are flat or tiny, and left out", flat.len());
    let left_out = !flat.is_empty()
        && !kept.is_empty()
        && ledger.assume(Effect::Slight, flat[0].1.place, note);
    if left_out { kept } else { all }
}

pub(super) fn is_sphere(solid: &Solid) -> bool {
    matches!(solid.outline, Outline::Sphere(_))
}

/// Returns `true` if all spheres reach below the other solids, as feet do.
pub(super) fn on_feet(all: &[Owned<'_>]) -> bool {
    let solids = || all.iter().filter(|(_, solid)| !is_sphere(solid));
    let low = solids().map(|(_, solid)| lowest(solid)).fold(f64::INFINITY, f64::min);
    let spheres = all.iter().filter(|(_, solid)| is_sphere(solid));
    spheres.map(|(_, sphere)| lowest(sphere)).all(|reach| reach <= low + REACHES)
}

/// Returns the collision solids of bodies without spheres that are mere contact points: small ones
/// that do not reach the lowest point, as at the upper corners of a box.
pub(super) fn without_points<'a>(all: Vec<Owned<'a>>, ledger: &mut Ledger) -> Vec<Owned<'a>> {
    let radius = |solid: &Solid| match solid.outline {
        Outline::Sphere(radius) => radius,
        _ => f64::INFINITY,
    };
    let reach = |solid: &Solid| solid.pose.translation.z - radius(solid);
    let spheres = || all.iter().filter(|(_, solid)| is_sphere(solid));
    let low = spheres().map(|(_, solid)| reach(solid)).fold(f64::INFINITY, f64::min);
    let single = all.len() - spheres().count() == 1;
    let is_point =
        |solid: &Solid| radius(solid) < POINT && !(single && reach(solid) <= low + REACHES);
    if all.len() == spheres().count() || !all.iter().any(|(_, solid)| is_point(solid)) {
        return all;
    }
    let (points, kept): (Vec<Owned<'a>>, Vec<Owned<'a>>) =
        all.into_iter().partition(|(_, solid)| is_point(solid));
    let note = format!("{} spheres are contact points of other solids, and left out", points.len());
    ledger.note_as(Effect::Slight, points[0].1.place, note);
    kept
}

/// Returns a value as a task can state it, with a note if it is another one; if nothing may be
/// assumed, it stays as it is, which is a fault of the task.
pub(super) fn stated(
    value: f64,
    [low, high]: [f64; 2],
    unit: &str,
    owner: &Body,
    ledger: &mut Ledger,
) -> f64 {
    let kept = value.clamp(low, high);
    if kept == value {
        return value;
    }
    let limit = if value < low { "at least" } else { "at most" };
    let note = format!(
        "`{}` has {value} {unit} in the file; a task has {limit} {kept}, which is used",
        owner.name
    );
    if ledger.assume(Effect::Strong, owner.place, note) { kept } else { value }
}

/// Returns points in the world whose convex hull approximates a solid, metres.
fn placed(solid: &Solid) -> Vec<Point3<f64>> {
    cloud(&solid.outline).iter().map(|point| solid.pose * point).collect()
}

/// Returns the height of the lowest point of a solid in the world, metres.
fn lowest(solid: &Solid) -> f64 {
    placed(solid).iter().map(|point| point.z).fold(f64::INFINITY, f64::min)
}

/// Returns `true` for a solid that is too flat or small to be pushed.
fn is_flat(solid: &Solid) -> bool {
    let points = placed(solid);
    !points.is_empty() && Upright::over(&points, None, false).is_none()
}
