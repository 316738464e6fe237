//! Which bodies are asked for, and which are fixed to which.

use crate::import::fault::Ledger;
use crate::import::model::{Model, Motion};

use super::names::{bare, same};
use super::wanted::Wanted;

/// The body that `pushplan export` makes the tool.
const TOOL: &str = "tool";

/// The bodies that stand on the table by themselves, in order; what moves in another way, or is not
/// asked for, is left out with a fault or a note.
pub(super) fn free(model: &Model, wanted: &Wanted, ledger: &mut Ledger) -> Vec<usize> {
    let fixed = model.rigid(0);
    let mut found = Vec::new();
    let (mut asked_for, mut others) = (Vec::new(), Vec::new());
    for (index, body) in model.bodies.iter().enumerate() {
        let hangs = body.parent.is_some_and(|parent| fixed.contains(&parent));
        if !hangs || body.motion == Motion::Fixed {
            continue;
        }
        if !wanted.takes(&body.name) {
            others.push(bare(&body.name));
            continue;
        }
        asked_for.push(body.name.as_str());
        match &body.motion {
            Motion::Free => found.push(index),
            _ if model.ours && body.name == TOOL && wanted.bodies.is_empty() => {
                ledger.note(body.place, "the tool is left out: `--as tool` imports it");
            }
            motion => {
                let how = held_by(motion);
                let message = format!("`{}` is held in the world by {how}", body.name);
                let advice = "objects stand freely (<freejoint/>, or a floating joint of the \
                              world); name those that are meant with --body";
                ledger.fault(body.place, message, advice);
            }
        }
    }
    for asked in &wanted.bodies {
        if !asked_for.iter().any(|name| same(asked, name)) {
            let advice = match others[..] {
                [] => "no body of the file moves freely".to_owned(),
                _ => format!("others are {}", others.join(", ")),
            };
            ledger.fault_of_file(format!("no movable body is called `{asked}`"), advice);
        }
    }
    found
}

/// What holds a body, in words.
pub(super) fn held_by(motion: &Motion) -> String {
    match motion {
        Motion::Fixed => "being fixed".to_owned(),
        Motion::Free => "a free joint".to_owned(),
        Motion::Hinge { .. } => "a hinge".to_owned(),
        Motion::Slide { .. } => "a slide".to_owned(),
        Motion::Other(words) => words.clone(),
    }
}

/// Faults for parts of the file that would change pushes; only notes where bodies were chosen, so
/// that the others are mentioned.
pub(super) fn beyond(model: &Model, wanted: &Wanted, ledger: &mut Ledger) {
    for (place, what) in &model.beyond {
        if wanted.bodies.is_empty() {
            let message = format!("{what} is unknown to pushplan");
            let advice = "take it out, or name the bodies that are meant with --body";
            ledger.fault(*place, message, advice);
        } else {
            ledger.note(*place, format!("{what} is left out"));
        }
    }
}
