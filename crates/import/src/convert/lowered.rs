//! Drawers and doors that hang above the table in the file.
//!
//! A task holds all objects at the height of the table, so they are lowered onto it. Solids that
//! they pass above in the file would then block them and are left out.

use crate::diagnostic::{Effect, Ledger};
use crate::model::{Model, Motion};
use pushplan::geometry::{Pose, Shape, clearance};
use pushplan::scene::Object;

use super::objects::Draft;

/// Height difference that counts as none, metres.
const LEVEL: f64 = 2e-3;

/// Returns `true` for an object that a joint holds at its height.
pub(super) fn hangs(model: &Model, draft: &Draft<'_>) -> bool {
    let motion = &model.bodies[draft.group].motion;
    !(*motion == Motion::Free || motion.is_planar())
}

/// Returns the solids of an object, each with its pose and its height range in the file.
pub(super) fn solids<'d>(
    draft: &'d Draft<'_>,
) -> impl Iterator<Item = (&'d Object, Pose, [f64; 2])> + 'd {
    let own = std::iter::once((&draft.object, draft.object.pose));
    let parts = draft.parts.iter().map(|(part, place)| (part, draft.object.pose * *place));
    own.chain(parts).map(|(solid, pose)| {
        let low = draft.low + solid.z;
        (solid, pose, [low, low + solid.shape.height()])
    })
}

/// Returns `true` if an object passes above a solid with this top in the file, at the start.
pub(super) fn passes(draft: &Draft<'_>, solid: &Object, pose: &Pose, top: f64) -> bool {
    let own = solid.shape.footprint();
    let covers = |(other, at, _): (&Object, Pose, _)| {
        clearance((&own, pose), (&other.shape.footprint(), &at), 1.0) <= 0.0
    };
    top <= draft.low + LEVEL && solids(draft).any(covers)
}

/// Leaves out solids of other objects that hanging objects pass above; solids that stood on them
/// reach down to the table instead, and take over their mass.
pub(super) fn make_way(model: &Model, found: &mut [Draft<'_>], ledger: &mut Ledger) {
    for k in 0..found.len() {
        let below: Vec<bool> = solids(&found[k])
            .map(|(solid, pose, [_, top])| {
                let over =
                    |other: &Draft<'_>| hangs(model, other) && passes(other, solid, &pose, top);
                found.iter().enumerate().any(|(j, other)| j != k && over(other))
            })
            .collect();
        if below.iter().all(|below| !below) || below.iter().all(|below| *below) {
            continue;
        }
        let draft = &mut found[k];
        let all: Vec<(Object, Pose, [f64; 2])> =
            solids(draft).map(|(solid, pose, ends)| (solid.clone(), pose, ends)).collect();
        let mass: f64 = all.iter().map(|(solid, ..)| solid.mass).sum();
        let highest = |wanted: bool| {
            let tops = all.iter().zip(&below).filter(move |(_, below)| **below == wanted);
            tops.map(|((.., [_, top]), _)| *top).fold(f64::NEG_INFINITY, f64::max)
        };
        let gone = highest(true);
        let mut kept: Vec<(Object, Pose)> = all
            .iter()
            .zip(&below)
            .filter(|(_, below)| !**below)
            .map(|((solid, pose, [low, top]), _)| {
                let mut solid = solid.clone();
                if *low <= gone + LEVEL {
                    solid.z = 0.0;
                    match &mut solid.shape {
                        Shape::Cuboid { size } => size[2] = top - draft.low,
                        Shape::Cylinder { height, .. } | Shape::Prism { height, .. } => {
                            *height = top - draft.low;
                        }
                    }
                }
                (solid, *pose)
            })
            .collect();
        kept.sort_by(|(a, _), (b, _)| a.z.total_cmp(&b.z));
        let share = mass / kept.iter().map(|(solid, _)| solid.mass).sum::<f64>();
        kept.iter_mut().for_each(|(solid, _)| solid.mass *= share);
        let name = draft.object.name.clone();
        let mut kept = kept.into_iter();
        let Some((first, pose)) = kept.next() else { continue };
        draft.object = Object { name: name.clone(), pose, whole: None, ..first };
        let part = |(number, (solid, at)): (usize, (Object, Pose))| {
            let name = format!("{name}/{}", number + 1);
            (Object { name, ..solid }, pose.inverse() * at)
        };
        draft.parts = kept.enumerate().map(part).collect();
        let count = below.iter().filter(|below| **below).count();
        let note = format!(
            "{count} solids of `{name}` are left out, because others pass above them on their \
             joints in the file; a task holds all objects at the height of the table"
        );
        ledger.note_as(Effect::Strong, draft.place, note);
    }
}
