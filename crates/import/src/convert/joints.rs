//! Joints between objects, and joints of objects to the world.

use std::f64::consts::PI;

use crate::diagnostic::{Effect, Ledger};
use crate::model::{Body, Model, Motion, Place};
use pushplan::geometry::Vector;
use pushplan::scene::{Joint, JointKind, Span, WorldJoint};

use super::groups::held_by;
use super::objects::Draft;

/// Maximum difference between the limits of a revolute joint, radians.
const WIDEST: f64 = 340.0 * PI / 180.0;

/// Rotation above which a limit is none, radians: files write 9999 or more for it.
const ANGLE: f64 = 1e3;

/// Maximum translation that a task can state, metres; a limit beyond it is none.
const SHIFT: f64 = 10.0;

/// Returns the joints of all bodies that are attached to an object by a joint that is not fixed.
pub(super) fn joints(
    model: &Model,
    drafts: &[Draft<'_>],
    hung: &[(usize, Motion)],
    ledger: &mut Ledger,
) -> Vec<Joint> {
    let mut found = Vec::new();
    // Files written by pushplan keep fixed objects separate, so a fixed joint connects them.
    for (index, draft) in drafts.iter().enumerate() {
        let first = drafts[..index].iter().position(|other| other.group == draft.group);
        found.extend(first.map(|first| Joint::new([first, index], JointKind::Fixed)));
    }
    for (body, motion) in hung {
        let Body { name, place, parent, .. } = &model.bodies[*body];
        let of = |body: usize| drafts.iter().position(|draft| draft.body == body);
        let group = |body: usize| {
            let same = |draft: &Draft<'_>| model.rigid(draft.group).contains(&body);
            drafts.iter().position(same)
        };
        let Some(parent) = parent.and_then(|parent| of(parent).or_else(|| group(parent))) else {
            continue;
        };
        let Some(child) = of(*body).or_else(|| group(*body)) else { continue };
        match kind(motion, name, *place, ledger) {
            Some(kind) => found.push(Joint::new([parent, child], kind)),
            None => {
                let message =
                    format!("`{name}` is attached to another body by {}", held_by(motion));
                let advice = "joints between objects must be fixed, rotate about the vertical, or \
                              slide along the table";
                ledger.fault(*place, message, advice);
            }
        }
    }
    found
}

/// Returns the joints of objects to the world.
pub(super) fn mounts(model: &Model, drafts: &[Draft<'_>], ledger: &mut Ledger) -> Vec<WorldJoint> {
    let mut found = Vec::new();
    for (object, draft) in drafts.iter().enumerate() {
        let Body { name, place, motion, .. } = &model.bodies[draft.group];
        let hangs = model.is_fixed(model.bodies[draft.group].parent);
        if !hangs || *motion == Motion::Free || motion.is_planar() {
            continue;
        }
        found.extend(kind(motion, name, *place, ledger).map(|kind| WorldJoint::new(object, kind)));
    }
    found
}

/// Returns `true` if a joint can connect an object to the world.
pub(super) fn may_mount(motion: &Motion) -> bool {
    match motion {
        Motion::Hinge { axis, .. } => axis.xy().norm() < 1e-3,
        Motion::Slide { axis, .. } => axis.z.abs() < 1e-3,
        _ => false,
    }
}

/// Returns the kind of a joint; `None` if pushplan cannot express it.
fn kind(motion: &Motion, name: &str, place: Place, ledger: &mut Ledger) -> Option<JointKind> {
    match motion {
        Motion::Hinge { axis, at, limits } if may_mount(motion) => {
            let far = |end: f64| if end.abs() > ANGLE { end * f64::INFINITY } else { end };
            let limits = limits.map(|limits| limits.map(far));
            let limits = limits.map(|[low, high]| match axis.z < 0.0 {
                false => Span { low, high },
                true => Span { low: -high, high: -low },
            });
            let limits = limits.and_then(|limits| turns(limits, name, place, ledger));
            Some(JointKind::Revolute { at: Vector::new(at.x, at.y), limits })
        }
        Motion::Slide { axis, limits } if may_mount(motion) => {
            let limits = limits.and_then(|limits| slides(limits, name, place, ledger));
            Some(JointKind::Prismatic { axis: axis.xy().normalize(), limits })
        }
        _ => None,
    }
}

/// Returns the limits of a prismatic joint as a task can state them: at most [`SHIFT`] from the
/// start, or none.
fn slides(limits: [f64; 2], name: &str, place: Place, ledger: &mut Ledger) -> Option<Span> {
    let kept = limits.map(|end| end.clamp(-SHIFT, SHIFT));
    let [low, high] = kept;
    if kept == limits {
        return Some(Span { low, high });
    }
    let none = high - low >= 2.0 * SHIFT;
    let how = if none { "without limits".to_owned() } else { format!("as {low} to {high} m") };
    let note =
        format!("the range of `{name}` is {} to {} m; it is imported {how}", limits[0], limits[1]);
    ledger.note_as(Effect::Slight, place, note);
    (!none).then_some(Span { low, high })
}

/// Returns the limits of a revolute joint as a task can state them: at most 340 degrees apart, or
/// none.
fn turns(limits: Span, name: &str, place: Place, ledger: &mut Ledger) -> Option<Span> {
    let Span { low, high } = limits;
    let degrees = |angle: f64| (angle.to_degrees() * 10.0).round() / 10.0;
    let stated = format!("{} to {} degrees", degrees(low), degrees(high));
    // A limit on one side only is kept.
    let unlimited = low.is_infinite() == high.is_infinite() && high - low >= 2.0 * PI;
    if unlimited {
        let note = format!(
            "`{name}` may rotate by more than 360 degrees ({stated}); it is imported without limits"
        );
        ledger.note(place, note);
        return None;
    }
    // The start stays within the limits.
    let low = low.max(-(WIDEST - high).max(0.5 * WIDEST));
    let kept = Span { low, high: high.min(low + WIDEST) };
    if kept != limits {
        let [low, high] = [kept.low, kept.high].map(degrees);
        let note =
            format!("the range of `{name}` is {stated}; it is imported as {low} to {high} degrees");
        ledger.note(place, note);
    }
    Some(kept)
}
