//! Data of every body for a frame's equations, computed once per rollout.

use std::sync::Arc;

use crate::{
    geometry::{AreaMoments, ContactPoint, Footprint, Placed, Pose, Rim, Turn, Vector, clearance},
    scene::{
        Body, Feet, GRAVITY, JOIN_GAP, JointKind, PairFriction, Physics, RigidGroups, Scene,
        Separation, Span, Surface, Tool, face_height, pair_friction,
    },
};

use super::{
    fall::Fall,
    fixed_joints::propagate,
    index::{GroupIndex, SceneIndex},
    pairs::{PairId, Pairs},
};

/// A movable body.
#[derive(Clone, Copy, Debug)]
pub struct Movable {
    /// Index of the object in the scene.
    pub index: SceneIndex,
    /// Footprint on the table.
    pub footprint: Footprint,
    /// Radius of the bounding circle about the centre, metres.
    pub radius: f64,
    /// Mean distance c of the support's points from the centre, metres.
    pub support: f64,
    /// (c / rho)^2, the ratio of the rotational friction deceleration (in c omega) to the
    /// translational.
    pub spin: f64,
    /// Decrease of both speeds during sliding with rotation.
    pub(super) fall: Fall,
    /// Friction deceleration mu g, m/s^2.
    pub deceleration: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value.
    pub friction: f64,
    /// Vertical extent, metres.
    pub height: f64,
    /// Range of heights above the table, metres.
    pub span: (f64, f64),
    /// Load on the table from the object, and from parts above the table, relative to the object's
    /// own weight.
    pub carried: f64,
    /// Displacement of the load under a push as large as the friction, metres.
    pub lean: f64,
    /// Mean height at which the tool can push, metres; zero if the tool passes over.
    pub face_height: f64,
}

impl Movable {
    /// Returns the maximum table friction, N.
    pub fn load(&self) -> f64 {
        self.mass * self.deceleration * self.carried
    }

    /// Returns `true` if this range of heights overlaps the object's range.
    pub fn meets(&self, (low, high): (f64, f64)) -> bool {
        low < self.span.1 && self.span.0 < high
    }
}

/// A body with prescribed motion: a tool part or an obstacle.
#[derive(Clone, Copy, Debug)]
pub struct PrescribedBody {
    /// Index of the part of the tool, or of the obstacle of the scene.
    pub index: usize,
    /// Footprint on the table.
    pub footprint: Footprint,
    /// Tool parts: pose in the tool frame. Obstacles: pose in the world.
    pub pose: Pose,
    /// Rotation by the heading of `pose`.
    pub turn: Turn,
    /// Friction value.
    pub friction: f64,
    /// Range of heights above the table, metres.
    pub span: (f64, f64),
    /// Area moments of the rigid body that contains it, propagated over fixed joints; in the tool
    /// frame or in the world.
    pub body: AreaMoments,
}

/// A joint between two objects.
#[derive(Clone, Copy, Debug)]
pub struct Jointed {
    /// Indices of the two objects.
    pub between: [usize; 2],
    /// Kind of the joint.
    pub kind: JointKind,
    /// The joint's frame relative to each object, see [`crate::scene::Joint::frames`].
    pub frames: [Pose; 2],
    /// Rotation by the heading of the first frame.
    pub turn: Turn,
    /// Range of rotations (radians) or displacements (metres) relative to the start, if limited.
    pub limits: Option<Span>,
    /// Whether anchor or axis is only a guess.
    pub guessed: bool,
}

impl Jointed {
    /// Returns the relative pose of the joint's sides with the objects at `poses`.
    pub fn separation(&self, poses: &[Pose]) -> Separation {
        Separation::of(&self.frames, self.between.map(|object| poses[object]))
    }

    /// Returns the relative pose of the joint's sides and the direction of the first side's x axis,
    /// given the rotations of the objects.
    pub(super) fn separation_turned(&self, poses: &[Pose], turns: &[Turn]) -> (Separation, Vector) {
        let end = |side: usize| {
            let (object, frame) = (self.between[side], &self.frames[side]);
            let Pose { position, heading } = poses[object];
            let position = position + turns[object].of(frame.position);
            Pose { position, heading: heading + frame.heading }
        };
        let axis = turns[self.between[0]].after(&self.turn).axis();
        (Separation { ends: [0, 1].map(end) }, axis)
    }
}

