//! Import of a mesh file as one free body.

use std::path::Path;
use std::sync::Arc;

use nalgebra::{Isometry3, Point3};

use crate::Language;
use crate::model::{Body, Material, Model, Motion, Outline, Place, Solid};
use pushplan::asset::{Fault, Faults};
use pushplan::geometry::convex_parts;

use super::bulk::{Counted, Mesh};
use super::read::load;

/// Minimum and maximum length of an object on a table, metres along its longest side.
const SIZES: [f64; 2] = [0.004, 2.0];

/// Likely length of an object: it fits in a hand, metres.
const LIKELY: [f64; 2] = [0.02, 0.6];

/// Units of drawings, metres.
const UNITS: [(&str, f64); 4] = [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("in", 0.0254)];

/// Fill ratio of the convex hull above which a mesh counts as convex.
const CONVEX: f64 = 0.97;

/// Returns the language of a mesh file by its extension.
pub(crate) fn language(path: &Path) -> Option<Language> {
    match path.extension()?.to_string_lossy().to_lowercase().as_str() {
        "stl" => Some(Language::Stl),
        "obj" => Some(Language::Obj),
        _ => None,
    }
}

/// Reads a mesh as a body, with notes.
pub(crate) fn model(path: &Path, _: Language, unit: f64) -> Result<(Model, Vec<String>), Faults> {
    let file = path.display().to_string();
    let fault = |message: String, advice: String| Fault::of_file(&file, message, advice);
    let (mut points, faces) =
        load(path).map_err(|refused| fault(refused.message, refused.advice))?;
    points.iter_mut().for_each(|point| *point *= unit);
    let side = longest(&points);
    if !(SIZES[0]..=SIZES[1]).contains(&side) {
        let message =
            format!("its longest side is {side} m, which is too large for an object on a table");
        let likely = UNITS.iter().find(|(_, other)| {
            (LIKELY[0]..=LIKELY[1]).contains(&(side / unit * other)) && *other != unit
        });
        let advice = match likely {
            Some((word, other)) => {
                format!("give its unit: --unit {word} makes it {:.3} m", side / unit * other)
            }
            None => "give its unit: --unit mm, cm, m or in".to_owned(),
        };
        return Err(fault(message, advice).into());
    }
    let mut notes = Vec::new();
    let made = |counted| Mesh::new(points.clone(), faces.clone(), counted);
    let mut mesh = made(Counted::Enclosed);
    if !mesh.as_ref().is_some_and(Mesh::is_closed) {
        notes.push(format!(
            "{file}: the mesh is not closed, so the volume of its convex hull is used"
        ));
        mesh = made(Counted::Hull);
    }
    let Some(mesh) = mesh.filter(|mesh| mesh.volume > 0.0) else {
        let advice = "is this the right file?".to_owned();
        return Err(fault("the mesh is flat or contains invalid numbers".to_owned(), advice).into());
    };
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
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
    let body = Body {
        name: name.clone(),
        place,
        parent: Some(0),
        motion: Motion::Free,
        solids,
        weighs: Some((mesh.volume, mesh.middle)),
        ..Body::world()
    };
    let bodies = vec![Body::world(), body];
    Ok((Model { name, files: vec![file], bodies, ..Model::default() }, notes))
}

/// Decomposes a mesh that is far from convex into convex parts.
fn parts(mesh: &Mesh) -> Option<Vec<Mesh>> {
    if !mesh.is_closed() || mesh.volume > CONVEX * mesh.hull_volume() {
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
