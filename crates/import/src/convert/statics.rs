//! Fixed bodies: the table and the obstacles on it.

use crate::diagnostic::{Effect, Ledger};
use crate::model::{Model, Outline, Solid};
use pushplan::geometry::{Pose, Vector, clearance};
use pushplan::scene::{Object, Obstacle, Robot, Scene, TableTop};

use super::lowered::{hangs, passes, solids};
use super::names::Names;
use super::objects::Draft;
use super::shadow::{area, around};
use super::upright::{Base, Upright};
use super::wanted::Wanted;

/// Height tolerance of bodies that rest on a surface, metres, because scenes often drop objects a
/// little.
const STAND: f64 = 5e-3;

/// Maximum depth in the table at which an object still counts as standing on it, metres; simulators
/// correct such overlaps at the start.
const SUNK: f64 = 0.05;

/// Maximum height above the table from which an object is set down, metres.
const DROP: f64 = 0.25;

/// Table and obstacles.
pub(super) struct Statics<'a> {
    /// Solid of the table in the file, if any.
    pub table: Option<&'a Solid>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// Extents of the table top, if limited.
    pub table_top: Option<TableTop>,
    /// Obstacles, each with its solid in the file.
    pub obstacles: Vec<(Obstacle, &'a Solid)>,
}

/// Finds table and obstacles around objects; returns `None` and reports faults if the objects stand
/// on no table.
pub(super) fn statics<'a>(
    model: &'a Model,
    drafts: &[Draft<'_>],
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Option<Statics<'a>> {
    let fixed: Vec<(usize, &Solid)> = model
        .rigid(0)
        .into_iter()
        .flat_map(|body| model.bodies[body].solids.iter().map(move |solid| (body, solid)))
        .filter(|(_, solid)| solid.touches)
        .collect();
    // The bottom of a cabinet is not the table that its drawers stand on.
    let holds = |body: usize| drafts.iter().any(|draft| holds(model, body, draft));
    let tables: Vec<&Solid> =
        fixed.iter().filter(|(body, _)| !holds(*body)).map(|(_, solid)| *solid).collect();
    let floor = floor(&tables, drafts, ledger);
    let mut level = true;
    for draft in drafts.iter().filter(|draft| draft.low < floor - STAND) {
        let (name, below) = (&draft.object.name, 1e3 * (floor - draft.low));
        let note = format!(
            "`{name}` is {below:.0} mm below the surface of the table in the file; it was raised \
             onto it"
        );
        ledger.note(draft.place, note);
    }
    for draft in drafts.iter().filter(|draft| draft.low > floor + STAND) {
        let (name, above) = (&draft.object.name, 1e3 * (draft.low - floor));
        let held = hangs(model, draft);
        let over = |other: &&Draft<'_>| {
            let under = |(solid, pose, [_, top]): (&Object, Pose, [f64; 2])| {
                passes(draft, solid, &pose, top)
            };
            other.group != draft.group && solids(other).any(under)
        };
        if let Some(other) = drafts.iter().find(over).filter(|_| held) {
            let message = format!(
                "`{name}` is held by its joint above `{}`, but a task holds all objects at the \
                 height of the table",
                other.object.name
            );
            let advice =
                format!("select one of them: --body {name}, or --body {}", other.object.name);
            ledger.fault(draft.place, message, advice);
            level = false;
            continue;
        }
        if draft.low <= floor + DROP || held {
            let note = format!(
                "`{name}` is {above:.0} mm above the table in the file; it was lowered onto it"
            );
            ledger.note(draft.place, note);
            continue;
        }
        let message = format!("`{name}` is {above:.1} mm above the underside of the lowest object");
        let advice =
            "all objects must stand on one table: lower it, or select other bodies with --body";
        ledger.fault(draft.place, message, advice);
        level = false;
    }
    if !level {
        return None;
    }
    let mut found = Statics {
        table: None,
        table_friction: wanted.friction,
        table_top: None,
        obstacles: Vec::new(),
    };
    let mut plane = None;
    for (body, solid) in fixed {
        let what = match (solid.name.is_empty(), body) {
            (false, _) => solid.name.as_str(),
            (true, 0) => "obstacle",
            (true, body) => model.name_of(body),
        };
        // The robot's base follows from the task.
        if what.trim_start_matches("obstacle/").starts_with(Robot::BASE) {
            continue;
        }
        if let Outline::Plane(_) = solid.outline {
            plane = Some((solid, flat_at(solid, what, ledger)?));
            continue;
        }
        // Only the selected bodies and the table can cause faults.
        let before = ledger.count();
        let upright = Upright::any(solid, &format!("`{what}`"), ledger);
        if !wanted.bodies.is_empty() {
            let faults = ledger.since(before);
            ledger.pass_over(&faults, &format!("`{what}`"));
        }
        let Some(upright) = upright else { continue };
        let over = |draft: &&Draft<'_>| {
            let (size, pose) = around(&upright.outline());
            let own = Object::cuboid("", [size[0], size[1], upright.height]);
            hangs(model, draft) && passes(draft, &own, &pose, upright.top())
        };
        if let Some(draft) = drafts.iter().find(over).filter(|_| holds(body)) {
            let note = format!(
                "`{what}` is left out, because `{}` passes above it on its joint; a task holds all \
                 objects at the height of the table",
                draft.object.name
            );
            ledger.note_as(Effect::Strong, solid.place, note);
            continue;
        }
        if upright.top() <= floor + STAND {
            let over = |draft: &Draft<'_>| upright.covers(draft.object.pose.position);
            if upright.top() >= floor - STAND && drafts.iter().any(over) && !holds(body) {
                found.stand_on(solid, &upright, drafts, ledger)?;
            } else {
                ledger.note(solid.place, format!("`{what}` is below the table and is ignored"));
            }
            continue;
        }
        let other = (drafts, wanted);
        found.obstacles.extend(obstacle(solid, what, &upright, floor, other, names, ledger));
    }
    if found.table.is_none()
        && let Some((solid, z)) = plane
    {
        let held = drafts.iter().all(|draft| hangs(model, draft)) && z < floor;
        if held {
            let by = 1e3 * (floor - z);
            let note = format!(
                "joints hold all objects {by:.0} mm above the plane; heights count from their \
                 underside"
            );
            ledger.note(solid.place, note);
        } else if (z - floor).abs() > STAND {
            let (side, by) = if z < floor { ("above", floor - z) } else { ("below", z - floor) };
            let by = 1e3 * by;
            let note =
                format!("the objects are {by:.0} mm above the plane; they were lowered onto it");
            if z > floor || !ledger.assume(Effect::Strong, solid.place, note) {
                let message =
                    format!("the objects are {by:.1} mm {side} this plane and stand on no table");
                ledger.fault(solid.place, message, "move them onto it");
                return None;
            }
        }
        found.table = Some(solid);
    }
    match found.table {
        Some(table) => found.table_friction = table.material.friction.unwrap_or(wanted.friction),
        None => ledger.note(
            model.bodies[0].place,
            format!("the file has no table; one with friction {} is assumed", wanted.friction),
        ),
    }
    Some(found)
}

