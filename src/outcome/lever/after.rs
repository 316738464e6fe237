//! What is left of a task once some of its steps are made: pushes of what lies on the table by then,
//! or lever-ups of what still lies on its underside.

use crate::geometry::{ConvexPolygon, Pose, Pose3, Vector, Vector3, clearance};
use crate::{
    scene::{MAX_FEET, Object, Obstacle, Scene, Support, Unknowns, carries},
    task::{Goal, PushRules, Task},
};

use crate::scene::Plate;
use crate::task::Ending;

/// A plate whose lowest point is higher above the table lies on something else, metres.
const ON_TABLE: f64 = 1e-3;

/// What leans by more is not stated as lying on its underside, radians: on feet of 6 mm plates of
/// the size of a hand lean by 0.002 where one foot stands in the air.
const LEVEL: f64 = 0.01;

/// How far gaps to blocks are looked for, metres.
const BESIDE: f64 = 1e-3;

/// Of a long name so many letters are kept, which leaves room for more.
const NAME: usize = 56;

/// Points of a plate this near to its lowest one carry it, metres.
const CARRYING: f64 = 3e-4;

impl Task {
    /// The task of pushing the goal's object to its place once all objects lie at `rests` (their
    /// frames): nothing if the task allows no pushes or names no place, or if the object does not
    /// lie on the table.
    ///
    /// Seen from above objects are their outlines, on the points that carry them. Those that lie on
    /// something else are obstacles, and obstacles count as standing on the table.
    pub fn after(&self, rests: &[Pose3]) -> Option<Task> {
        let place = self.goals.first()?;
        if self.pushes.max_count == 0 {
            return None;
        }
        let (position, tolerance) = (place.position()?, place.tolerance());
        // Between a lever-up and a push the tool is changed.
        let tool_changes = match (self.pushes.tool_changes, &self.levers) {
            (Some(allowed), Some(_)) => Some(allowed.checked_sub(1)?),
            (stated, _) => stated,
        };
        let mut scene = Scene::new([]).on_table(self.scene.table_friction);
        let mut goal = None;
        for (k, (plate, rest)) in self.scene.plates().zip(rests).enumerate() {
            match lying(&plate, rest).filter(|object| self.is_clear(object)) {
                Some(object) => {
                    if k == place.object {
                        let there = Goal::new(scene.objects.len(), position.into(), tolerance);
                        // The outline that is pushed is unturned where it rests.
                        let turned = rest.from_above().heading;
                        goal = Some(match place.heading() {
                            Some(wanted) => there
                                .facing(wanted.heading - turned, wanted.tolerance)
                                .alike(wanted.symmetry),
                            None => there,
                        });
                    }
                    scene.objects.push(object);
                }
                None => scene.obstacles.push(standing(&plate, rest)),
            }
        }
        scene.obstacles.extend(self.scene.obstacles.iter().map(Obstacle::grounded));
        Some(Task {
            name: self.name.chars().take(NAME).chain("-push".chars()).collect(),
            description: format!("What is left of {} after the lever-up.", self.name),
            scene,
            unknown: Unknowns::NONE,
            arm: None,
            robot: self.robot,
            tool_costs: self.tool_costs.clone(),
            tools: self.tools.clone(),
            pushes: PushRules { tool_changes, ..self.pushes.clone() },
            levers: None,
            goals: vec![goal?],
            robustness: self.robustness,
        })
    }

    /// The task from where all objects lie at `rests`; nothing if one does not lie on its underside
    /// any more, as it is then no object that a scene can state.
    pub fn moved_to(&self, rests: &[Pose3]) -> Option<Task> {
        let mut task = self.clone();
        for (object, rest) in task.scene.objects.iter_mut().zip(rests) {
            let sunk = (rest.position.z - object.z).abs();
            if Ending::of(rest) != Ending::Back || rest.tilt() > LEVEL || sunk > ON_TABLE {
                return None;
            }
            object.pose = rest.from_above();
        }
        task.scene.place_parts();
        Some(task)
    }

    /// Whether an object is beside all obstacles, not over one.
    fn is_clear(&self, object: &Object) -> bool {
        let own = object.shape.footprint();
        self.scene.obstacles.iter().all(|obstacle| {
            let base = obstacle.shape().footprint();
            clearance((&own, &object.pose), (&base, &obstacle.pose), BESIDE) > 0.0
        })
    }
}

/// The plate as an object that is pushed, if it lies on the table.
fn lying(plate: &Plate, rest: &Pose3) -> Option<Object> {
    let points = corners(plate, rest);
    let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    // A NaN is not on the table either.
    let on_table = lowest <= ON_TABLE;
    if !on_table || Ending::of(rest) == Ending::Leaning {
        return None;
    }
    let at = rest.position.xy();
    let base = &plate.slabs[0];
    let middle = base.bottom + 0.5 * base.height;
    let outline = |corner: &Vector| rest.point(Vector3::new(corner.x, corner.y, middle)).xy();
    let outline: Vec<Vector> = base.corners.iter().map(outline).collect();
    let polygon = ConvexPolygon::balanced(&outline, at).ok()?;
    let height = points.iter().map(|point| point.z).fold(0.0, f64::max);
    let carrying = points.iter().filter(|point| point.z <= lowest + CARRYING);
    let carrying: Vec<Vector> = carrying.map(|point| point.xy() - at).collect();
    let support = match carries(&carrying) {
        Some(_) if carrying.len() <= MAX_FEET => Support::Points(carrying),
        _ => Support::Even,
    };
    let object = Object::prism(&plate.name, polygon, height).standing_on(support);
    Some(object.mass(plate.mass).friction(plate.friction).at(at.x, at.y, 0.0))
}

/// The plate as something to keep away from: the cuboid around it, on the world's axes.
fn standing(plate: &Plate, rest: &Pose3) -> Obstacle {
    let points = corners(plate, rest);
    let span = |of: &dyn Fn(&Vector3) -> f64| {
        let ends = points.iter().map(of);
        let (low, high) = (ends.clone().fold(f64::MAX, f64::min), ends.fold(f64::MIN, f64::max));
        (0.5 * (low + high), high - low)
    };
    let ((x, length), (y, width)) = (span(&|point| point.x), span(&|point| point.y));
    let top = points.iter().map(|point| point.z).fold(0.0, f64::max);
    Obstacle::new(&plate.name, [length, width, top], Pose::new(x, y, 0.0)).friction(plate.friction)
}

/// Corners of all solids of a plate and its feet, in the world, metres.
fn corners(plate: &Plate, rest: &Pose3) -> Vec<Vector3> {
    let at = |corner: &Vector, z: f64| rest.point(Vector3::new(corner.x, corner.y, z));
    let mut points: Vec<Vector3> = Vec::new();
    for slab in &plate.slabs {
        for z in [slab.bottom, slab.bottom + slab.height] {
            points.extend(slab.corners.iter().map(|corner| at(corner, z)));
        }
    }
    if plate.has_feet() {
        points.extend(plate.corners().iter().map(|corner| at(corner, -plate.z)));
    }
    points
}

#[cfg(test)]
mod tests;
