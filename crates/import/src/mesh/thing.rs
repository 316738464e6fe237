//! Import of a mesh file: a free body for each piece that stands apart.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use nalgebra::{Isometry3, Point3};

use crate::convert::is_convex_above;
use crate::diagnostic::{Effect, Ledger};
use crate::model::{Body, Material, Model, Motion, Outline, Place, Solid};
use crate::{Language, Reading};
use pushplan::asset::{Fault, Faults};
use pushplan::geometry::convex_parts;
use pushplan::scene::DisjointSets;

use super::bulk::{Counted, Faces, Mesh};
use super::read::load_upright;

/// Minimum and maximum length of an object on a table, metres along its longest side.
const SIZES: [f64; 2] = [0.004, 2.0];

/// Likely length of an object: it fits in a hand, metres.
const LIKELY: [f64; 2] = [0.02, 0.6];

/// Units of drawings, metres.
const UNITS: [(&str, f64); 4] = [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("in", 0.0254)];

/// Gap above which pieces of a file stand apart: metres, and relative to the longest side.
const APART: f64 = 1e-3;
const FAR: f64 = 0.02;

/// Maximum height of a separate body above the lowest one, metres.
const STANDS: f64 = 5e-3;

/// Maximum number of separate bodies in a file.
const MOST: usize = 32;

/// Fill ratio of the convex hull above which a mesh counts as convex.
const CONVEX: f64 = 0.97;

/// Returns the language of a mesh file by its extension.
pub(crate) fn language(path: &Path) -> Option<Language> {
    match path.extension()?.to_string_lossy().to_lowercase().as_str() {
        "stl" => Some(Language::Stl),
        "obj" => Some(Language::Obj),
        "dae" => Some(Language::Dae),
        _ => None,
    }
}

/// Reads a mesh file.
pub(crate) fn model(path: &Path, reading: &Reading) -> Result<Model, Faults> {
    let file = path.display().to_string();
    let fault = |message: String, advice: &str| Fault::of_file(&file, message, advice);
    let mut ledger = Ledger::new(&file, &[], reading.strict);
    let (mut points, faces) =
        load_upright(path).map_err(|refused| fault(refused.message, &refused.advice))?;
    let unit =
        unit(&points, reading, &mut ledger).map_err(|(message, advice)| fault(message, &advice))?;
    points.iter_mut().for_each(|point| *point *= unit);
    let side = longest(&points);
    let whole = solid((points, faces), side);
    let pieces = whole.as_ref().map_or_else(Vec::new, |whole| apart(whole, side));
    let Some(whole) = whole.filter(|mesh| mesh.volume > 0.0) else {
        let message = "the mesh is flat or contains invalid numbers".to_owned();
        return Err(fault(message, "is this the right file?").into());
    };
    let count = pieces.len();
    let meshes = if count > 1 { pieces } else { vec![whole] };
    if count > 1 {
        let message = format!("the file has {count} separate solids, which become separate bodies");
        ledger.note_of_file(Effect::Some, message);
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut bodies = vec![Body::world()];
    for (k, mesh) in meshes.into_iter().enumerate() {
        if !mesh.is_closed() {
            let message = "the mesh is not closed, so the volume of its convex hull is used";
            ledger.note_of_file(Effect::Some, message);
        }
        let name = if k == 0 { name.clone() } else { format!("{name}-{}", k + 1) };
        bodies.push(body(name, mesh));
    }
    let (pieces, strict, notes) = (count > 1, reading.strict, ledger.notes_since(0));
    Ok(Model { name, files: vec![file], bodies, notes, pieces, strict, ..Model::default() })
}

/// Returns the unit of a mesh, metres, with a note if it is assumed; or the fault and its advice.
fn unit(
    points: &[Point3<f64>],
    reading: &Reading,
    ledger: &mut Ledger,
) -> Result<f64, (String, String)> {
    let stated = reading.unit.unwrap_or(1.0);
    let side = longest(points);
    if (SIZES[0]..=SIZES[1]).contains(&(stated * side)) {
        return Ok(stated);
    }
    let size = if stated * side > SIZES[1] { "large" } else { "small" };
    let message = format!(
        "its longest side is {} m, which is too {size} for an object on a table",
        stated * side
    );
    let is_likely = |(_, unit): &&(&str, f64)| {
        (LIKELY[0]..=LIKELY[1]).contains(&(side * unit)) && *unit != stated
    };
    let Some((word, unit)) = UNITS.iter().find(is_likely) else {
        return Err((message, "give its unit: --unit mm, cm, m or in".to_owned()));
    };
    let note = format!("{message}: it is taken for {word}, {:.3} m", side * unit);
    if reading.unit.is_none() && ledger.assume(Effect::Strong, None, note) {
        return Ok(*unit);
    }
    Err((message, format!("give its unit: --unit {word} makes it {:.3} m", side * unit)))
}

/// Returns the mesh of triangles; the convex hull has its volume if it is not closed.
fn solid((points, faces): Faces, side: f64) -> Option<Mesh> {
    let made = |counted| Mesh::new(points.clone(), faces.clone(), counted);
    let closed = made(Counted::Enclosed).filter(Mesh::is_closed);
    closed.filter(|mesh| mesh.volume > 1e-9 * side.powi(3)).or_else(|| made(Counted::Hull))
}

/// Returns the parts of a mesh that stand apart from each other, each of them on the table; none if
/// there is only one, or if one of them could not stand by itself.
fn apart(whole: &Mesh, side: f64) -> Vec<Mesh> {
    let gap = APART.max(FAR * side);
    let pieces = Mesh::pieces(&whole.points, &whole.faces);
    if !(2..=20_000).contains(&pieces.len()) {
        return Vec::new();
    }
    let ends = |(points, _): &Faces| {
        let end = |k: usize, pick: fn(f64, f64) -> f64, from: f64| {
            points.iter().map(|point| point[k]).fold(from, pick)
        };
        [0, 1, 2].map(|k| [end(k, f64::min, f64::INFINITY), end(k, f64::max, f64::NEG_INFINITY)])
    };
    let boxes: Vec<[[f64; 2]; 3]> = pieces.iter().map(ends).collect();
    let meet = |a: usize, b: usize| {
        (0..3)
            .all(|k| boxes[a][k][0] < boxes[b][k][1] + gap && boxes[b][k][0] < boxes[a][k][1] + gap)
    };
    // Pieces whose boxes come near form one body, such as the inside and the outside of a bottle.
    let mut sets = DisjointSets::new(pieces.len());
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|a, b| boxes[*a][0][0].total_cmp(&boxes[*b][0][0]));
    for (k, a) in order.iter().enumerate() {
        let near = order[k + 1..].iter().take_while(|b| boxes[**b][0][0] < boxes[*a][0][1] + gap);
        near.filter(|b| meet(*a, **b)).for_each(|b| {
            sets.join([*a, *b]);
        });
    }
    let mut groups: BTreeMap<usize, Faces> = BTreeMap::new();
    for (name, (points, faces)) in sets.names().iter().zip(pieces) {
        let (corners, sides) = groups.entry(*name).or_default();
        let first = corners.len() as u32;
        corners.extend(points);
        sides.extend(faces.into_iter().map(|face| face.map(|corner| first + corner)));
    }
    let low = boxes.iter().map(|ends| ends[2][0]).fold(f64::INFINITY, f64::min);
    let stands = |(points, _): &Faces| points.iter().any(|point| point.z < low + STANDS);
    if !(2..=MOST).contains(&groups.len()) || !groups.values().all(stands) {
        return Vec::new();
    }
    let big = |mesh: &Mesh| mesh.volume > 0.0 && longest(&mesh.points) > SIZES[0];
    let meshes: Option<Vec<Mesh>> =
        groups.into_values().map(|group| solid(group, side).filter(big)).collect();
    meshes.unwrap_or_default()
}

