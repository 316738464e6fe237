//! Meshes whose outline grows with height, divided into level slices.
//!
//! A tool or another object touches the widest outline up to its own height. A solid that bulges
//! above the table therefore becomes a stack of prisms, each with the outline of everything from
//! the underside of the solid to its own top.

use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{Isometry3, Point3};

use crate::diagnostic::Ledger;
use crate::mesh::{Counted, Mesh};
use crate::model::{Body, Model, Outline, Solid, Weight};
use pushplan::geometry::{Vector, convex_hull, cross};

use super::wanted::Wanted;
use super::weighed::{middle, of_body};

/// Maximum number of layers in which outlines are compared, and their minimum height, metres.
const LAYERS: usize = 32;
const THICK: f64 = 1.5e-3;

/// Number of directions in which outlines are compared.
const DIRECTIONS: usize = 24;

/// Height up to which points touch the table, metres.
const LEVEL: f64 = 3e-4;

/// Maximum number of slices of a solid.
const MOST: usize = 6;

/// Maximum number of triangles of a mesh that is divided itself, instead of its hull.
const MANY: usize = 200_000;

/// Difference of outlines within a slice that is accepted, metres, and relative to the width.
const EVEN: f64 = 1.5e-3;
const EVENLY: f64 = 0.02;

/// Replaces the meshes of movable bodies whose outline grows with height by slices.
pub(super) fn sliced(model: &mut Model, roots: &[usize], wanted: &Wanted, ledger: &mut Ledger) {
    let bodies: Vec<usize> = roots.iter().flat_map(|root| model.below(*root)).collect();
    for body in bodies {
        let body = &mut model.bodies[body];
        // Several solids have different heights anyway.
        if body.solids.iter().filter(|solid| solid.touches).count() != 1 {
            continue;
        }
        let whole = body.surface.as_deref().filter(|surface| surface.is_closed());
        let slices: Vec<Option<Vec<Solid>>> =
            body.solids.iter().map(|solid| of_solid(solid, whole)).collect();
        if slices.iter().all(Option::is_none) {
            continue;
        }
        // Slices have no weight of their own, so the body has it.
        let before = ledger.count();
        let weighed = of_body(body, wanted.density, ledger);
        ledger.since(before);
        let Some((mass, centre, moment)) = weighed else { continue };
        let Some(centre) = centre.or_else(|| heavy(body).map(middle)) else { continue };
        body.inertial = Some((mass, centre, moment));
        let old = std::mem::take(&mut body.solids);
        body.solids = old
            .into_iter()
            .zip(slices)
            .flat_map(|(solid, slices)| slices.unwrap_or_else(|| vec![solid]))
            .collect();
    }
}

/// Returns the first solid of a body that has mass.
fn heavy(body: &Body) -> Option<&Solid> {
    body.solids
        .iter()
        .find(|solid| !matches!(solid.material.weight, Weight::Mass(0.0) | Weight::Density(0.0)))
}

