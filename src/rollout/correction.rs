//! Corrections of a rolled-out push along its course.
//!
//! The analytic model rolls the push out first. The network then reads the graphs of its frames,
//! and every frame t adds to the change of an object's pose
//!
//! ```text
//! change(T) = sum over t up to T of length_t * C(frame t)
//! ```
//!
//! where `length_t` is the length of the object's analytic motion in the frame and C is bounded. An
//! object that does not move is not corrected, and a change grows along the path of the object. The
//! corrections are not fed back into contacts: bodies are only moved out of each other, and joints
//! are closed again.

use crate::{
    contact::{Bodies, project_joints},
    geometry::{ContactPoint, Footprint, Pose, Vector, contact_points},
    graph::{Correction, Corrections, READOUTS},
    outcome::{Frame, Spread, Trajectory},
    scene::State,
};

/// Overlap that remains between bodies after a correction, metres: as after a frame's solution.
const SLACK: f64 = 2e-4;

/// Number of rounds in which overlaps are removed after each step.
const ROUNDS: usize = 3;

/// Length of a step in which changes are added, metres: little compared with the faces of bodies.
const STEP: f64 = 2e-3;

/// Maximum number of steps; learned changes rarely need more than one.
const MOST_STEPS: f64 = 16.0;

/// The motion of an object in a frame that the network reads: in the frame itself, or in the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Read {
    /// Index of the node in the batch.
    pub node: u32,
    /// Index of the object in the scene.
    pub object: u32,
    /// Indices of the recorded frames before and after the motion.
    pub frames: [u32; 2],
    /// Length of the motion, see [`crate::graph::Node::length`], metres.
    pub length: f64,
    /// Unit vector of the tool's motion.
    pub axis: Vector,
    /// Length c of the object's limit surface, metres.
    pub support: f64,
}

/// An analytic rollout with the places where the network reads it.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Analytic trajectory.
    pub trajectory: Trajectory,
    /// Motions that the network corrects, in order of time.
    pub reads: Vec<Read>,
}

impl Read {
    /// Returns the change of x, y (metres) and heading (radians) for this correction of the node.
    pub fn change(&self, [along, across, turn]: [f64; 3]) -> [f64; 3] {
        let (x, y) = (self.axis.x * self.length, self.axis.y * self.length);
        [x * along - y * across, y * along + x * across, turn * self.length / self.support]
    }
}

/// Sum of corrections of an object.
#[derive(Clone, Copy, Debug, Default)]
struct Change {
    readouts: [[f64; 3]; READOUTS],
    head: [f64; 3],
    doubt: Option<Spread>,
}

impl Change {
    fn add(&mut self, read: &Read, correction: &Correction, share: f64) {
        let head = [(&mut self.head, correction.head)];
        for (sum, rate) in self.readouts.iter_mut().zip(correction.readouts).chain(head) {
            let change = read.change(rate);
            (0..3).for_each(|k| sum[k] += share * change[k]);
        }
        if let Some([position, heading]) = correction.doubt {
            let length = share * read.length;
            let heading = length * heading / read.support;
            *self.doubt.get_or_insert_default() += Spread { position: length * position, heading };
        }
    }

    /// Returns displacement and rotation: the mean m of the readouts, shrunk by m^2 / (m^2 + d^2)
    /// where they differ from it by d. Engines that agree are followed, and opposite ones cancel.
    /// The change of a head, learned from a table, is added as it is.
    fn mean(&self) -> (Vector, f64) {
        let mean = |k: usize| self.readouts.iter().map(|sum| sum[k]).sum::<f64>() / READOUTS as f64;
        let (shift, turn) = (Vector::new(mean(0), mean(1)), mean(2));
        let Spread { position, heading } = self.apart();
        let share = |m: f64, d: f64| if m == 0.0 { 0.0 } else { m * m / (m * m + d * d) };
        let [x, y, own] = self.head;
        let shift = share(shift.norm(), position) * shift + Vector::new(x, y);
        (shift, share(turn, heading) * turn + own)
    }

    /// Returns the distance of the readouts from their mean.
    fn apart(&self) -> Spread {
        let [a, b] = self.readouts;
        Spread {
            position: (a[0] - b[0]).hypot(a[1] - b[1]) / 2.0,
            heading: (a[2] - b[2]).abs() / 2.0,
        }
    }
}

