//! Conversion of bodies fixed to each other to one object, compound if it has several solids.

use crate::diagnostic::{Effect, Ledger};
use crate::mesh::Mesh;
use crate::model::Model;
use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::scene::{Object, Support, Whole, bearings, hanging};

use super::admitted::{
    FRICTIONS, MASS, Owned, is_sphere, on_feet, stated, without_flat, without_points,
};
use super::draft::{SEEN, Standing, compared, draft};
use super::names::{Names, bare};
use super::objects::Draft;
use super::pieces::{MOST, fewer};
use super::upright::{Upright, volume};
use super::wanted::Wanted;
use super::weighed::{NOTHING, balanced, of_body, of_solid, together};

/// Height above the lowest solid beyond which a solid counts as raised, metres.
const HANGS: f64 = 1e-3;

/// Error of the centre of mass that deserves a note, metres.
const OFF: f64 = 1e-3;

/// Minimum mass of a part that a task can state, kg.
const LEAST: f64 = 1.1e-3;

/// Maximum number of solids of an object.
const MANY: usize = 300;

/// Returns the objects of bodies that are fixed to each other: one object, or separate objects for
/// files written by pushplan.
pub(super) fn of_group<'a>(
    model: &'a Model,
    group: usize,
    bodies: &[usize],
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Vec<Draft<'a>> {
    let touching = |body: &usize| {
        let body = *body;
        model.bodies[body].solids.iter().filter(|s| s.touches).map(move |solid| (body, solid))
    };
    let all: Vec<Owned<'a>> = bodies.iter().flat_map(touching).collect();
    let owner = &model.bodies[group];
    // Files written by pushplan have feet.
    let all = match model.ours {
        true => all,
        false => without_points(without_flat(all, ledger), ledger),
    };
    let mut solids: Vec<Owned<'a>> =
        all.iter().copied().filter(|(_, solid)| !is_sphere(solid)).collect();
    let Some((_, first)) = all.first() else {
        let message = format!("`{}` has no solid that collides", owner.name);
        let advice = "give it a box, a cylinder or a mesh with collision";
        ledger.fault(owner.place, message, advice);
        return Vec::new();
    };
    if all.len() > MANY {
        let message = format!("`{}` has {} solids; the limit is {MANY}", owner.name, all.len());
        ledger.fault(owner.place, message, "is this a single object on a table?");
        return Vec::new();
    }
    if all.len() == 1 || solids.is_empty() && all.len() < 3 {
        solids = vec![(all[0].0, first)];
    }
    // Spheres are the support points of a single solid; otherwise they are ordinary solids.
    let one_each =
        bodies.iter().all(|body| solids.iter().filter(|(owner, _)| owner == body).count() <= 1);
    if !(one_each && (model.ours || solids.len() == 1 && on_feet(&all))) && all.len() > 1 {
        solids = all.clone();
    }
    let single = solids.len() == 1;
    let mut found: Vec<(Standing<'a>, f64, usize)> = Vec::new();
    for (body, solid) in &solids {
        let name = format!("`{}`", owner.name);
        let upright = match single || model.ours {
            true => Upright::of(solid, &name, ledger),
            false => Upright::any(solid, &name, ledger),
        };
        let feet = all.iter().filter(|(owner, foot)| owner == body && is_sphere(foot));
        let kept = solids.len() < all.len();
        let feet = feet.map(|(_, foot)| *foot).filter(|_| kept).collect();
        let Some(upright) = upright else { continue };
        found.push((Standing { upright, solid, feet, alone: single, whole: single }, 0.0, *body));
    }
    if found.len() < solids.len() {
        return Vec::new();
    }
    if model.ours && !single {
        return one_where_raised(apart(model, group, found, wanted, names, ledger));
    }
    let Some(weighed) = together(model, bodies, wanted.density, ledger) else { return Vec::new() };
    if weighed.0 <= NOTHING {
        let message = format!("`{}` has no mass", owner.name);
        let advice = "state its mass in kilograms (<inertial>), or its density, such as --density \
                      700 (kg/m^3, wood)";
        ledger.fault(owner.place, message, advice);
        return Vec::new();
    }
    let mass = stated(weighed.0, [MASS, f64::INFINITY], "kg", owner, ledger);
    let weighed = (mass, weighed.1, weighed.2);
    let name = names.take(if single { &model.bodies[found[0].2].name } else { &owner.name });
    let place = found[0].0.solid.place;
    let Some((standing, _, body)) = (if single { found.pop() } else { None }) else {
        return compound(model, (group, &name), bodies, found, weighed, wanted, ledger)
            .into_iter()
            .collect();
    };
    let friction = standing.solid.material.friction.unwrap_or(wanted.friction);
    let friction = stated(friction, FRICTIONS, "of friction", owner, ledger);
    let drafted = draft(&name, &standing, weighed, friction, ledger);
    let Standing { solid, feet, .. } = standing;
    let drafted = drafted.map(|(object, low)| Draft {
        object,
        parts: Vec::new(),
        place,
        body,
        group,
        solid,
        feet,
        low,
    });
    drafted.into_iter().collect()
}

