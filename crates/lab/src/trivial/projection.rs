//! A model that only removes overlaps and holds joints.

use pushplan::internals::{
    effect::{EffectModel, Trust},
    geometry::Pose,
    outcome::{Record, Trajectory},
    scene::{Body, ModelSpec, Physics, Scene},
    task::Job,
};

use super::{
    bodies::{Bodies, Side},
    play::{Rule, Table, play_all},
};

/// Overlaps and joint errors below this are ignored, metres.
const LEFT: f64 = 1e-6;

/// Maximum number of rounds over all pairs in a small step; a row of three touching objects needs
/// about twenty.
const ROUNDS: usize = 200;

/// Baseline model that resolves overlaps by minimal displacements.
///
/// After every small step of the tool, objects are displaced and rotated as little as possible
/// until nothing overlaps and all joints hold. Tool and obstacles are fixed. Two bodies share a
/// correction by the areas that it moves, and objects joined by fixed joints are one body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Projection;

static SPEC: ModelSpec = ModelSpec::of(Projection::KIND);

struct Shifting {
    bodies: Bodies,
}

impl Rule for Shifting {
    fn begin(scene: &Scene, physics: &Physics) -> Self {
        Self { bodies: Bodies::new(scene, physics) }
    }

    fn step(&mut self, table: &Table, _: &Pose, to: &Pose, poses: &mut [Pose]) {
        self.bodies.follow(poses);
        for _ in 0..ROUNDS {
            let held = self.bodies.hold(poses);
            if held.max(self.part(table, to, poses)) < LEFT {
                break;
            }
        }
    }
}

impl Shifting {
    /// Moves every pair apart once, and returns the largest overlap, metres.
    fn part(&mut self, table: &Table, tool: &Pose, poses: &mut [Pose]) -> f64 {
        let mut largest: f64 = 0.0;
        for object in 0..poses.len() {
            for other in object + 1..poses.len() {
                if !self.bodies.same_body(object, other) {
                    let pose = poses[other];
                    let depth = self.leave(table, object, (Body::Object(other), pose), poses);
                    largest = largest.max(depth);
                }
            }
            for other in table.parts(tool).chain(table.obstacles()) {
                largest = largest.max(self.leave(table, object, other, poses));
            }
        }
        largest
    }

    /// Moves an object out of another body, and returns the depth of the overlap, metres.
    fn leave(
        &mut self,
        table: &Table,
        object: usize,
        other: (Body, Pose),
        poses: &mut [Pose],
    ) -> f64 {
        let points = table.contacts(object, &poses[object], (other.0, &other.1), 0.0);
        // Two corners of a face share the correction.
        let share = if points[1].is_some() { 0.5 } else { 1.0 };
        for point in points.iter().flatten() {
            let first = Side { object, at: point.on_first };
            let second = match other.0 {
                Body::Object(object) => Some(Side { object, at: point.on_second }),
                Body::Obstacle(_) | Body::Part(_) => None,
            };
            self.bodies.part(first, second, point.normal, -point.gap * share, poses);
        }
        points[0].map_or(0.0, |point| -point.gap)
    }
}

impl EffectModel for Projection {
    fn spec(&self) -> &ModelSpec {
        &SPEC
    }

    fn trust(&self, _: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return Trust::NotMine;
        }
        Trust::Mine { error: None, warnings: Vec::new() }
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        play_all::<Shifting>(&SPEC, scene, jobs, record)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pushplan::internals::{
        effect::{EffectModel, Job, Still},
        geometry::{Pose, Vector},
        outcome::{Record, Trajectory},
        scene::{Object, Part, Scene, Tool},
        task::{Push, ToolMotion},
    };

    use crate::trivial::{Follow, Projection};

    /// Rolls out a push of 0.20 m along x by a wide bar, with a can 5 mm ahead and a second one 20
    /// mm further.
    fn roll(model: &dyn EffectModel) -> Trajectory {
        let can = |name: &str, x| Object::cylinder(name, 0.05, 0.1).at(x, 0.0, 0.0);
        let objects = vec![can("near", 0.065), can("far", 0.185)];
        let scene = Scene::new(objects);
        let bar = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::default());
        let tool = Tool::new("bar", [bar]).expect("one piece");
        let push = Push { start: Vector::zeros(), direction: 0.0, length: 0.2, speed: 0.1 };
        let motion = ToolMotion::pushes(Arc::new(tool), 0.002, 0.0, &[push], true);
        let job = Job::stated(&scene, motion);
        model.rollout(&scene, &[job], Record::Frames).remove(0)
    }

    #[test]
    fn the_three_models_end_at_the_poses_of_their_rules() {
        for (model, expected, slack) in [
            (&Still as &dyn EffectModel, [0.065, 0.185], 0.0),
            // The object sticks at the first small step with an overlap, so up to a step deep.
            (&Follow, [0.26, 0.36], 2.1e-3),
            (&Projection, [0.26, 0.36], 1e-4),
        ] {
            let trajectory = roll(model);
            assert_eq!(trajectory.frames.len(), 21, "{}", model.spec());
            for (pose, expected) in trajectory.outcome().poses.iter().zip(expected) {
                let off = (pose.position - Vector::new(expected, 0.0)).norm();
                assert!(off <= slack, "{}: {pose:?}", model.spec());
            }
        }
    }

    #[test]
    fn first_contacts_are_listed_in_order_of_time() {
        let contacts = roll(&Projection).contacts;
        assert_eq!(contacts.len(), 2);
        assert!(contacts[0].frame == 1 && contacts[1].frame == 3, "{contacts:?}");
    }
}
