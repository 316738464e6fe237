//! Selection of the wanted bodies, and of the bodies fixed to each other.

use crate::diagnostic::{Effect, Ledger};
use crate::model::{Beyond, Body, Model, Motion, Solid, Weight};

use super::joints::may_mount;
use super::names::{bare, same};
use super::wanted::Wanted;
use super::weighed::NOTHING;

/// Returns the model with the bodies of `wanted.free` detached from the world, and with its roots
/// fixed to it if they are wanted so. The only body of a file without joints is assumed to be free,
/// and bodies that are only drawn are assumed to collide.
pub(super) fn freed(model: &Model, wanted: &Wanted, ledger: &mut Ledger) -> Model {
    let mut model = model.clone();
    ledger.note_all(&model.notes);
    drawn(&mut model, ledger);
    let mut wanted_free = Vec::new();
    for asked in &wanted.free {
        let named = |body: &usize| same(asked, model.name_of(*body));
        let Some(body) = (1..model.bodies.len()).find(named) else {
            let names = solid_bodies(&model);
            let advice = format!("bodies with solids are {}", listed(&names));
            ledger.fault_of_file(format!("no body is called `{asked}`"), advice);
            continue;
        };
        wanted_free.push(body);
    }
    if wanted.fixed {
        let moves = |body: usize| {
            model
                .below(body)
                .iter()
                .any(|below| *below != body && model.bodies[*below].motion != Motion::Fixed)
        };
        let is_root = |body: &usize| model.bodies[*body].motion == Motion::Free && moves(*body);
        let roots: Vec<usize> = (1..model.bodies.len()).filter(is_root).collect();
        if roots.is_empty() {
            let advice = "remove --fixed; it fixes bodies that carry a drawer or a door";
            ledger.fault_of_file("no free body has another one jointed to it", advice);
        }
        roots.into_iter().for_each(|root| model.bodies[root].motion = Motion::Fixed);
    }
    // Libraries of objects leave the joint to the scene that includes them.
    let still = model.bodies.iter().all(|body| body.motion == Motion::Fixed);
    let solid = |body: &usize| {
        model.rigid(*body).iter().any(|body| model.bodies[*body].solids.iter().any(|s| s.touches))
    };
    let only: Vec<usize> = model.children(0).filter(solid).collect();
    let plain = wanted_free.is_empty() && !wanted.fixed && still;
    if let ([body], true) = (&only[..], plain) {
        // The body that holds the solids has the name of the object.
        let outer = model.rigid(*body);
        let inner = outer.iter().find(|body| !model.bodies[**body].solids.is_empty());
        let whole = inner.filter(|inner| {
            outer.iter().all(|body| {
                model.bodies[*body].solids.is_empty() || model.below(**inner).contains(body)
            })
        });
        let body = *whole.unwrap_or(body);
        let note = format!(
            "nothing moves in the file; its only body, `{}`, is taken for a free object",
            model.name_of(body)
        );
        if ledger.assume(Effect::Strong, model.bodies[body].place, note) {
            wanted_free.push(body);
        }
    }
    for body in wanted_free {
        model.bodies[body].motion = Motion::Free;
        model.bodies[body].parent = Some(0);
    }
    model
}

/// Lets visual shapes collide if no shape of the file does.
fn drawn(model: &mut Model, ledger: &mut Ledger) {
    let solids = || model.bodies.iter().skip(1).flat_map(|body| &body.solids);
    let invisible = solids().next().is_some() && !solids().any(|solid| solid.touches);
    let note = "no shape of the file collides, so its visual shapes do";
    if invisible && ledger.assume(Effect::Strong, None, note) {
        let solids = model.bodies.iter_mut().skip(1).flat_map(|body| &mut body.solids);
        solids.for_each(|solid| solid.touches = true);
    }
}