impl Reading {
    /// Returns the trajectory with `corrections` of all frames, among these bodies.
    pub fn corrected(self, bodies: &Bodies, corrections: &Corrections) -> Trajectory {
        let Self { mut trajectory, reads } = self;
        let mut changes = vec![Change::default(); bodies.objects.len()];
        let mut objects: Vec<usize> = reads.iter().map(|read| read.object as usize).collect();
        objects.sort_unstable();
        objects.dedup();
        if objects.is_empty() {
            return trajectory;
        }
        let of = |read: &Read| &corrections.nodes[read.node as usize];
        let last = trajectory.frames.len().saturating_sub(1);
        let mut done = 0;
        for (n, frame) in trajectory.frames.iter_mut().enumerate() {
            let complete = |read: &Read| n == last || read.frames[1] as usize <= n;
            while let Some(read) = reads.get(done).filter(|read| complete(read)) {
                changes[read.object as usize].add(read, of(read), 1.0);
                done += 1;
            }
            // A longer step covers several recorded frames.
            let begun = reads[done..].iter().take_while(|read| (read.frames[0] as usize) < n);
            if begun.clone().next().is_none() {
                apply(bodies, frame, &objects, &changes);
                continue;
            }
            let mut partly = changes.clone();
            for read in begun {
                let [from, to] = read.frames.map(f64::from);
                let share = (n as f64 - from) / (to - from);
                partly[read.object as usize].add(read, of(read), share);
            }
            apply(bodies, frame, &objects, &partly);
        }
        for object in objects {
            let Some(doubt) = changes[object].doubt else { continue };
            let apart = changes[object].apart();
            let [position, heading] = corrections.apart;
            trajectory.spreads.resize(bodies.objects.len(), Spread::default());
            trajectory.spreads[object] = Spread {
                position: doubt.position + position * apart.position,
                heading: doubt.heading + heading * apart.heading,
            };
        }
        trajectory
    }
}

/// Adds the changes of these objects to their poses, which then neither overlap nor leave joints.
///
/// Large changes are added in steps, so that overlaps stay shallow and their normals clear.
fn apply(bodies: &Bodies, frame: &mut Frame, objects: &[usize], changes: &[Change]) {
    let Frame { tool, state, .. } = frame;
    let changes: Vec<(Vector, f64)> = objects.iter().map(|&k| changes[k].mean()).collect();
    let budget = |(&object, (shift, turn)): (&usize, &(Vector, f64))| {
        shift.norm() + bodies.objects[object].radius * turn.abs()
    };
    let mut left: Vec<f64> = objects.iter().zip(&changes).map(budget).collect();
    let largest = left.iter().copied().fold(0.0, f64::max);
    if largest == 0.0 {
        return;
    }
    let steps = (largest / STEP).ceil().min(MOST_STEPS);
    for _ in 0..steps as usize {
        for (&object, (shift, turn)) in objects.iter().zip(&changes) {
            let pose = &mut state.poses[object];
            pose.position += *shift / steps;
            pose.heading += turn / steps;
        }
        for _ in 0..ROUNDS {
            let shifts = separating(bodies, state, tool, objects);
            if shifts.iter().all(|shift| *shift == Vector::zeros()) {
                break;
            }
            for ((&object, shift), left) in objects.iter().zip(&shifts).zip(&mut left) {
                let length = shift.norm();
                if length > 0.0 {
                    let share = (*left / length).min(1.0);
                    state.poses[object].position += share * shift;
                    *left -= share * length;
                }
            }
        }
    }
    project_joints(bodies, state, |object| objects.contains(&object));
}

/// Returns the shifts that move corrected objects out of other bodies, metres.
///
/// Pairs are treated at once, so that the result does not depend on their order. Two corrected
/// objects share a shift by their sizes.
fn separating(bodies: &Bodies, state: &State, tool: &Pose, objects: &[usize]) -> Vec<Vector> {
    let depth = |first: (&Footprint, &Pose), second: (&Footprint, &Pose)| -> Option<Vector> {
        let ContactPoint { gap, normal, .. } = contact_points(first, second, -SLACK).0[0]?;
        Some(-(gap + SLACK) * normal)
    };
    let mut shifts = vec![Vector::zeros(); objects.len()];
    for (k, &object) in objects.iter().enumerate() {
        let body = &bodies.objects[object];
        let own = (&body.footprint, &state.poses[object]);
        for (other, with) in bodies.objects.iter().enumerate() {
            let joined = bodies.mechanisms[other] == bodies.mechanisms[object];
            let place = objects.binary_search(&other).ok();
            // A pair of corrected objects is treated once.
            if joined || !body.meets(with.span) || place.is_some() && other < object {
                continue;
            }
            let Some(out) = depth(own, (&with.footprint, &state.poses[other])) else { continue };
            match place {
                None => shifts[k] += out,
                Some(place) => {
                    let share = with.radius / (body.radius + with.radius);
                    shifts[k] += share * out;
                    shifts[place] -= (1.0 - share) * out;
                }
            }
        }
        // Bodies with prescribed motion may be pieces of one face, of which the deepest counts.
        let obstacles = bodies.obstacles.iter().map(|one| (one, one.pose));
        let parts = bodies.parts.iter().map(|part| (part, *tool * part.pose));
        let others = obstacles.chain(parts).filter(|(other, _)| body.meets(other.span));
        let outs = others.filter_map(|(other, pose)| depth(own, (&other.footprint, &pose)));
        let deepest = outs.max_by(|a, b| a.norm().total_cmp(&b.norm()));
        shifts[k] += deepest.unwrap_or_default();
    }
    shifts
}
