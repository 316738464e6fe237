//! The loop over strokes and frames that the trivial models share.

use rayon::prelude::*;

use pushplan::internals::{
    geometry::{ContactPoint, Pose, contact_points},
    outcome::{Contact, Frame, Record, Trajectory},
    scene::{Body, ModelSpec, Physics, Scene, State, TOUCHING, Tool},
    task::{Job, ToolMotion},
};

/// Tool travel per small step, metres, small enough that overlaps stay much smaller than any body.
const STEP: f64 = 1e-3;

/// A rule by which objects move when the tool moves.
pub(super) trait Rule {
    /// Creates the rule for a scene under `physics`, nothing touched yet.
    fn begin(scene: &Scene, physics: &Physics) -> Self;

    /// Moves `poses` for a small step of the tool.
    fn step(&mut self, table: &Table, from: &Pose, to: &Pose, poses: &mut [Pose]);

    /// Handles the lift of the tool.
    fn lift(&mut self) {}
}

/// Scene and motion, with the queries of rules.
pub(super) struct Table<'a> {
    pub(super) scene: &'a Scene,
    pub(super) motion: &'a ToolMotion,
}

impl Table<'_> {
    fn tool(&self) -> &Tool {
        &self.motion.tool
    }

    /// Returns the closest point of object `index` at `pose` and another body, within `reach`
    /// metres; the normal points into the object. Returns `None` if they pass above each other.
    pub(super) fn contact(
        &self,
        index: usize,
        pose: &Pose,
        other: (Body, &Pose),
        reach: f64,
    ) -> Option<ContactPoint> {
        self.contacts(index, pose, other, reach)[0]
    }

    /// Returns [`Self::contact`] and the second point of two rectangles.
    pub(super) fn contacts(
        &self,
        index: usize,
        pose: &Pose,
        other: (Body, &Pose),
        reach: f64,
    ) -> [Option<ContactPoint>; 2] {
        let object = &self.scene.objects[index];
        let footprint = match other.0 {
            Body::Object(other) => {
                let other = &self.scene.objects[other];
                if !object.meets(other.span()) {
                    return [None, None];
                }
                other.shape.footprint()
            }
            Body::Obstacle(other) => {
                let obstacle = &self.scene.obstacles[other];
                if !obstacle.meets(object.span()) {
                    return [None, None];
                }
                obstacle.shape().footprint()
            }
            Body::Part(other) => {
                let part = &self.tool().parts()[other];
                let lift = self.motion.lift;
                if !object.meets([lift, lift + part.shape.height()]) {
                    return [None, None];
                }
                part.footprint()
            }
        };
        let first = (&object.shape.footprint(), pose);
        contact_points(first, (&footprint, other.1), reach).0
    }

    /// Iterates over the tool's parts with their poses when the tool frame is at `tool`.
    pub(super) fn parts(&self, tool: &Pose) -> impl Iterator<Item = (Body, Pose)> + use<'_> {
        let tool = *tool;
        (0..self.tool().parts().len())
            .map(move |part| (Body::Part(part), self.tool().part_pose(part, &tool)))
    }

    /// Iterates over the obstacles with their poses.
    pub(super) fn obstacles(&self) -> impl Iterator<Item = (Body, Pose)> + use<'_> {
        let obstacles = self.scene.obstacles.iter().enumerate();
        obstacles.map(|(index, obstacle)| (Body::Obstacle(index), obstacle.pose))
    }
}

/// Plays every job with a new rule.
pub(super) fn play_all<R: Rule>(
    by: &ModelSpec,
    scene: &Scene,
    jobs: &[Job],
    record: Record,
) -> Vec<Trajectory> {
    jobs.par_iter().map(|job| play::<R>(by, scene, job, record)).collect()
}

fn play<R: Rule>(by: &ModelSpec, scene: &Scene, job: &Job, record: Record) -> Trajectory {
    let table = Table { scene, motion: job.motion.slide() };
    let mut rule = R::begin(scene, &job.physics);
    let mut poses = job.start.poses.clone();
    let tool = job.motion.slide().strokes.first().map(|stroke| stroke.from).unwrap_or_default();
    let mut frame = Frame { time: 0.0, stroke: 0, tool, state: job.start.clone(), blade: None };
    let mut trajectory = Trajectory::new(by.clone());
    let mut count = 0;
    for (index, stroke) in job.motion.slide().strokes.iter().enumerate() {
        for step in (0..stroke.frames()).map(|k| stroke.frame(k)) {
            let travel = (step.to.position - step.from.position).norm();
            let steps = (travel / STEP).ceil().max(1.0);
            for k in 0..steps as usize {
                let from = step.from.towards(&step.to, k as f64 / steps);
                let to = step.from.towards(&step.to, (k + 1) as f64 / steps);
                rule.step(&table, &from, &to, &mut poses);
            }
            let state = State::at_rest(poses.clone());
            let next = Frame {
                time: frame.time + step.duration,
                stroke: index,
                tool: step.to,
                state,
                blade: None,
            };
            let before = std::mem::replace(&mut frame, next);
            if record == Record::Frames {
                trajectory.frames.push(before);
                count += 1;
                note_contacts(&table, &frame, count, &mut trajectory.contacts);
            }
        }
        if stroke.settle {
            rule.lift();
        }
    }
    trajectory.frames.push(frame);
    trajectory
}

/// Adds the pairs that touch now for the first time.
fn note_contacts(table: &Table, frame: &Frame, index: usize, contacts: &mut Vec<Contact>) {
    let poses = &frame.state.poses;
    for (object, pose) in poses.iter().enumerate() {
        let objects = (object + 1..poses.len()).map(|other| (Body::Object(other), poses[other]));
        for (with, other) in table.parts(&frame.tool).chain(table.obstacles()).chain(objects) {
            let known = contacts.iter().any(|c| c.object == object && c.with == with);
            if !known && table.contact(object, pose, (with, &other), TOUCHING).is_some() {
                contacts.push(Contact { frame: index, object, with });
            }
        }
    }
}