/// Returns one object per solid for bodies fixed together in a file written by pushplan.
fn apart<'a>(
    model: &'a Model,
    group: usize,
    found: Vec<(Standing<'a>, f64, usize)>,
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Vec<Draft<'a>> {
    let mut drafts = Vec::new();
    for (standing, _, body) in found {
        let of = &model.bodies[body];
        let Some(weighed) = of_body(of, wanted.density, ledger) else { continue };
        let name = names.take(&of.name);
        let friction = standing.solid.material.friction.unwrap_or(wanted.friction);
        let standing = Standing { alone: true, whole: true, ..standing };
        let drafted = draft(&name, &standing, weighed, friction, ledger);
        let Standing { solid, feet, .. } = standing;
        drafts.extend(drafted.map(|(object, low)| Draft {
            object,
            parts: Vec::new(),
            place: solid.place,
            body,
            group,
            solid,
            feet,
            low,
        }));
    }
    drafts
}

/// Merges the objects into a compound object if some are above the table, because separate objects
/// would all have to stand.
fn one_where_raised(mut drafts: Vec<Draft<'_>>) -> Vec<Draft<'_>> {
    let low = drafts.iter().map(|draft| draft.low).fold(f64::MAX, f64::min);
    if drafts.iter().all(|draft| draft.low - low <= HANGS) {
        return drafts;
    }
    drafts.sort_by_key(|draft| draft.low - low > HANGS);
    let mut drafts = drafts.into_iter();
    let Some(mut first) = drafts.next() else { return Vec::new() };
    let (pose, thing) = (first.object.pose.inverse(), first.object.name.clone());
    first.parts = drafts
        .map(|Draft { object, low: own, .. }| {
            let z = if own - low > HANGS { own - low } else { 0.0 };
            // Restores the name of the part before the slash was replaced.
            let own = object.name.strip_prefix(&format!("{thing}-")).unwrap_or(&object.name);
            let part = Object { name: format!("{thing}/{own}"), z, ..object.clone() };
            (part, pose * object.pose)
        })
        .collect();
    vec![first]
}

/// Returns several solids as a compound object.
fn compound<'a>(
    model: &'a Model,
    (group, name): (usize, &str),
    bodies: &[usize],
    mut found: Vec<(Standing<'a>, f64, usize)>,
    (mass, centre, _): super::weighed::Weighed,
    wanted: &Wanted,
    ledger: &mut Ledger,
) -> Option<Draft<'a>> {
    let place = model.bodies[group].place;
    shares(model, bodies, &mut found, wanted, ledger)?;
    let sum: f64 = found.iter().map(|(_, share, _)| share).sum();
    found.iter_mut().for_each(|(_, share, _)| *share *= mass / sum);
    let body = found[0].2;
    let before = found.len();
    let weighed = found.into_iter().map(|(standing, share, _)| (standing, share)).collect();
    let (mut pieces, more) = fewer(weighed);
    if pieces.len() > MOST {
        let message =
            format!("`{name}` has {} solids; a task can have at most {MOST}", pieces.len());
        ledger.fault(place, message, "remove those that matter least");
        return None;
    }
    let surfaces: Vec<&Mesh> =
        bodies.iter().filter_map(|body| model.bodies[*body].surface.as_deref()).collect();
    if !surfaces.is_empty() {
        let outlines: Vec<Vec<Vector>> =
            pieces.iter().map(|(piece, _)| piece.upright.corners()).collect();
        ledger.note(place, compared(name, &surfaces, &outlines));
    } else if pieces.len() < before {
        let (count, more) = (pieces.len(), 100.0 * more);
        let note = format!(
            "the {before} solids of `{name}` are merged into {count}, which cover {more:.1} % more \
             of the table"
        );
        ledger.note(place, note);
    }
    let rough = pieces.iter().filter_map(|(piece, _)| piece.upright.rough.as_ref());
    let off = rough.map(|rough| rough.off).fold(0.0, f64::max);
    if surfaces.is_empty() && off >= SEEN {
        let off = 1e3 * off;
        let note = format!("the solids of `{name}` have sides that deviate by up to {off:.1} mm");
        ledger.note(place, note);
    }
    let lows = pieces.iter().map(|(piece, _)| piece.upright.low);
    let low = lows.clone().fold(f64::INFINITY, f64::min);
    // Standing solids come first.
    pieces.sort_by_key(|(piece, _)| piece.upright.low - low > HANGS);
    let friction = pieces[0].0.solid.material.friction.unwrap_or(wanted.friction);
    let friction = stated(friction, FRICTIONS, "of friction", &model.bodies[group], ledger);
    let other = pieces.iter().map(|(piece, _)| piece.solid.material.friction);
    if other.flatten().any(|other| other != friction) {
        let note = format!("solids of `{name}` have several frictions; {friction} is used for all");
        ledger.note(place, note);
    }
    let mut masses: Vec<f64> = pieces.iter().map(|(_, share)| *share).collect();
    let middles: Vec<Vector> =
        pieces.iter().map(|(piece, _)| piece.upright.pose.point(piece.upright.middle())).collect();
    let centre = centre.map(|centre| Vector::new(centre.x, centre.y));
    // Masses too small to be stated are raised, which shifts the centre again, so both steps are
    // repeated.
    for _ in 0..8 {
        if let Some(centre) = centre {
            balanced(&mut masses, &middles, centre);
        }
        heavier(&mut masses);
    }
    let stands = pieces.iter().filter(|(piece, _)| piece.upright.low - low <= HANGS).count();
    let (mut objects, mut undersides): (Vec<Object>, Vec<f64>) = (Vec::new(), Vec::new());
    for ((mut piece, _), mass) in pieces.into_iter().zip(masses) {
        let upright = &mut piece.upright;
        if upright.low > low && upright.low - low <= HANGS {
            upright.height = upright.top() - low;
            upright.low = low;
        }
        // The contact area of the only standing solid carries the object.
        piece.alone = stands == 1 && objects.is_empty() && piece.upright.rough.is_some();
        let called = match objects.len() {
            0 => name.to_owned(),
            number => format!("{name}/{number}"),
        };
        let (object, underside) = draft(&called, &piece, (mass, None, None), friction, ledger)?;
        let support = if piece.alone { object.support } else { Support::Even };
        objects.push(Object { support, ..object });
        undersides.push(underside);
        if objects.len() == 1 {
            objects[0].name = name.to_owned();
        }
    }
    by_volume(&mut objects);
    if let Some(hangs) = raised(&mut objects, &undersides) {
        let note = format!(
            "solids of `{name}` begin up to {:.0} mm above the lowest one without support; all are \
             extended down to it",
            1e3 * hangs
        );
        ledger.note(place, note);
    }
    if let Some(centre) = centre {
        let moment = objects.iter().zip(&middles).map(|(solid, middle)| solid.mass * middle);
        let off = (moment.sum::<Vector>() / mass - centre).norm();
        if off > OFF {
            let by = 1e3 * off;
            let note = format!("the imported centre of mass of `{name}` deviates by {by:.1} mm");
            ledger.note(place, note);
        }
    }
    let mut objects = objects.into_iter();
    let object = objects.next()?;
    let part = |part: Object| {
        let place: Pose = object.pose.inverse() * part.pose;
        (part, place)
    };
    let parts = objects.map(part).collect();
    let (_, solid) = bodies
        .iter()
        .flat_map(|body| model.bodies[*body].solids.iter().map(move |solid| (body, solid)))
        .find(|(_, solid)| solid.touches)?;
    Some(Draft { object, parts, place, body, group, solid, feet: Vec::new(), low })
}