impl<'a> Statics<'a> {
    /// Adopts the top of a box as the table.
    fn stand_on(
        &mut self,
        solid: &'a Solid,
        upright: &Upright,
        drafts: &[Draft<'_>],
        ledger: &mut Ledger,
    ) -> Option<()> {
        if self.table.is_some() {
            let message = "the objects stand on several boxes";
            ledger.fault(solid.place, message, "make the table one box, or a plane");
            return None;
        }
        let off = |draft: &&Draft<'_>| !upright.covers(draft.object.pose.position);
        if let Some(draft) = drafts.iter().find(off) {
            let message = format!("`{}` does not stand on the table", draft.object.name);
            ledger.fault(
                draft.place,
                message,
                "move it onto the box that carries the other objects",
            );
            return None;
        }
        self.table = Some(solid);
        let quarters = upright.pose.heading / std::f64::consts::FRAC_PI_2;
        let straight = (quarters - quarters.round()).abs() < 1e-6;
        match upright.base {
            Base::Rectangle([x, y]) if straight => {
                let size = if quarters.round() as i64 % 2 == 0 { [x, y] } else { [y, x] };
                self.table_top = Some(TableTop { size, middle: upright.pose.position });
            }
            _ => {
                ledger.note(solid.place, "the table is rotated or round, so its edges are ignored")
            }
        }
        Some(())
    }
}

/// Returns `true` for the immovable body to which an object is jointed, and those fixed to it.
fn holds(model: &Model, body: usize, draft: &Draft<'_>) -> bool {
    let parent = model.bodies[draft.group].parent.filter(|parent| *parent != 0);
    let top = |body: usize| {
        let above = std::iter::successors(Some(body), |body| model.bodies[*body].parent);
        above.take_while(|body| *body != 0).last()
    };
    hangs(model, draft) && parent.is_some_and(|parent| top(parent) == top(body))
}

/// Returns the height of a level plane, metres.
fn flat_at(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<f64> {
    let normal = solid.pose.rotation * nalgebra::Vector3::z();
    if normal.xy().norm() > 1e-3 || normal.z < 0.0 {
        let advice = "replace it by a box; obstacles are cuboids";
        ledger.fault(solid.place, format!("the plane `{what}` is not level"), advice);
        return None;
    }
    Some(solid.pose.translation.z)
}

/// Returns the height of the surface under the objects, metres: the highest plane or top of a box
/// under all of them. Without such a surface, returns the height of the lowest object.
fn floor(fixed: &[&Solid], drafts: &[Draft<'_>], ledger: &mut Ledger) -> f64 {
    let lowest = drafts.iter().map(|draft| draft.low).fold(f64::INFINITY, f64::min);
    let before = ledger.count();
    let tops = fixed.iter().filter_map(|solid| match solid.outline {
        Outline::Plane(_) => Some(solid.pose.translation.z),
        Outline::Box(_) => {
            let upright = Upright::any(solid, "", ledger)?;
            let covers = |draft: &Draft<'_>| upright.covers(draft.object.pose.position);
            (upright.rough.is_none() && drafts.iter().all(covers)).then(|| upright.top())
        }
        _ => None,
    });
    // An object that is sunk in by less than half of its height is meant to stand on the surface.
    let half = drafts.iter().map(|draft| draft.object.shape.height() / 2.0);
    let sunk = half.fold(SUNK, f64::min).max(STAND);
    let under = |top: &f64| *top <= lowest + sunk && *top >= lowest - DROP;
    let floor = tops.filter(under).fold(f64::NEG_INFINITY, f64::max);
    // Faults of these boxes are reported later.
    ledger.since(before);
    // Small differences count as standing on the surface.
    match (floor - lowest).abs() {
        off if off > STAND && floor.is_finite() => floor,
        _ => lowest,
    }
}

fn obstacle<'a>(
    solid: &'a Solid,
    what: &str,
    upright: &Upright,
    floor: f64,
    (drafts, wanted): (&[Draft<'_>], &Wanted),
    names: &mut Names,
    ledger: &mut Ledger,
) -> Option<(Obstacle, &'a Solid)> {
    // Parts below the table have no effect, and no object passes below an obstacle slightly above
    // it.
    let z = if upright.low > floor + STAND { upright.low - floor } else { 0.0 };
    let tall = upright.top() - floor - z;
    let friction = solid.material.friction.unwrap_or(wanted.friction);
    if let (Base::Rectangle([x, y]), None) = (&upright.base, &upright.rough) {
        let size = [*x, *y, tall];
        let pose = Pose { position: upright.pose.position, ..upright.pose };
        return Some((Obstacle { name: names.take(what), size, pose, z, friction }, solid));
    }
    // The obstacle becomes the smallest enclosing box.
    let outline = upright.outline();
    let (size, pose) = around(&outline);
    let obstacle =
        Obstacle { name: names.take(what), size: [size[0], size[1], tall], pose, z, friction };
    let own = obstacle.shape().footprint();
    let touches = |object: &Object, pose: &Pose| {
        obstacle.meets(object.span())
            && clearance((&own, &obstacle.pose), (&object.shape.footprint(), pose), 1.0) <= 0.0
    };
    let within = drafts.iter().find(|draft| {
        let parts = draft.parts.iter();
        touches(&draft.object, &draft.object.pose)
            || parts.clone().any(|(part, place)| touches(part, &(draft.object.pose * *place)))
    });
    if let Some(draft) = within {
        let name = &draft.object.name;
        let note = format!("`{what}` is ignored, because its bounding box contains `{name}`");
        if !wanted.bodies.is_empty() {
            ledger.note_as(Effect::Strong, solid.place, note);
        } else if !ledger.assume(Effect::Strong, solid.place, note) {
            let message = format!("`{what}` is not a box, and its bounding box contains `{name}`");
            let advice = "replace it by several boxes; with --body it is ignored";
            ledger.fault(solid.place, message, advice);
        }
        return None;
    }
    let more = 1e2 * (size[0] * size[1] / area(&outline) - 1.0);
    let note = format!(
        "the obstacle `{what}` is replaced by its bounding box, which covers {more:.0} % more"
    );
    ledger.note(solid.place, note);
    Some((obstacle, solid))
}

/// Returns the scene without objects.
pub(super) fn empty(statics: &Statics<'_>, shift: Vector) -> Scene {
    let mut scene = Scene { table_friction: statics.table_friction, ..Scene::default() };
    scene.table_top = statics.table_top.map(|top| TableTop { middle: top.middle + shift, ..top });
    scene.obstacles = statics.obstacles.iter().map(|(obstacle, _)| obstacle.clone()).collect();
    for obstacle in &mut scene.obstacles {
        obstacle.pose.position += shift;
    }
    scene
}
