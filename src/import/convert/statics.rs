//! What does not move: the table and the obstacles on it.

use crate::geometry::{Pose, Vector};
use crate::import::fault::Ledger;
use crate::import::model::{Model, Outline, Solid};
use crate::scene::{Obstacle, Robot, Scene, TableTop};

use super::names::Names;
use super::objects::Draft;
use super::upright::{Base, Upright};
use super::wanted::Wanted;

/// Objects stand on what is within this of their undersides, metres: scenes drop them a little.
const STAND: f64 = 5e-3;

/// What the objects stand on, and what stands in their way.
pub(super) struct Statics<'a> {
    /// What the table is in the file, if it is there at all.
    pub table: Option<&'a Solid>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// Where it ends, if it does.
    pub table_top: Option<TableTop>,
    /// Obstacles, each with what it is in the file.
    pub obstacles: Vec<(Obstacle, &'a Solid)>,
}

/// Finds table and obstacles around objects; none, with faults, if the objects stand on no table.
pub(super) fn statics<'a>(
    model: &'a Model,
    drafts: &[Draft<'_>],
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Option<Statics<'a>> {
    let floor = drafts.iter().map(|draft| draft.low).fold(f64::INFINITY, f64::min);
    let mut level = true;
    for draft in drafts.iter().filter(|draft| draft.low > floor + STAND) {
        let (name, above) = (&draft.object.name, 1e3 * (draft.low - floor));
        let message = format!("`{name}` is {above:.1} mm above where the lowest object stands");
        ledger.fault(draft.place, message, "all objects stand on one table: set it down");
        level = false;
    }
    if !level {
        return None;
    }
    let fixed: Vec<(&str, &Solid)> = model
        .rigid(0)
        .into_iter()
        .flat_map(|body| model.bodies[body].solids.iter().map(move |s| (model.name_of(body), s)))
        .filter(|(_, solid)| solid.touches)
        .collect();
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
            (true, "world") => "obstacle",
            (true, body) => body,
        };
        // The task says where its robot stands.
        if what.trim_start_matches("obstacle/") == Robot::BASE {
            continue;
        }
        if let Outline::Plane(_) = solid.outline {
            plane = Some((solid, flat_at(solid, what, ledger)?));
            continue;
        }
        let Some(upright) = Upright::of(solid, &format!("`{what}`"), ledger) else { continue };
        if upright.top() <= floor + STAND {
            let over = |draft: &Draft<'_>| upright.covers(draft.object.pose.position);
            if upright.top() >= floor - STAND && drafts.iter().any(over) {
                found.stand_on(solid, &upright, drafts, ledger)?;
            } else {
                ledger.note(solid.place, format!("`{what}` lies below the table and is left out"));
            }
            continue;
        }
        found.obstacles.extend(obstacle(solid, what, &upright, floor, wanted, names, ledger));
    }
    if found.table.is_none()
        && let Some((solid, z)) = plane
    {
        if (z - floor).abs() > STAND {
            let by = 1e3 * (floor - z);
            let message = format!("the objects are {by:.1} mm above this plane, and on no table");
            ledger.fault(solid.place, message, "set them down on it");
            return None;
        }
        found.table = Some(solid);
    }
    match found.table {
        Some(table) => found.table_friction = table.material.friction.unwrap_or(wanted.friction),
        None => ledger.note(
            model.bodies[0].place,
            format!("there is no table: the objects stand on one of friction {}", wanted.friction),
        ),
    }
    Some(found)
}

impl<'a> Statics<'a> {
    /// Takes the top of a box as the table.
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
            ledger.fault(draft.place, message, "set it down on the box that the others stand on");
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
                ledger.note(solid.place, "the table is turned or round: where it ends is left out")
            }
        }
        Some(())
    }
}

/// Height of a level plane, metres.
fn flat_at(solid: &Solid, what: &str, ledger: &mut Ledger) -> Option<f64> {
    let normal = solid.pose.rotation * nalgebra::Vector3::z();
    if normal.xy().norm() > 1e-3 || normal.z < 0.0 {
        let advice = "put a box in its place: obstacles are cuboids";
        ledger.fault(solid.place, format!("the plane `{what}` is not level"), advice);
        return None;
    }
    Some(solid.pose.translation.z)
}

fn obstacle<'a>(
    solid: &'a Solid,
    what: &str,
    upright: &Upright,
    floor: f64,
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> Option<(Obstacle, &'a Solid)> {
    let Base::Rectangle([x, y]) = upright.base else {
        let advice = "put a box around it, or several into it";
        ledger.fault(solid.place, format!("the obstacle `{what}` is not a box"), advice);
        return None;
    };
    let pose = Pose { position: upright.pose.position, ..upright.pose };
    // No object meets the part of it that is below the table, or passes a little above.
    let z = if upright.low > floor + STAND { upright.low - floor } else { 0.0 };
    let size = [x, y, upright.top() - floor - z];
    let friction = solid.material.friction.unwrap_or(wanted.friction);
    Some((Obstacle { name: names.take(what), size, pose, z, friction }, solid))
}

/// The scene without objects.
pub(super) fn empty(statics: &Statics<'_>, shift: Vector) -> Scene {
    let mut scene = Scene { table_friction: statics.table_friction, ..Scene::default() };
    scene.table_top = statics.table_top.map(|top| TableTop { middle: top.middle + shift, ..top });
    scene.obstacles = statics.obstacles.iter().map(|(obstacle, _)| obstacle.clone()).collect();
    for obstacle in &mut scene.obstacles {
        obstacle.pose.position += shift;
    }
    scene
}