/// Returns `true` if the mass of an imported body follows from an assumed density.
pub(super) fn massless(model: &Model, roots: &[usize]) -> bool {
    let group = |root: &usize| model.below(*root);
    let nothing = |body: &Body| match &body.inertial {
        Some((mass, ..)) => *mass <= NOTHING,
        None => body.solids.iter().all(|solid| solid.material.weight == Weight::Mass(0.0)),
    };
    roots.iter().any(|root| {
        let bodies: Vec<&Body> = group(root).into_iter().map(|body| &model.bodies[body]).collect();
        let of_body = |solid: &Solid| solid.material.weight == Weight::OfBody;
        let open = |body: &&Body| body.inertial.is_none() && body.solids.iter().any(of_body);
        bodies.iter().any(open) || bodies.iter().all(|body| nothing(body))
    })
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
    let can = |motion: &Motion| *motion == Motion::Free || motion.is_planar() || may_mount(motion);
    // Other movable bodies beside objects are left out, such as a robot.
    let passes = wanted.bodies.is_empty()
        && model.bodies.iter().any(|body| {
            let hangs = body.parent.is_some_and(|parent| fixed.contains(&parent));
            hangs && can(&body.motion)
        });
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
                let how = format!("attached to the world by {}", held_by(motion));
                let note = format!("`{}` is left out: it is {how}", body.name);
                if passes && ledger.assume(Effect::Strong, body.place, note) {
                    continue;
                }
                let message = format!("`{}` is {how}", body.name);
                let advice = "objects must be free (--free NAME, a <freejoint/>), rotate about \
                              the vertical or slide along the table; select bodies with --body";
                ledger.fault(body.place, message, advice);
            }
        }
    }
    for asked in &wanted.bodies {
        // A body may be fixed to another one that was asked for.
        let within = found.iter().flat_map(|root| model.below(*root));
        let mut names = within.map(|body| model.name_of(body)).chain(asked_for.iter().copied());
        if !names.any(|name| same(asked, name)) {
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
        ledger.note_of_file(
            Effect::Some,
            format!("omitted, with all bodies attached to them: {}", listed(&others)),
        );
    }
    found
}

/// Adopts the faults of the imported bodies; if bodies were selected, faults of other bodies become
/// notes.
pub(super) fn judged(model: &Model, roots: &[usize], wanted: &Wanted, ledger: &mut Ledger) {
    let chosen: Vec<usize> = roots.iter().flat_map(|root| model.below(*root)).collect();
    let mut others = Vec::new();
    // If bodies were selected or left out, only the others can cause faults.
    let left = |index: usize| !chosen.contains(&index) && !model.is_fixed(Some(index));
    let all = wanted.bodies.is_empty()
        && (ledger.is_strict() || roots.is_empty() || !(1..model.bodies.len()).any(left));
    for (index, body) in model.bodies.iter().enumerate() {
        if all || chosen.contains(&index) || model.is_fixed(Some(index)) {
            ledger.note_all(&body.notes);
        }
        if all || chosen.contains(&index) {
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

/// Reports elements of the file that would change pushes: as faults if they act on imported bodies,
/// otherwise as notes.
pub(super) fn beyond(model: &Model, roots: &[usize], wanted: &Wanted, ledger: &mut Ledger) {
    let chosen: Vec<usize> = roots.iter().flat_map(|root| model.below(*root)).collect();
    for Beyond { place, what, bodies } in &model.beyond {
        let acts = match bodies {
            Some(bodies) => bodies.iter().find(|body| chosen.contains(body)),
            None => None,
        };
        // A constraint is not left out of a body that was asked for.
        let names = |body: &usize| {
            format!("{what} acts on `{}`, which is not supported", model.name_of(*body))
        };
        match acts {
            Some(body) => {
                ledger.fault(*place, names(body), "remove it, or select other bodies with --body")
            }
            None => {
                let ignored = format!("{what} is ignored");
                let others = chosen.len() + 1 < model.bodies.len();
                if bodies.is_some() || !wanted.bodies.is_empty() {
                    ledger.note(*place, ignored);
                } else if !others || !ledger.assume(Effect::Some, *place, ignored) {
                    let message = format!("{what} is not supported");
                    ledger.fault(*place, message, "remove it, or select bodies with --body");
                }
            }
        }
    }
}
