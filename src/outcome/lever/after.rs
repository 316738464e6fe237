//! Remaining tasks after some steps of a plan: pushes of objects that lie on the table, or
//! lever-ups of objects that still rest on their undersides.

use crate::geometry::{ConvexPolygon, Pose, Pose3, Vector, Vector3, clearance};
use crate::{
    scene::{
        Body, Joint, MAX_FEET, Object, Obstacle, PairFriction, Plate, Scene, State, Support,
        Surface, Unknowns, Whole, WorldJoint, carries,
    },
    task::{Demand, Ending, Goal, PushRules, Task},
};

/// Largest height of a plate's lowest point that counts as lying on the table, metres.
const ON_TABLE: f64 = 1e-3;

/// Largest tilt that counts as lying on the underside, radians. A hand-sized plate on 6 mm feet
/// tilts by 0.002 if one foot is in the air.
const LEVEL: f64 = 0.01;

/// Distance up to which gaps to obstacles are computed, metres.
const BESIDE: f64 = 1e-3;

/// Maximum number of letters kept from a task's name, which leaves room for a suffix.
const NAME: usize = 56;

/// Height above a plate's lowest point up to which its points carry it, metres.
const CARRYING: f64 = 3e-4;

impl Task {
    /// Returns the task of pushing the goals' objects to their places once all objects rest at
    /// `rests`, which holds their frames. Returns `None` if the task allows no pushes or no further
    /// tool change, or has no planar goal. Also returns `None` if a goal's object does not lie on
    /// the table.
    ///
    /// Objects that still stand on their undersides keep their shapes and joints. Other objects
    /// that lie on the table become prisms of their outlines, carried by their lowest points.
    /// Objects that lie on something else become obstacles, and all obstacles count as standing on
    /// the table.
    pub fn after(&self, rests: &[Pose3]) -> Option<Task> {
        if self.pushes.max_count == 0 {
            return None;
        }
        // The tool is changed between a lever-up and a push.
        let tool_changes = match (self.pushes.tool_changes, &self.levers) {
            (Some(allowed), Some(_)) => Some(allowed.checked_sub(1)?),
            (stated, _) => stated,
        };
        let left = Left::of(self, rests);
        let goals: Vec<Goal> = self.goals.iter().filter_map(flat).collect();
        let goals = goals.into_iter().map(|goal| left.goal(goal)).collect::<Option<Vec<Goal>>>()?;
        goals.first()?;
        Some(Task {
            name: self.name.chars().take(NAME).chain("-push".chars()).collect(),
            description: format!("Remaining task for {} after the lever-up.", self.name),
            scene: left.scene(self),
            unknown: Unknowns::NONE,
            arm: None,
            robot: self.robot,
            tool_costs: self.tool_costs.clone(),
            tools: self.tools.clone(),
            pushes: PushRules { tool_changes, ..self.pushes.clone() },
            levers: None,
            goals,
            robustness: self.robustness,
        })
    }

    /// Returns the task with all objects at `rests`. Returns `None` if a compound object no longer
    /// lies on its underside, because a scene cannot represent it.
    pub fn moved_to(&self, rests: &[Pose3]) -> Option<Task> {
        let seen: Vec<Pose> = rests.iter().map(Pose3::from_above).collect();
        let mut task = Task { scene: carried(&self.scene, &seen), ..self.clone() };
        for (k, (plate, rest)) in self.scene.plates().zip(rests).enumerate() {
            if !stands(&plate, rest) {
                let alone = self.scene.parts_of(k).next().is_none();
                let object = lying(&plate, rest).filter(|_| alone)?;
                task.scene.objects[k] = Object { keep: self.scene.objects[k].keep, ..object };
            }
        }
        Some(task)
    }

    /// Returns `true` if the object overlaps no obstacle seen from above.
    fn is_clear(&self, object: &Object) -> bool {
        let own = object.shape.footprint();
        self.scene.obstacles.iter().all(|obstacle| {
            let base = obstacle.shape().footprint();
            clearance((&own, &object.pose), (&base, &obstacle.pose), BESIDE) > 0.0
        })
    }
}

/// Returns the demands of a goal that pushes can satisfy. Returns `None` for a goal that leaves the
/// plane and states no place.
fn flat(goal: &Goal) -> Option<Goal> {
    let mut flat = goal.clone();
    flat.demands.retain(Demand::is_pose);
    let wanted = flat.has_place() || goal.is_pose() && !flat.demands.is_empty();
    wanted.then_some(flat)
}

/// Returns `true` if an object still stands on its underside at its original height.
fn stands(plate: &Plate, rest: &Pose3) -> bool {
    let sunk = (rest.position.z - plate.z).abs();
    Ending::of(rest) == Ending::Back && rest.tilt() <= LEVEL && sunk <= ON_TABLE
}

/// Returns the scene with its objects at these poses and its joints as they are then.
fn carried(scene: &Scene, seen: &[Pose]) -> Scene {
    let mut now = scene.moved_to(&State::at_rest(scene.with_parts(seen.to_vec())));
    let joints = scene.joints.iter().map(|joint| joint.carried(&scene.objects, &now.objects));
    now.joints = joints.collect();
    now
}