/// Raises solids to the heights of their undersides above the first solid, metres. If some would
/// then be unsupported or tip the object over, all are extended down to the table instead, and the
/// maximum extension is returned.
fn raised(solids: &mut [Object], undersides: &[f64]) -> Option<f64> {
    let lowest = undersides.iter().copied().fold(f64::MAX, f64::min);
    let first = solids.first()?.pose;
    for (solid, underside) in solids.iter_mut().zip(undersides).skip(1) {
        let z = underside - lowest;
        let whole = Whole { object: 0, place: first.inverse() * solid.pose };
        solid.whole = Some(whole);
        solid.z = if z > HANGS { z } else { 0.0 };
    }
    let stays = || bearings(&solids.iter().collect::<Vec<_>>()).is_some();
    let most = solids.iter().map(|solid| solid.z).fold(0.0, f64::max);
    if most == 0.0 || hanging(solids).is_empty() && stays() {
        return None;
    }
    for solid in solids.iter_mut() {
        let top = solid.top();
        match &mut solid.shape {
            Shape::Cuboid { size } => size[2] = top,
            Shape::Cylinder { height, .. } | Shape::Prism { height, .. } => *height = top,
        }
        solid.z = 0.0;
    }
    Some(most)
}

/// Raises masses (kg) that are too small for a task, and reduces the others accordingly.
fn heavier(masses: &mut [f64]) {
    let sum: f64 = masses.iter().sum();
    let missing: f64 = masses.iter().map(|mass| (LEAST - mass).max(0.0)).sum();
    if missing == 0.0 || sum < 2.0 * LEAST * masses.len() as f64 {
        return;
    }
    let above: f64 = masses.iter().map(|mass| (mass - LEAST).max(0.0)).sum();
    for mass in masses.iter_mut() {
        *mass = LEAST + (*mass - LEAST).max(0.0) * (1.0 - missing / above);
    }
}