fn body(name: String, mesh: Mesh) -> Body {
    let place = Place { file: 0, line: 1, column: 1 };
    let solid = |mesh: Mesh| Solid {
        name: String::new(),
        place,
        outline: Outline::Mesh(Arc::new(mesh)),
        pose: Isometry3::identity(),
        material: Material::of_body(None),
        touches: true,
    };
    let solids = match parts(&mesh) {
        Some(parts) => parts.into_iter().map(&solid).collect(),
        None => vec![solid(mesh.clone())],
    };
    Body {
        name,
        place,
        parent: Some(0),
        motion: Motion::Free,
        solids,
        weighs: Some((mesh.volume, mesh.middle)),
        surface: Some(Arc::new(mesh)),
        ..Body::world()
    }
}

/// Decomposes a mesh that is far from convex into convex parts.
fn parts(mesh: &Mesh) -> Option<Vec<Mesh>> {
    // A tool meets the outline alone, so that a bowl need not be divided.
    let convex = mesh.volume > CONVEX * mesh.hull_volume() || is_convex_above(mesh);
    if !mesh.is_closed() || convex {
        return None;
    }
    let points: Vec<[f64; 3]> = mesh.points.iter().map(|point| point.coords.into()).collect();
    let parts = convex_parts(&points, &mesh.faces);
    let part = |points: Vec<[f64; 3]>| {
        Mesh::new(points.into_iter().map(Point3::from).collect(), Vec::new(), Counted::Hull)
    };
    let parts: Vec<Mesh> = parts.into_iter().filter_map(part).collect();
    (parts.len() > 1).then_some(parts)
}

fn longest(points: &[Point3<f64>]) -> f64 {
    let extent = |axis: usize| {
        let numbers = || points.iter().map(|point| point[axis]);
        numbers().fold(f64::NEG_INFINITY, f64::max) - numbers().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(extent).fold(0.0, f64::max)
}
