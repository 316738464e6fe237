//! Selection of the wanted bodies, and of the bodies fixed to each other.

use crate::diagnostic::Ledger;
use crate::model::{Model, Motion};

use super::joints::may_mount;
use super::names::{bare, same};
use super::wanted::Wanted;

/// Returns the model with the bodies of `wanted.free` detached from the world.
pub(super) fn freed(model: &Model, wanted: &Wanted, ledger: &mut Ledger) -> Model {
    let mut model = model.clone();
    for asked in &wanted.free {
        let named = |body: &usize| same(asked, model.name_of(*body));
        let Some(body) = (1..model.bodies.len()).find(named) else {
            let names = solid_bodies(&model);
            let advice = format!("bodies with solids are {}", listed(&names));
            ledger.fault_of_file(format!("no body is called `{asked}`"), advice);
            continue;
        };
        model.bodies[body].motion = Motion::Free;
        model.bodies[body].parent = Some(0);
    }
    model
}

/// Returns the names of the bodies that have collision solids.
pub(super) fn solid_bodies(model: &Model) -> Vec<&str> {
    let touches = |body: &&crate::model::Body| body.solids.iter().any(|s| s.touches);
    model.bodies.iter().skip(1).filter(touches).map(|body| bare(&body.name)).collect()
}

/// Lists names for use in a sentence.
pub(super) fn listed(names: &[&str]) -> String {
    match names {
        [] => "none".to_owned(),
        _ if names.len() <= 12 => names.join(", "),
        _ => format!("{} and {} more", names[..12].join(", "), names.len() - 12),
    }
}

/// Returns the bodies that stand freely on the table or have a joint to the world that a task can
/// express, in order. Other movable bodies are left out with a fault, unwanted ones with a note.
pub(super) fn free(model: &Model, wanted: &Wanted, ledger: &mut Ledger) -> Vec<usize> {
    let fixed = model.rigid(0);
    let mut found = Vec::new();
    let (mut asked_for, mut others) = (Vec::new(), Vec::new());
    for (index, body) in model.bodies.iter().enumerate() {
        let hangs = body.parent.is_some_and(|parent| fixed.contains(&parent));
        if !hangs || body.motion == Motion::Fixed {
            continue;
        }
        let freed = wanted.free.iter().any(|name| same(name, &body.name));
        if !wanted.takes(&body.name) && !freed {
            others.push(bare(&body.name));
            continue;
        }
        asked_for.push(body.name.as_str());
        match &body.motion {
            Motion::Free => found.push(index),
            motion if motion.is_planar() => {
                let note = format!(
                    "`{}` slides and rotates on the table: it is imported as a free object, \
                     without the limits of its joints",
                    body.name
                );
                ledger.note(body.place, note);
                found.push(index);
            }
            _ if model.ours && body.name == Model::TOOL && wanted.bodies.is_empty() => {
                ledger.note(body.place, "the tool is not imported here; use `--as tool`");
            }
            motion if may_mount(motion) => found.push(index),
            motion => {
                let how = held_by(motion);
                let message = format!("`{}` is attached to the world by {how}", body.name);
                let advice = "objects must be free (--free NAME, a <freejoint/>), rotate about \
                              the vertical or slide along the table; select bodies with --body";
                ledger.fault(body.place, message, advice);
            }
        }
    }
    for asked in &wanted.bodies {
        if !asked_for.iter().any(|name| same(asked, name)) {
            let held = (1..model.bodies.len()).find(|body| same(asked, model.name_of(*body)));
            let advice = match (held, &others[..]) {
                (Some(_), _) => format!("it is fixed; --free {asked} makes it free"),
                (None, []) => "no body of the file moves freely".to_owned(),
                _ => format!("other movable bodies are {}", others.join(", ")),
            };
            ledger.fault_of_file(format!("no movable body is called `{asked}`"), advice);
        }
    }
    if !others.is_empty() && !found.is_empty() && !wanted.bodies.is_empty() {
        ledger.note_of_file(format!(
            "omitted, with all bodies attached to them: {}",
            listed(&others)
        ));
    }
    found
}

/// Adopts the faults of the imported bodies; if bodies were selected, faults of other bodies become
/// notes.
pub(super) fn judged(model: &Model, roots: &[usize], wanted: &Wanted, ledger: &mut Ledger) {
    let chosen: Vec<usize> = roots.iter().flat_map(|root| model.below(*root)).collect();
    let mut others = Vec::new();
    for (index, body) in model.bodies.iter().enumerate() {
        if wanted.bodies.is_empty() || chosen.contains(&index) || model.is_fixed(Some(index)) {
            ledger.note_all(&body.notes);
        }
        if wanted.bodies.is_empty() || chosen.contains(&index) {
            ledger.take(&body.faults);
        } else {
            others.extend_from_slice(&body.faults);
        }
    }
    ledger.pass_over(&others, "the remainder of the file");
    for (place, names) in &model.excluded {
        let both = names
            .iter()
            .all(|name| chosen.iter().any(|body| model.name_of(*body) == name.as_str()));
        // Bodies connected by a joint do not collide with each other in any case.
        let of = |name: &String| model.bodies.iter().position(|body| body.name == *name);
        let joined = match names.each_ref().map(of) {
            [Some(a), Some(b)] => {
                model.bodies[a].parent == Some(b) || model.bodies[b].parent == Some(a)
            }
            _ => true,
        };
        if both && !joined {
            let [a, b] = names;
            let message = format!("`{a}` and `{b}` do not collide (<exclude>)");
            let advice = "in pushplan all bodies collide: remove the element, or select one of \
                          them with --body";
            ledger.fault(*place, message, advice);
        }
    }
}

/// Describes the joint that holds a body.
pub(super) fn held_by(motion: &Motion) -> String {
    match motion {
        Motion::Fixed => "a fixed joint".to_owned(),
        Motion::Free => "a free joint".to_owned(),
        Motion::Hinge { .. } => "a hinge".to_owned(),
        Motion::Slide { .. } => "a slide".to_owned(),
        Motion::Several(all) => format!("{} joints", all.len()),
        Motion::Other(words) => words.clone(),
    }
}

/// Reports elements of the file that would change pushes: as faults, or as notes if bodies were
/// selected.
pub(super) fn beyond(model: &Model, wanted: &Wanted, ledger: &mut Ledger) {
    for (place, what) in &model.beyond {
        if wanted.bodies.is_empty() {
            let message = format!("{what} is not supported");
            let advice = "remove it, or select bodies with --body";
            ledger.fault(*place, message, advice);
        } else {
            ledger.note(*place, format!("{what} is ignored"));
        }
    }
}
