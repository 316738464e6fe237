//! Bodies that a stroke can set in motion; only these are processed in its frames.
//!
//! The list contains objects near the tool's swept area, moving objects, and, recursively, objects
//! near them or joined to them. *Near* includes a margin for motion. When an object has used it up,
//! or the stroke ends, the list is made again. It therefore never omits a body that a frame of the
//! whole scene would relate, however far the network moves objects. This is the neighbour list of
//! molecular dynamics (Verlet 1967, doi:10.1103/PhysRev.159.98).

use crate::{
    contact::{Bodies, ListIndex, MARGIN, SceneIndex, Subset},
    geometry::{Footprint, Pose, Vector, perpendicular},
    scene::{Scene, State, Velocity},
    task::{Job, Stroke},
};

/// Travel of an object after which the list is made again, metres. A push of 20 cm then makes four
/// lists, and a list contains little more than the objects within a hand's breadth.
const SKIN: f64 = 0.05;

/// Allowance for rounding, metres.
const ROUNDING: f64 = 1e-7;

/// The currently relevant bodies of a scene.
pub type Listed = Subset<SceneIndex, ListIndex>;

/// Construction and validity of the neighbour list.
#[derive(Clone, Debug, Default)]
pub struct Reach {
    /// Positions of the listed objects when the list was made.
    positions: Vec<Vector>,
    /// Maximum travel of each object, metres.
    skin: f64,
    sweeps: Vec<Sweep>,
    /// Gap below which a static pair is related, metres.
    near: f64,
    listed: Vec<bool>,
}

/// The remaining part of a stroke.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    pub stroke: &'a Stroke,
    /// Number of completed frames.
    pub frame: usize,
    /// Number of frames predicted as one.
    pub stride: usize,
}

/// Returns the objects of `scene` that `job` can set in motion from its start, in order. Each
/// stroke is considered alone, from the start. Without strokes all objects are returned.
pub fn reachable(scene: &Scene, job: &Job) -> Vec<usize> {
    let Job { start, motion, physics } = job;
    let count = scene.objects.len();
    if motion.slide().strokes.is_empty() {
        return (0..count).collect();
    }
    let whole = Bodies::new(scene, &motion.slide().tool, motion.slide().lift, physics);
    let (mut reach, mut subset) = (Reach::default(), Listed::default());
    let mut reached = vec![false; count];
    for stroke in &motion.slide().strokes {
        let course = Course { stroke, frame: 0, stride: 1 };
        reach.list(&whole, start, course, 0.0, &mut subset);
        subset.objects.iter().for_each(|object| reached[object.0] = true);
    }
    (0..count).filter(|&object| reached[object]).collect()
}

/// The swept area of a part: a rectangle along the stroke.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    axis: Vector,
    /// Extent at the stroke's start along the axis and across it, metres.
    along: (f64, f64),
    across: (f64, f64),
    /// Interval of the tool's travel in which the area is swept, metres from the stroke's start.
    travel: (f64, f64),
    /// Height of the part's underside, metres.
    underside: f64,
}

impl Reach {
    /// Lists in `subset` the bodies that the rest of a stroke can set in motion, and gathers their
    /// data. The coming frame lasts `duration` seconds.
    pub fn list(
        &mut self,
        whole: &Bodies,
        state: &State,
        Course { stroke, frame, stride }: Course<'_>,
        duration: f64,
        subset: &mut Listed,
    ) {
        let advance = stroke.travel() / stroke.frames() as f64;
        self.near = MARGIN + advance * stride as f64 + ROUNDING;
        self.sweep(whole, stroke, advance * frame.min(stroke.frames()) as f64);
        let count = whole.objects.len();
        let Self { listed, sweeps, near, .. } = self;
        let Subset { objects, parts, obstacles, .. } = subset;
        listed.clear();
        listed.resize(count, false);
        objects.clear();
        self.skin = SKIN;
        let hull = Sweep::hull(sweeps);
        for (k, body) in whole.objects.iter().enumerate() {
            let (pose, velocity) = (&state.poses[k], &state.velocities[k]);
            let moves = *velocity != Velocity::default();
            let room = body.radius + *near;
            // A position that is not a number counts as near everything.
            let apart = hull.is_some_and(|hull| hull.square_gap(pose.position) > room * room);
            if !moves && apart {
                continue;
            }
            let swept = |sweep: &Sweep| {
                sweep.underside < body.span.1 && sweep.square_gap(pose.position) <= room * room
            };
            let lost = !pose.is_finite();
            if moves || lost || sweeps.iter().any(swept) {
                listed[k] = true;
                objects.push(SceneIndex(k));
                self.skin = self.skin.max(SKIN + way(velocity, body.radius, duration));
            }
        }
        // Neighbours of neighbours: the list grows during the iteration.
        let near = *near + self.skin;
        let mut next = 0;
        while let Some(&SceneIndex(object)) = objects.get(next) {
            next += 1;
            let (centre, radius) = (state.poses[object].position, whole.objects[object].radius);
            let mechanism = whole.mechanisms[object];
            for (other, taken) in listed.iter_mut().enumerate().filter(|(_, taken)| !**taken) {
                let room = radius + whole.objects[other].radius + near;
                let square = (state.poses[other].position - centre).norm_squared();
                if whole.mechanisms[other] == mechanism || square <= room * room {
                    *taken = true;
                    objects.push(SceneIndex(other));
                }
            }
        }
        objects.sort_unstable();
        let turns = stroke.from.heading != stroke.to.heading;
        parts.clear();
        parts.extend((0..whole.parts.len()).filter(|&part| {
            turns
                || objects.iter().any(|&SceneIndex(k)| {
                    let (sweep, body) = (&sweeps[part], &whole.objects[k]);
                    let room = body.radius + near;
                    sweep.underside < body.span.1
                        && sweep.square_gap(state.poses[k].position) <= room * room
                })
        }));
        obstacles.clear();
        obstacles.extend((0..whole.obstacles.len()).filter(|&index| {
            let obstacle = &whole.obstacles[index];
            objects.iter().any(|&SceneIndex(k)| {
                let gap = gap(&obstacle.footprint, &obstacle.pose, state.poses[k].position);
                obstacle.span.0 < whole.objects[k].span.1 && gap <= whole.objects[k].radius + near
            })
        }));
        subset.gather(whole);
        self.positions.clear();
        self.positions.extend(subset.objects.iter().map(|k| state.poses[k.0].position));
    }