/// Returns the slices of a solid, the lowest first; `None` if one prism is as good. `whole` is the
/// mesh that it stands for, if it is not its hull.
fn of_solid(solid: &Solid, whole: Option<&Mesh>) -> Option<Vec<Solid>> {
    let Outline::Mesh(mesh) = &solid.outline else { return None };
    let placed = |mesh: &Mesh| -> Vec<[f64; 3]> {
        mesh.points.iter().map(|point| (solid.pose * point).coords.into()).collect()
    };
    // Inside a file, a mesh collides as its hull.
    let (corners, faces) = match whole.filter(|mesh| mesh.faces.len() <= MANY) {
        Some(mesh) => (placed(mesh), mesh.faces.clone()),
        None => convex_hull(&placed(mesh)).filter(|_| solid.touches)?,
    };
    let ends = |pick: fn(f64, f64) -> f64, from: f64| corners.iter().map(|c| c[2]).fold(from, pick);
    let (low, high) = (ends(f64::min, f64::INFINITY), ends(f64::max, f64::NEG_INFINITY));
    let layers = LAYERS.min(((high - low) / THICK) as usize);
    if layers < 4 {
        return None;
    }
    let level = |k: usize| low + (high - low) * k as f64 / layers as f64;
    // Points of the surface of the hull between two levels.
    let between = |from: f64, to: f64| {
        let inside = |corner: &&[f64; 3]| corner[2] >= from && corner[2] <= to;
        let edges = faces.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        let crossed = edges.flat_map(|edge| {
            let [a, b] = edge.map(|corner| corners[corner as usize]);
            [from, to].into_iter().filter_map(move |z| {
                let share = (z - a[2]) / (b[2] - a[2]);
                let at = |k: usize| a[k] + share * (b[k] - a[k]);
                (0.0..=1.0).contains(&share).then(|| [at(0), at(1), z])
            })
        });
        corners.iter().filter(inside).copied().chain(crossed).collect::<Vec<[f64; 3]>>()
    };
    let directions: Vec<Vector> = (0..DIRECTIONS)
        .map(|k| TAU * k as f64 / DIRECTIONS as f64)
        .map(|angle| Vector::new(angle.cos(), angle.sin()))
        .collect();
    // Support functions of the outline up to each layer.
    let mut reaches: Vec<Vec<f64>> = Vec::new();
    for k in 0..layers {
        let points = between(level(k), level(k + 1));
        let reach = |direction: &Vector| {
            let along = |point: &[f64; 3]| direction.x * point[0] + direction.y * point[1];
            points.iter().map(along).fold(f64::NEG_INFINITY, f64::max)
        };
        let own = directions.iter().map(reach);
        reaches.push(match reaches.last() {
            Some(below) => own.zip(below).map(|(own, below)| own.max(*below)).collect(),
            None => own.collect(),
        });
    }
    let off = |from: usize, to: usize| {
        let pairs = reaches[from].iter().zip(&reaches[to]);
        pairs.map(|(lower, upper)| upper - lower).fold(0.0, f64::max)
    };
    let width = reaches[layers - 1].iter().copied().fold(0.0, f64::max)
        + reaches[layers - 1].iter().fold(f64::INFINITY, |least, reach| least.min(*reach)).abs();
    let ends = divided(layers, EVEN.max(EVENLY * width), off);
    if ends.len() < 2 {
        return None;
    }
    let mut from = low;
    let mut slices = Vec::new();
    for end in ends {
        let to = level(end);
        let own: Vec<Point3<f64>> = between(from, to).into_iter().map(Point3::from).collect();
        let own = Mesh::new(own, Vec::new(), Counted::Hull)?;
        let volume = (0..layers)
            .map(|k| 0.5 * (level(k) + level(k + 1)))
            .filter(|z| (from..to).contains(z))
            .map(|z| section(&corners, &faces, z) * (high - low) / layers as f64)
            .sum();
        // The lowest slice has the outline that touches the table.
        let touches = |z: f64| from > low || z <= low + LEVEL;
        let flat = between(low, to).into_iter();
        let points = flat.flat_map(|[x, y, z]| {
            let below = touches(z).then(|| Point3::new(x, y, from));
            below.into_iter().chain([Point3::new(x, y, to)])
        });
        let mesh = Mesh { points: points.collect(), volume, ..own };
        slices.push(Solid {
            outline: Outline::Mesh(Arc::new(mesh)),
            pose: Isometry3::identity(),
            ..solid.clone()
        });
        from = to;
    }
    Some(slices)
}

/// Returns the area of a closed mesh at a height.
fn section(corners: &[[f64; 3]], faces: &[[u32; 3]], z: f64) -> f64 {
    let crossed = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|corner| corners[corner as usize]);
        // Where an edge rises and where it falls through the plane, which gives a direction.
        let edge = |[a, b]: [[f64; 3]; 2]| {
            let share = (z - a[2]) / (b[2] - a[2]);
            let at = Vector::new(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
            ((a[2] < z) != (b[2] < z)).then_some((a[2] < z, at))
        };
        let ends: Vec<(bool, Vector)> =
            [[a, b], [b, c], [c, a]].into_iter().filter_map(edge).collect();
        match ends[..] {
            [(true, p), (_, q)] | [(_, q), (true, p)] => cross(q, p) / 2.0,
            _ => 0.0,
        }
    };
    faces.iter().map(crossed).sum::<f64>().abs()
}

/// Divides layers into the fewest slices whose outlines differ by at most `even` from layer to
/// layer, or into [`MOST`] with the least difference. Returns the end of each slice.
fn divided(layers: usize, even: f64, off: impl Fn(usize, usize) -> f64) -> Vec<usize> {
    // Least difference for the layers before each end, and the start of the last slice.
    let mut best: Vec<Vec<(f64, usize)>> =
        vec![(0..=layers).map(|end| (if end == 0 { 0.0 } else { off(0, end - 1) }, 0)).collect()];
    while best.len() < MOST && best.last().is_some_and(|row| row[layers].0 > even) {
        let before = &best[best.len() - 1];
        let least = |end: usize| {
            let starts = (1..end).map(|start| (before[start].0.max(off(start, end - 1)), start));
            starts.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or(before[end])
        };
        best.push((0..=layers).map(least).collect());
    }
    let mut ends = vec![layers];
    for row in best.iter().skip(1).rev() {
        let start = row[ends[ends.len() - 1]].1;
        ends.push(start);
    }
    ends.retain(|end| *end > 0);
    ends.sort_unstable();
    ends.dedup();
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_divided_where_they_grow() {
        let widths = [1.0, 1.0, 1.0, 3.0, 3.0, 5.0];
        let off = |from: usize, to: usize| widths[to] - widths[from];
        assert_eq!(divided(6, 0.1, off), [3, 5, 6]);
        assert_eq!(divided(6, 2.0, off), [3, 6]);
        assert_eq!(divided(6, 9.0, off), [6]);
    }
}