/// A joint between an object and the world.
#[derive(Clone, Copy, Debug)]
pub struct Mounted {
    /// Index of the object.
    pub object: usize,
    /// Kind of the joint.
    pub kind: JointKind,
    /// The joint's frame in the world, and relative to the object, see
    /// [`crate::scene::WorldJoint::frames`].
    pub frames: [Pose; 2],
    /// Range of rotations (radians) or displacements (metres) relative to the start, if limited.
    pub limits: Option<Span>,
}

impl Mounted {
    /// Returns the relative pose of the joint's sides with the object at `pose`.
    pub fn separation(&self, pose: &Pose) -> Separation {
        Separation { ends: [self.frames[0], *pose * self.frames[1]] }
    }
}

/// Rigid groups: objects held together by fixed joints.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// Group of every object.
    pub of: Vec<GroupIndex>,
    /// Objects of every group, in order.
    pub members: Vec<Vec<usize>>,
    /// Pose of every object in the frame of its group's first object.
    pub places: Vec<Pose>,
}

impl Groups {
    fn new(scene: &Scene, physics: &Physics) -> Self {
        let RigidGroups { of, members } = physics.rigid_groups();
        let place = |(object, group): (usize, &usize)| {
            let [base, own] = [members[*group][0], object].map(|index| scene.objects[index].pose);
            base.inverse() * own
        };
        let places = of.iter().enumerate().map(place).collect();
        Self { of: of.into_iter().map(GroupIndex).collect(), members, places }
    }
}

/// Bodies of a scene with a tool.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Objects, in the order of the scene.
    pub objects: Vec<Movable>,
    /// Pieces of the tool's outline.
    pub parts: Vec<PrescribedBody>,
    /// Exposed boundary of every outline piece.
    pub rims: Arc<[Option<Rim>]>,
    /// Obstacles.
    pub obstacles: Vec<PrescribedBody>,
    /// Joints between objects.
    pub joints: Vec<Jointed>,
    /// Joints between objects and the world.
    pub mounts: Vec<Mounted>,
    /// Support of every object of the scene.
    pub feet: Arc<[Arc<Feet>]>,
    /// Whether the supports are known.
    pub supports_known: bool,
    /// Whether the height of the tool's push is known.
    pub push_height_known: bool,
    /// Rigid groups of objects, single objects included.
    pub groups: Groups,
    /// Mechanism of every object: the lowest object connected with it by joints of any kind.
    pub mechanisms: Vec<usize>,
    /// Numbering of all pairs of the scene and the tool, listed or not.
    pub pairs: Pairs,
    /// Friction of pairs for which it is not the mean of the two values, in the scene's numbering.
    pub frictions: Arc<[PairFriction]>,
}

/// Returns the area moments of every obstacle after propagation over obstacles that touch it, which
/// are fixed to each other like to the world.
fn joined_obstacles(scene: &Scene) -> Vec<AreaMoments> {
    let placed: Vec<(Footprint, Pose)> =
        scene.obstacles.iter().map(|one| (one.shape().footprint(), one.pose)).collect();
    let own: Vec<AreaMoments> =
        placed.iter().map(|(footprint, pose)| AreaMoments::of(footprint, pose)).collect();
    let level = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|k| &scene.obstacles[k]);
        a.z < b.top() && b.z < a.top()
    };
    let touch = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|k| (&placed[k].0, &placed[k].1));
        clearance(a, b, 2.0 * JOIN_GAP) <= JOIN_GAP
    };
    let pairs = (0..placed.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let joints: Vec<[usize; 2]> = pairs.filter(|&[a, b]| level(a, b) && touch(a, b)).collect();
    propagate(&own, &joints)
}

/// The other body of a contact, by its index in the bodies at hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// An object.
    Object(usize),
    /// An obstacle.
    Obstacle(usize),
    /// A part of the tool.
    Part(usize),
}

impl Bodies {
    /// Returns `true` if the contact `point` with outline piece `part`, placed there, lies on the
    /// tool's boundary and not on a seam between pieces.
    pub fn shows(&self, part: usize, placed: &Placed, point: &ContactPoint) -> bool {
        self.rims[self.parts[part].index].as_ref().is_none_or(|rim| {
            rim.shows(placed.local_point(point.on_second), placed.local_vector(point.normal))
        })
    }