/// Planar scene left by the steps made so far.
struct Left {
    /// Scene with its objects at their poses seen from above.
    now: Scene,
    /// Objects that can be pushed, followed by the parts of unchanged compound objects.
    objects: Vec<Object>,
    /// Objects that cannot be pushed, as obstacles.
    fixed: Vec<Obstacle>,
    /// Index among `objects` of each object of the scene.
    places: Vec<Option<usize>>,
    /// Heading of each object that became an outline. The outline itself starts with heading zero.
    turned: Vec<Option<f64>>,
}

impl Left {
    fn of(task: &Task, rests: &[Pose3]) -> Self {
        let scene = &task.scene;
        let seen: Vec<Pose> = rests.iter().map(Pose3::from_above).collect();
        let now = carried(scene, &seen);
        let places = vec![None; scene.objects.len()];
        let turned = vec![None; rests.len()];
        let mut left = Self { now, objects: Vec::new(), fixed: Vec::new(), places, turned };
        for (k, (plate, rest)) in scene.plates().zip(rests).enumerate() {
            let own = &left.now.objects[k];
            let whole = !own.in_space() && stands(&plate, rest);
            let outline = || {
                lying(&plate, rest).map(|found| Object {
                    keep: own.keep,
                    may_fall: own.may_fall,
                    max_force: own.max_force,
                    ..found
                })
            };
            let found = if whole { Some(own.clone()) } else { outline() };
            match found.filter(|object| task.is_clear(object)) {
                Some(object) => {
                    left.turned[k] = (!whole).then(|| seen[k].heading);
                    left.places[k] = Some(left.objects.len());
                    left.objects.push(object);
                }
                None => left.fixed.push(standing(&plate, rest)),
            }
        }
        for (k, part) in left.now.objects.iter().enumerate().skip(rests.len()) {
            let Some(whole) = part.whole else { continue };
            let kept = left.places[whole.object].filter(|_| left.turned[whole.object].is_none());
            let Some(object) = kept else { continue };
            left.places[k] = Some(left.objects.len());
            left.objects.push(Object { whole: Some(Whole { object, ..whole }), ..part.clone() });
        }
        left
    }

    /// Returns the goal for an object that can be pushed. Returns `None` if the goal relates the
    /// object to one with another index here, or depends on an outline that has changed.
    fn goal(&self, mut goal: Goal) -> Option<Goal> {
        let same = |k: usize| self.places[k] == Some(k);
        let others = goal.demands.iter().flat_map(|demand| {
            let to = match demand.kind().to() {
                Some(Body::Object(other)) => Some(other),
                _ => None,
            };
            demand.kind().relative().into_iter().chain(to)
        });
        let known = others.clone().all(same);
        let related = others.count() > 0;
        if let Some(turned) = self.turned[goal.object] {
            let outlined = goal.demands.iter().any(|one| one.kind().share().is_some());
            if outlined || related {
                return None;
            }
            // The pushed outline has heading zero at its rest pose.
            let facing = goal.demands.iter_mut().filter_map(Demand::facing_mut);
            facing.for_each(|facing| facing.heading -= turned);
        }
        let object = self.places[goal.object]?;
        (known && (!related || same(goal.object))).then_some(Goal { object, ..goal })
    }

    fn scene(self, task: &Task) -> Scene {
        let Self { now, objects, fixed, places, .. } = self;
        let place = |k: usize| places[k];
        let joints = now.joints.iter().filter_map(|joint| {
            let [a, b] = joint.between;
            Some(Joint { between: [place(a)?, place(b)?], ..joint.clone() })
        });
        let mounts = now
            .mounts
            .iter()
            .filter_map(|mount| Some(WorldJoint { object: place(mount.object)?, ..mount.clone() }));
        let before = fixed.len();
        let frictions = now.frictions.iter().filter_map(|pair| {
            let with = match pair.with {
                Surface::Object(other) => Surface::Object(place(other)?),
                Surface::Obstacle(other) => Surface::Obstacle(before + other),
                other => other,
            };
            Some(PairFriction { object: place(pair.object)?, with, ..*pair })
        });
        let grounded = task.scene.obstacles.iter().map(Obstacle::grounded);
        Scene {
            joints: joints.collect(),
            mounts: mounts.collect(),
            frictions: frictions.collect(),
            obstacles: fixed.into_iter().chain(grounded).collect(),
            objects,
            ..now
        }
    }
}

/// Returns the plate as an object that can be pushed, if it lies on the table.
fn lying(plate: &Plate, rest: &Pose3) -> Option<Object> {
    let points = corners(plate, rest);
    let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    // A NaN does not count as on the table.
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

/// Returns the plate as an obstacle: its bounding box aligned with the world's axes.
fn standing(plate: &Plate, rest: &Pose3) -> Obstacle {
    let points = corners(plate, rest);
    let span = |of: &dyn Fn(&Vector3) -> f64| {
        let ends = points.iter().map(of);
        let (low, high) = (ends.clone().fold(f64::MAX, f64::min), ends.fold(f64::MIN, f64::max));
        (0.5 * (low + high), high - low)
    };
    let ((x, length), (y, width)) = (span(&|point| point.x), span(&|point| point.y));
    let top = points.iter().map(|point| point.z).fold(0.0, f64::max);
    Obstacle::cuboid(&plate.name, [length, width, top]).at(x, y, 0.0).friction(plate.friction)
}

/// Returns the corners of all solids of a plate and of its feet, in the world frame, metres.
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