/// Replaces all masses by shares proportional to volume if some are still too small; such shares
/// need not be stated.
fn by_volume(solids: &mut [Object]) {
    if solids.iter().all(|solid| solid.mass >= 0.95 * LEAST) {
        return;
    }
    let sum: f64 = solids.iter().map(|solid| solid.mass).sum();
    let volume = |solid: &Object| solid.shape.footprint().area() * solid.shape.height();
    let all: f64 = solids.iter().map(volume).sum();
    for solid in solids.iter_mut() {
        solid.mass = sum * (volume(solid) / all);
    }
}

/// Assigns masses to solids: stated masses, or shares of the body's mass proportional to volume.
fn shares<'a>(
    model: &'a Model,
    bodies: &[usize],
    found: &mut [(Standing<'a>, f64, usize)],
    wanted: &Wanted,
    ledger: &mut Ledger,
) -> Option<()> {
    for body in bodies {
        let of = &model.bodies[*body];
        let own: Vec<usize> = (0..found.len()).filter(|k| found[*k].2 == *body).collect();
        // Visual solids also have mass; it is distributed over the collision solids.
        let (mass, ..) = of_body(of, wanted.density, ledger)?;
        let space: Vec<f64> =
            own.iter().map(|k| volume(found[*k].0.solid).unwrap_or_default()).collect();
        let all: f64 = space.iter().sum();
        if of.inertial.is_some() && of.surface.is_none() && own.len() > 1 {
            let note =
                format!("the mass of `{}` is divided among its solids by volume", bare(&of.name));
            ledger.note_as(Effect::Slight, of.place, note);
        }
        for (k, space) in own.into_iter().zip(space) {
            let share = match of.inertial.is_some() || of.weighs.is_some() {
                true if all > 0.0 => mass * space / all,
                true => 0.0,
                false => of_solid(found[k].0.solid, wanted.density, ledger)?,
            };
            found[k].1 += share;
        }
    }
    // Every solid needs a positive mass.
    let least = 1e-3 * found.iter().map(|(_, share, _)| *share).fold(0.0, f64::max);
    if least == 0.0 {
        for (standing, share, _) in found.iter_mut() {
            *share = volume(standing.solid).unwrap_or(1e-6).max(1e-9);
        }
    }
    found.iter_mut().for_each(|(_, share, _)| *share = share.max(least));
    Some(())
}
