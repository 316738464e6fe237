//! Conversion of a body to a tool.

use std::path::Path;

use crate::diagnostic::{Ledger, lines};
use crate::mesh::Mesh;
use crate::model::{Model, Motion};
use pushplan::asset::{Faults, MAX_PARTS, named_after};
use pushplan::geometry::{ConvexPolygon, Shape};
use pushplan::scene::{Part, Tool, ToolError};

use super::draft::{compared, roughly};
use super::groups::{held_by, solid_bodies};
use super::names::{Names, bare, same};
use super::upright::{Base, Upright, flat};
use super::wanted::{Imported, Wanted};

/// Height difference below which undersides of parts are level, metres.
const LEVEL: f64 = 1e-3;

/// Converts a body of a model, with everything fixed to it, to a tool. Frame and grip are the frame
/// of the body; its mass and joints have no effect.
///
/// # Errors
/// Returns a fault for every element that pushplan cannot express, with its place in `file`.
pub fn tool(model: &Model, file: &str, wanted: &Wanted) -> Result<Imported<Tool>, Faults> {
    let mut ledger = Ledger::new(file, &model.files, model.strict);
    ledger.note_all(&model.notes);
    let joined = joined(model);
    let model = &joined;
    let body = chosen(model, wanted, &mut ledger);
    // Only the selected body can cause faults, and the world if no body was named.
    let kept: Vec<usize> = body.map_or_else(Vec::new, |body| model.below(body));
    for (index, other) in model.bodies.iter().enumerate() {
        if kept.contains(&index) {
            ledger.note_all(&other.notes);
        }
        let unnamed = wanted.bodies.is_empty() && (body.is_none() || index == 0);
        match unnamed || kept.contains(&index) {
            true => ledger.take(&other.faults),
            false => ledger.pass_over(&other.faults, &format!("`{}`", other.name)),
        }
    }
    let made = body.and_then(|body| assemble(model, file, body, wanted, &mut ledger));
    if let Some(tool) = &made
        && let Err(faults) = Tool::parse(&tool.to_json().to_string(), file)
    {
        ledger.adopt("tool", faults);
    }
    let (value, notes) = ledger.finish(made)?;
    Ok(Imported { value, notes: lines(notes) })
}

/// Returns the model with the pieces of a mesh file in one body.
fn joined(model: &Model) -> Model {
    let mut model = model.clone();
    if model.pieces {
        for body in &mut model.bodies[2..] {
            (body.parent, body.motion) = (Some(1), Motion::Fixed);
        }
    }
    model
}

/// Returns the default name of the import: the model's name, or the stem of the file.
pub(super) fn name(model: &Model, file: &str) -> String {
    let stem = || Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    named_after(&if model.name.is_empty() { stem() } else { model.name.clone() })
}

/// Returns the body to import as the tool.
fn chosen(model: &Model, wanted: &Wanted, ledger: &mut Ledger) -> Option<usize> {
    let solid = |body: &usize| {
        model.rigid(*body).iter().any(|body| model.bodies[*body].solids.iter().any(|s| s.touches))
    };
    let candidates: Vec<usize> = match &wanted.bodies[..] {
        // The body named `tool`, possibly held by an arm, or the only body.
        [] => {
            let is_tool = |body: &usize| model.name_of(*body) == Model::TOOL && solid(body);
            match (1..model.bodies.len()).find(is_tool) {
                Some(tool) => vec![tool],
                None => model.children(0).filter(solid).collect(),
            }
        }
        asked => (1..model.bodies.len())
            .filter(|body| asked.iter().any(|name| same(name, model.name_of(*body))))
            .collect(),
    };
    match candidates[..] {
        [body] if solid(&body) => return Some(body),
        [body] => {
            let message = format!("no solid of `{}` collides", model.name_of(body));
            ledger.fault(model.bodies[body].place, message, names_them(model));
        }
        [] => {
            let message = match wanted.bodies.first() {
                Some(asked) => format!("no body is called `{asked}`"),
                None => "no body of the file has a solid that collides".to_owned(),
            };
            ledger.fault_of_file(message, names_them(model));
        }
        _ => {
            let message =
                format!("there are {} bodies, but a tool is a single one", candidates.len());
            ledger.fault_of_file(message, names_them(model));
        }
    }
    None
}

/// Lists the bodies that can be imported as the tool.
fn names_them(model: &Model) -> String {
    match &solid_bodies(model)[..] {
        [] => {
            "pushplan's tools are solids with collision: <geom>, <collision>, or a mesh".to_owned()
        }
        names => format!("select one with --body: {}", names.join(", ")),
    }
}

