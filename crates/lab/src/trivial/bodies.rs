//! Bodies of a projection: objects, and groups of objects with fixed joints, each displaced and
//! rotated as little as possible.
//!
//! The cost of a correction is the sum of squared travels of all points of both bodies. A
//! correction of the distance of two points along a direction is divided between the two bodies,
//! and in each between displacement and rotation, so that this cost is smallest. The method is
//! position based dynamics of rigid bodies (Macklin et al. 2016, doi:10.1145/2994258.2994272), with
//! areas for masses.

use pushplan::internals::{
    geometry::{Pose, Vector, cross},
    scene::{JointKind, Physics, RigidGroups, Scene, Separation, Span},
};

/// The bodies of a scene and the joints between them.
pub(super) struct Bodies {
    bodies: Vec<Body>,
    /// Body of every object, an index into `bodies`.
    body_of: Vec<usize>,
    joints: Vec<BodyJoint>,
}

/// Objects that move as one.
struct Body {
    members: Vec<usize>,
    /// Poses of the members when the body's pose is the identity.
    rest: Vec<Pose>,
    pose: Pose,
    /// Area, square metres, and its second moment about the centre.
    area: f64,
    moment: f64,
}

/// A joint between objects of two bodies.
struct BodyJoint {
    between: [usize; 2],
    /// Frame of the joint relative to each object.
    frames: [Pose; 2],
    kind: JointKind,
    limits: Option<Span>,
}

/// A point at which a body is corrected.
#[derive(Clone, Copy)]
pub(super) struct Side {
    /// An object of the body.
    pub object: usize,
    /// Position of the correction, world frame, metres.
    pub at: Vector,
}

impl Bodies {
    /// Returns the bodies of `scene` with the joints of `physics`, at the poses that the scene
    /// states.
    pub fn new(scene: &Scene, physics: &Physics) -> Self {
        let objects = &scene.objects;
        let RigidGroups { of: body_of, members } = physics.rigid_groups();
        let mut bodies = Vec::new();
        for members in members {
            let footprint = |k: &usize| objects[*k].shape.footprint();
            let area: f64 = members.iter().map(|k| footprint(k).area()).sum();
            let weighted = |k: &usize| objects[*k].pose.position * footprint(k).area();
            let centre = members.iter().map(weighted).sum::<Vector>() / area;
            let rest: Vec<Pose> = members
                .iter()
                .map(|k| Pose {
                    position: objects[*k].pose.position - centre,
                    heading: objects[*k].pose.heading,
                })
                .collect();
            let moment = members.iter().zip(&rest).map(|(k, rest)| {
                let own = footprint(k).gyration_radius().powi(2);
                footprint(k).area() * (own + rest.position.norm_squared())
            });
            let moment = moment.sum();
            bodies.push(Body { members, rest, pose: Pose::default(), area, moment });
        }
        let joints = physics.joints.iter();
        let joints = joints.filter(|j| body_of[j.between[0]] != body_of[j.between[1]]);
        let joints = joints.map(|joint| BodyJoint {
            between: joint.between,
            frames: joint.frames(objects),
            kind: joint.kind,
            limits: joint.limits(),
        });
        Self { joints: joints.collect(), bodies, body_of }
    }

    /// Updates the poses of the bodies from the poses of objects.
    pub fn follow(&mut self, poses: &[Pose]) {
        for body in &mut self.bodies {
            body.pose = poses[body.members[0]] * body.rest[0].inverse();
        }
    }

    /// Returns `true` if two objects are parts of one body and cannot collide.
    pub fn same_body(&self, a: usize, b: usize) -> bool {
        self.body_of[a] == self.body_of[b]
    }

    /// Moves `first` by `distance` metres along the unit vector `direction` against `second`, or
    /// alone if there is no movable second body.
    pub fn part(
        &mut self,
        first: Side,
        second: Option<Side>,
        direction: Vector,
        distance: f64,
        poses: &mut [Pose],
    ) {
        let ease = |side: &Side| {
            let body = &self.bodies[self.body_of[side.object]];
            let arm = cross(side.at - body.pose.position, direction);
            1.0 / body.area + arm * arm / body.moment
        };
        let impulse = distance / (ease(&first) + second.as_ref().map_or(0.0, ease));
        self.push(first, direction * impulse, poses);
        if let Some(second) = second {
            self.push(second, direction * -impulse, poses);
        }
    }

    fn push(&mut self, side: Side, impulse: Vector, poses: &mut [Pose]) {
        let body = &mut self.bodies[self.body_of[side.object]];
        let turn = cross(side.at - body.pose.position, impulse) / body.moment;
        body.pose.position += impulse / body.area;
        body.pose.heading += turn;
        body.put(poses);
    }

    /// Rotates the second object of a pair by `angle` radians against the first.
    fn turn(&mut self, between: [usize; 2], angle: f64, poses: &mut [Pose]) {
        let [a, b] = between.map(|object| self.body_of[object]);
        let share = self.bodies[a].moment / (self.bodies[a].moment + self.bodies[b].moment);
        for (body, angle) in [(a, -angle * (1.0 - share)), (b, angle * share)] {
            self.bodies[body].pose.heading += angle;
            self.bodies[body].put(poses);
        }
    }

    /// Moves objects so that the joints hold, and returns the largest correction, metres.
    pub fn hold(&mut self, poses: &mut [Pose]) -> f64 {
        let mut largest: f64 = 0.0;
        for k in 0..self.joints.len() {
            let BodyJoint { between, frames, kind, limits } = self.joints[k];
            let separation =
                |poses: &[Pose]| Separation::of(&frames, between.map(|object| poses[object]));
            let excess = separation(poses).misfit(&kind, limits).turn;
            if excess != 0.0 {
                self.turn(between, -excess, poses);
                largest = largest.max(excess.abs() * frames[1].position.norm());
            }
            let now = separation(poses);
            let off = now.misfit(&kind, limits).offset;
            let distance = off.norm();
            if distance > 0.0 {
                let [first, second] = now.ends;
                let direction = first.vector(off / distance);
                let at = second.position;
                let [a, b] = between.map(|object| Side { object, at });
                self.part(a, Some(b), direction, distance, poses);
                largest = largest.max(distance);
            }
        }
        largest
    }
}

impl Body {
    fn put(&self, poses: &mut [Pose]) {
        for (member, rest) in self.members.iter().zip(&self.rest) {
            poses[*member] = self.pose * *rest;
        }
    }
}
