//! What is left of a task once some of its steps are made: pushes of what lies on the table by then,
//! or lever-ups of what still lies on its underside.

use crate::geometry::{ConvexPolygon, Pose, Pose3, Vector, Vector3, clearance};
use crate::{
    scene::{
        Body, Joint, MAX_FEET, Mount, Object, Obstacle, PairFriction, Plate, Scene, State, Support,
        Surface, Unknowns, Whole, carries,
    },
    task::{Demand, Ending, Goal, PushRules, Task},
};

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
    /// The task of pushing the goals' objects to their places once all objects lie at `rests` (their
    /// frames): nothing if the task allows no pushes or asks for nothing in the plane, or if such an object
    /// does not lie on the table.
    ///
    /// Objects that stand as they stood are those of the scene, with their joints. Of others that lie on the
    /// table the outlines are left, on the points that carry them. Those that lie on something else are
    /// obstacles, and obstacles count as standing on the table.
    pub fn after(&self, rests: &[Pose3]) -> Option<Task> {
        if self.pushes.max_count == 0 {
            return None;
        }
        // Between a lever-up and a push the tool is changed.
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
            description: format!("What is left of {} after the lever-up.", self.name),
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

    /// The task from where all objects lie at `rests`; nothing if one of several solids does not lie on its
    /// underside any more, because it is then no object that a scene can state.
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

    /// Whether an object is beside all obstacles, not over one.
    fn is_clear(&self, object: &Object) -> bool {
        let own = object.shape.footprint();
        self.scene.obstacles.iter().all(|obstacle| {
            let base = obstacle.shape().footprint();
            clearance((&own, &object.pose), (&base, &obstacle.pose), BESIDE) > 0.0
        })
    }
}

/// Returns the demands of a goal that pushes can satisfy; `None` for one that leaves the plane and names no place.
fn flat(goal: &Goal) -> Option<Goal> {
    let mut flat = goal.clone();
    flat.demands.retain(Demand::is_pose);
    let wanted = flat.has_place() || goal.is_pose() && !flat.demands.is_empty();
    wanted.then_some(flat)
}

/// Returns `true` if an object still stands on its underside as it did.
fn stands(plate: &Plate, rest: &Pose3) -> bool {
    let sunk = (rest.position.z - plate.z).abs();
    Ending::of(rest) == Ending::Back && rest.tilt() <= LEVEL && sunk <= ON_TABLE
}

/// The scene with its objects at these poses, and all joints as they are then.
fn carried(scene: &Scene, seen: &[Pose]) -> Scene {
    let mut now = scene.moved_to(&State::at_rest(scene.with_parts(seen.to_vec())));
    let joints = scene.joints.iter().map(|joint| joint.carried(&scene.objects, &now.objects));
    now.joints = joints.collect();
    now
}

/// The scene in the plane that some steps leave.
struct Left {
    /// The scene with its objects seen from above.
    now: Scene,
    /// The objects that can be pushed, then the parts of those that are objects of the scene.
    objects: Vec<Object>,
    /// The others.
    fixed: Vec<Obstacle>,
    /// For each object of the scene its place among the objects.
    places: Vec<Option<usize>>,
    /// Heading of an object that is an outline in its first pose.
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

    /// The goal of an object that can be pushed; nothing if it relates the object to one that has another
    /// number here, or asks for an outline that is not that of the scene.
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
            // The outline that is pushed is unturned where it rests.
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
            .filter_map(|mount| Some(Mount { object: place(mount.object)?, ..mount.clone() }));
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