    /// Returns the coefficient of friction of an object and another body.
    pub fn friction(&self, object: usize, with: Partner) -> f64 {
        let body = &self.objects[object];
        let (surface, value) = match with {
            Partner::Part(index) => (Surface::Tool, self.parts[index].friction),
            Partner::Obstacle(index) => {
                let obstacle = &self.obstacles[index];
                (Surface::Obstacle(obstacle.index), obstacle.friction)
            }
            Partner::Object(other) => {
                let other = &self.objects[other];
                (Surface::Object(other.index.0), other.friction)
            }
        };
        pair_friction(&self.frictions, body.index.0, surface, [body.friction, value])
    }

    /// Returns the support of an object.
    pub fn feet(&self, object: usize) -> &Feet {
        &self.feet[self.objects[object].index.0]
    }

    /// Collects the bodies of `scene` and a `tool` whose underside is `lift` metres above the
    /// table, under `physics`.
    pub fn new(scene: &Scene, tool: &Tool, lift: f64, physics: &Physics) -> Self {
        let objects = scene
            .objects
            .iter()
            .enumerate()
            .map(|(k, object)| {
                let footprint = object.shape.footprint();
                let support = physics.feet[k].mean_radius;
                let friction = physics.support_friction(k);
                let spin = (support / footprint.gyration_radius()).powi(2);
                Movable {
                    index: SceneIndex(k),
                    footprint,
                    radius: footprint.bounding_radius(),
                    support,
                    spin,
                    fall: Fall::new(spin),
                    deceleration: friction * GRAVITY,
                    mass: physics.masses[k],
                    friction: physics.frictions[k],
                    height: object.shape.height(),
                    span: object.span().into(),
                    carried: physics.feet[k].share,
                    lean: physics.lean(scene, k, (tool, lift)),
                    face_height: face_height(scene, k, (tool, lift))[1],
                }
            })
            .collect();
        let own = tool.parts().iter().map(|part| AreaMoments::of(&part.footprint(), &part.pose));
        // All parts of a tool are one body and hold the same state.
        let body = propagate(&own.collect::<Vec<_>>(), tool.joints());
        let body = body.first().copied().unwrap_or_default();
        let parts = tool
            .outline()
            .iter()
            .enumerate()
            .map(|(index, piece)| PrescribedBody {
                index,
                footprint: piece.footprint(),
                pose: piece.pose,
                turn: piece.pose.turn(),
                friction: tool.friction,
                span: (lift, lift + piece.shape.height()),
                body,
            })
            .collect();
        let rims = tool.outline().iter().map(|piece| piece.rim.clone()).collect();
        let rigid = joined_obstacles(scene);
        let obstacles = scene
            .obstacles
            .iter()
            .enumerate()
            .map(|(index, obstacle)| PrescribedBody {
                body: rigid[index],
                index,
                footprint: obstacle.shape().footprint(),
                pose: obstacle.pose,
                turn: obstacle.pose.turn(),
                friction: obstacle.friction,
                span: (obstacle.z, obstacle.top()),
            })
            .collect();
        let joints = physics
            .joints
            .iter()
            .map(|joint| {
                let frames = joint.frames(&scene.objects);
                Jointed {
                    between: joint.between,
                    kind: joint.kind,
                    frames,
                    turn: frames[0].turn(),
                    limits: joint.limits(),
                    guessed: joint.guessed,
                }
            })
            .collect();
        let mounts = scene
            .mounts
            .iter()
            .map(|mount| Mounted {
                object: mount.object,
                kind: mount.kind,
                frames: mount.frames(&scene.objects),
                limits: mount.limits(),
            })
            .collect();
        let groups = Groups::new(scene, physics);
        let mechanisms = physics.groups(|_| true);
        let pairs = Pairs::new(scene.objects.len(), scene.obstacles.len(), tool.outline().len());
        let feet = physics.feet.iter().cloned().collect();
        let push_height_known = physics.push_height.is_some();
        let frictions = physics.pairs.iter().copied().collect();
        Self {
            objects,
            parts,
            rims,
            obstacles,
            joints,
            mounts,
            feet,
            supports_known: physics.supports_known,
            push_height_known,
            groups,
            mechanisms,
            pairs,
            frictions,
        }
    }

    /// Returns the persistent id of an object and another body.
    pub fn pair(&self, object: usize, with: Partner) -> PairId {
        let with = match with {
            Partner::Object(other) => Body::Object(self.objects[other].index.0),
            Partner::Obstacle(index) => Body::Obstacle(self.obstacles[index].index),
            Partner::Part(index) => Body::Part(self.parts[index].index),
        };
        self.pairs.id(self.objects[object].index, with)
    }
}