    /// Returns `true` if the list still contains everything that a frame of `duration` seconds can
    /// relate; `state` has the listed objects.
    pub fn holds(&self, bodies: &Bodies, state: &State, duration: f64) -> bool {
        self.positions.iter().enumerate().all(|(k, position)| {
            let moved = (state.poses[k].position - position).norm();
            moved + way(&state.velocities[k], bodies.objects[k].radius, duration) <= self.skin
        })
    }

    /// Returns the first frame of the stroke, from `frame` on, in which the tool comes near a
    /// listed object, provided that none moves. The result is beyond the last frame if it never
    /// does.
    pub fn first_contact(
        &self,
        subset: &Listed,
        state: &State,
        stroke: &Stroke,
        frame: usize,
    ) -> usize {
        let advance = stroke.travel() / stroke.frames() as f64;
        let mut first = usize::MAX;
        for &part in &subset.parts {
            let sweep = &self.sweeps[part];
            for (body, pose) in subset.bodies.objects.iter().zip(&state.poses) {
                if sweep.underside >= body.span.1 {
                    continue;
                }
                let room = body.radius + self.near;
                let Some((enter, leave)) = sweep.window(pose.position, room) else { continue };
                let now = advance * frame as f64;
                if now > leave {
                    continue;
                }
                let at = if enter > now { (enter / advance).ceil() as usize } else { frame };
                first = first.min(at);
            }
        }
        first
    }

    /// Computes the sweeps of all parts from the `done`-th metre of the stroke on.
    fn sweep(&mut self, whole: &Bodies, stroke: &Stroke, done: f64) {
        let travel = stroke.to.position - stroke.from.position;
        let length = travel.norm();
        let axis = if length > 0.0 { travel / length } else { Vector::x() };
        let side = perpendicular(axis);
        let turns = stroke.from.heading != stroke.to.heading;
        self.sweeps.clear();
        self.sweeps.extend(whole.parts.iter().map(|part| {
            // A rotating tool stays within a circle about its frame.
            let (centre, along, across) = if turns {
                let reach = part.pose.position.norm() + part.footprint.bounding_radius();
                (stroke.from.position, [reach; 2], [reach; 2])
            } else {
                let pose = stroke.from * part.pose;
                let extent = |v| part.footprint.extent(pose.local_vector(v)) + ROUNDING;
                (pose.position, [-axis, axis].map(extent), [-side, side].map(extent))
            };
            let (x, y) = (centre.dot(&axis), centre.dot(&side));
            Sweep {
                axis,
                along: (x - along[0], x + along[1]),
                across: (y - across[0], y + across[1]),
                travel: (done, length),
                underside: part.span.0,
            }
        }));
    }
}

impl Sweep {
    /// Returns an area that contains all `sweeps`, which lie along the same axis.
    fn hull(sweeps: &[Sweep]) -> Option<Sweep> {
        let join = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
        sweeps.iter().copied().reduce(|a, b| Sweep {
            along: join(a.along, b.along),
            across: join(a.across, b.across),
            underside: a.underside.min(b.underside),
            ..a
        })
    }

    /// Returns the square of the distance of a point from the swept area, square metres.
    fn square_gap(&self, point: Vector) -> f64 {
        let (x, y) = (point.dot(&self.axis), point.dot(&perpendicular(self.axis)));
        let beyond = |value: f64, low: f64, high: f64| (low - value).max(value - high).max(0.0);
        let along = beyond(x, self.along.0 + self.travel.0, self.along.1 + self.travel.1);
        let across = beyond(y, self.across.0, self.across.1);
        along * along + across * across
    }

    /// Returns the interval of the tool's travel in which the part is at most `room` metres from a
    /// point.
    fn window(&self, point: Vector, room: f64) -> Option<(f64, f64)> {
        let (x, y) = (point.dot(&self.axis), point.dot(&perpendicular(self.axis)));
        let aside = (self.across.0 - y).max(y - self.across.1).max(0.0);
        let half = room * room - aside * aside;
        if half < 0.0 {
            return None;
        }
        let half = half.sqrt();
        Some((x - half - self.along.1, x + half - self.along.0))
    }
}

/// Returns an upper bound on the travel of any point of a body in `duration` seconds, metres.
fn way(velocity: &Velocity, radius: f64, duration: f64) -> f64 {
    (velocity.linear.norm() + velocity.angular.abs() * radius) * duration
}

/// Returns the distance of a point from a body, metres; zero inside.
fn gap(footprint: &Footprint, pose: &Pose, point: Vector) -> f64 {
    match *footprint {
        Footprint::Disc { radius } => ((point - pose.position).norm() - radius).max(0.0),
        Footprint::Rectangle { half } => {
            let local = pose.local_point(point);
            (local.abs() - half).sup(&Vector::zeros()).norm()
        }
        // A lower bound is enough, because obstacles are cuboids.
        Footprint::Polygon(polygon) => {
            ((point - pose.position).norm() - polygon.bounding_radius()).max(0.0)
        }
    }
}