fn assemble(
    model: &Model,
    file: &str,
    body: usize,
    wanted: &Wanted,
    ledger: &mut Ledger,
) -> Option<Tool> {
    let bodies = model.rigid(body);
    for child in (body + 1)..model.bodies.len() {
        let other = &model.bodies[child];
        let moves = other.parent.is_some_and(|parent| bodies.contains(&parent))
            && other.motion != Motion::Fixed;
        if moves {
            let how = held_by(&other.motion);
            let message = format!("`{}` moves relative to the tool, by {how}", other.name);
            let advice = "a tool is one rigid body: fix it, remove it, or select one with --body";
            ledger.fault(other.place, message, advice);
        }
    }
    let frame = flat(&model.bodies[body].pose).inverse();
    let (mut parts, mut names) = (Vec::new(), Names::default());
    let mut outlines = Vec::new();
    let (mut frictions, mut lows) = (Vec::new(), Vec::new());
    let solids = bodies.iter().flat_map(|body| {
        let of = &model.bodies[*body];
        of.solids.iter().filter(|solid| solid.touches).map(|solid| (of.name.as_str(), solid))
    });
    // Checked first, because thousands of parts would be compared pairwise.
    let count = solids.clone().count();
    if count > MAX_PARTS {
        let message =
            format!("the tool has {count} solids with collision; the limit is {MAX_PARTS} parts");
        ledger.fault(model.bodies[body].place, message, "remove those that meet no object");
        return None;
    }
    for (of, solid) in solids {
        let name = names.take(if solid.name.is_empty() { of } else { &solid.name });
        let Some(upright) = Upright::of(solid, &format!("`{name}`"), ledger) else { continue };
        outlines.push(upright.corners());
        if let Some(rough) = &upright.rough {
            roughly(&name, (&upright, solid, count == 1), rough, ledger);
        }
        let height = upright.height;
        let mut pose = frame * upright.pose;
        let shape = match &upright.base {
            Base::Rectangle([x, y]) => Shape::Cuboid { size: [*x, *y, height] },
            Base::Disc(radius) => Shape::Cylinder { radius: *radius, height },
            Base::Polygon(corners) => match ConvexPolygon::new(corners) {
                Ok(base) => {
                    pose.position = pose.point(upright.middle());
                    Shape::Prism { base, height }
                }
                Err(error) => {
                    let message =
                        format!("`{name}` is not a prism that pushplan supports: {error}");
                    ledger.fault(solid.place, message, "replace it by a box or a cylinder");
                    continue;
                }
            },
        };
        frictions.push((solid.place, solid.material.friction.unwrap_or(wanted.friction)));
        lows.push((solid.place, name.clone(), upright.low));
        parts.push(Part { name, shape, pose });
    }
    let surfaces: Vec<&Mesh> =
        bodies.iter().filter_map(|body| model.bodies[*body].surface.as_deref()).collect();
    if !surfaces.is_empty() && count > 1 {
        let name = bare(model.name_of(body));
        ledger.note(model.bodies[body].place, compared(name, &surfaces, &outlines));
    }
    let low = lows.iter().map(|(.., low)| *low).fold(f64::INFINITY, f64::min);
    for (place, name, own) in lows.iter().filter(|(.., own)| own - low > LEVEL) {
        let message = format!("`{name}` begins {:.1} mm above the lowest part", 1e3 * (own - low));
        let advice = "parts of a tool stand side by side: extend it down, or disable its collision \
                      if it meets no object";
        ledger.fault(*place, message, advice);
    }
    let (_, friction) = *frictions.first()?;
    if let Some((place, other)) = frictions.iter().find(|(_, other)| *other != friction) {
        let message = format!("parts have different frictions, {friction} and {other}");
        ledger.fault(*place, message, "a tool has a single friction value; use one for all parts");
    }
    let name = match &wanted.name {
        Some(name) => name.clone(),
        // The name of a scene does not describe one of its bodies.
        None if wanted.bodies.is_empty() && !model.ours => self::name(model, file),
        None => named_after(bare(model.name_of(body))),
    };
    // Parts that do not touch are also rigidly connected in the file.
    let joined = match Tool::new(name.clone(), parts.clone()) {
        Err(ToolError::Apart { .. }) => {
            let pairs: Vec<[usize; 2]> = (1..parts.len()).map(|part| [0, part]).collect();
            Tool::joined(name, parts, &pairs)
        }
        made => made,
    };
    match joined {
        Ok(tool) => Some(tool.friction(friction)),
        Err(error) => {
            ledger.fault(model.bodies[body].place, error.to_string(), "");
            None
        }
    }
}
