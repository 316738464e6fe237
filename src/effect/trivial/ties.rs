//! What a projection keeps of the joints: rigid groups, distances, sliding lines.

use crate::{
    geometry::{Pose, Vector, cross},
    scene::{JointKind, Scene, Span},
};

/// The joints of a scene as constraints on poses.
pub(super) struct Ties {
    groups: Vec<Group>,
    /// Index into `groups` of every object; objects that are fixed to none have their own.
    group_of: Vec<usize>,
    joints: Vec<Tie>,
}

/// Objects that fixed joints make one body.
struct Group {
    members: Vec<usize>,
    /// Poses of the members when the group's centre is the origin and it has not turned.
    rest: Vec<Pose>,
}

/// A joint between objects of two groups.
enum Tie {
    /// The centres keep their distance, metres.
    Distance { between: [usize; 2], apart: f64 },
    /// The second object stays on a line of the first.
    Line { between: [usize; 2], frames: [Pose; 2], limits: Option<Span> },
}

impl Ties {
    /// The joints of `scene`, as they hold at the poses that it states.
    pub fn new(scene: &Scene) -> Self {
        let objects = &scene.objects;
        let lowest = scene.groups(|joint| joint.kind == JointKind::Fixed);
        let mut groups = Vec::new();
        let mut group_of = vec![0; objects.len()];
        for first in (0..objects.len()).filter(|k| lowest[*k] == *k) {
            let members: Vec<usize> =
                (first..objects.len()).filter(|k| lowest[*k] == first).collect();
            members.iter().for_each(|k| group_of[*k] = groups.len());
            let centre = middle(members.iter().map(|k| &objects[*k].pose));
            let rest = members.iter().map(|k| Pose {
                position: objects[*k].pose.position - centre,
                heading: objects[*k].pose.heading,
            });
            groups.push(Group { rest: rest.collect(), members });
        }
        let joints =
            scene.joints.iter().filter(|j| group_of[j.between[0]] != group_of[j.between[1]]);
        let joints = joints.map(|joint| match joint.kind {
            JointKind::Prismatic { limits, .. } => {
                Tie::Line { between: joint.between, frames: joint.frames(objects), limits }
            }
            // A fixed joint lies within a group.
            JointKind::Revolute { .. } | JointKind::Fixed => {
                let [a, b] = joint.between.map(|k| objects[k].pose.position);
                Tie::Distance { between: joint.between, apart: (a - b).norm() }
            }
        });
        Self { joints: joints.collect(), groups, group_of }
    }

    /// Whether two objects are parts of one body and cannot meet.
    pub fn same_body(&self, a: usize, b: usize) -> bool {
        self.group_of[a] == self.group_of[b]
    }

    /// Moves objects so that the joints hold, two objects sharing a correction evenly, and
    /// gives the largest correction of a position, metres.
    pub fn hold(&self, poses: &mut [Pose]) -> f64 {
        let mut largest: f64 = 0.0;
        for tie in &self.joints {
            let (between, shift) = tie.shift(poses);
            poses[between[0]].position -= shift * 0.5;
            poses[between[1]].position += shift * 0.5;
            largest = largest.max(shift.norm());
        }
        for group in self.groups.iter().filter(|group| group.members.len() > 1) {
            largest = largest.max(group.hold(poses));
        }
        largest
    }
}

impl Tie {
    /// The two objects, and by how much the second must move against the first, metres.
    fn shift(&self, poses: &[Pose]) -> ([usize; 2], Vector) {
        match *self {
            Tie::Distance { between, apart } => {
                let line = poses[between[1]].position - poses[between[0]].position;
                let direction = line.try_normalize(1e-9).unwrap_or(Vector::x());
                (between, direction * (apart - line.norm()))
            }
            Tie::Line { between, frames, limits } => {
                let rail = poses[between[0]] * frames[0];
                let slider = poses[between[1]] * frames[1];
                let at = rail.local_point(slider.position);
                let along = limits.map_or(at.x, |span| at.x.clamp(span.low, span.high));
                (between, rail.vector(Vector::new(along - at.x, -at.y)))
            }
        }
    }
}

impl Group {
    /// Puts the members back into their arrangement, at the place and turn that fit their
    /// present positions best: least squares over the members, each counting alike (Kabsch
    /// 1976, doi:10.1107/S0567739476001873, in the plane).
    fn hold(&self, poses: &mut [Pose]) -> f64 {
        let centre = middle(self.members.iter().map(|k| &poses[*k]));
        let (mut sin, mut cos) = (0.0, 0.0);
        for (k, rest) in self.members.iter().zip(&self.rest) {
            let arm = poses[*k].position - centre;
            sin += cross(rest.position, arm);
            cos += rest.position.dot(&arm);
        }
        let body = Pose { position: centre, heading: sin.atan2(cos) };
        let mut largest: f64 = 0.0;
        for (k, rest) in self.members.iter().zip(&self.rest) {
            let pose = body * *rest;
            largest = largest.max((pose.position - poses[*k].position).norm());
            poses[*k] = pose;
        }
        largest
    }
}

fn middle<'a>(poses: impl ExactSizeIterator<Item = &'a Pose>) -> Vector {
    let count = poses.len() as f64;
    poses.map(|pose| pose.position).sum::<Vector>() / count
}
