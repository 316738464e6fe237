//! What a frame's equations need to know about every body, computed once per rollout.

use std::sync::Arc;

use crate::{
    geometry::{ContactPoint, Footprint, Placed, Pose, Rim, Turn, Vector},
    scene::{
        Body, Feet, GRAVITY, JointKind, PairFriction, Physics, RigidGroups, Scene, Separation,
        Span, Surface, Tool, face_height, pair_friction,
    },
};

use super::{
    fall::Fall,
    index::{GroupIndex, SceneIndex},
    pairs::{PairId, Pairs},
};

/// A movable body.
#[derive(Clone, Copy, Debug)]
pub struct Movable {
    /// Which object of the scene.
    pub index: SceneIndex,
    /// What it covers on the table.
    pub footprint: Footprint,
    /// Radius of a circle about the centre that holds it, metres.
    pub radius: f64,
    /// Mean distance c of the support's points from the centre, metres.
    pub support: f64,
    /// (c / rho)^2, the ratio of the spin's friction deceleration (in c omega) to the slide's.
    pub spin: f64,
    /// How its speeds fall while it slides and spins.
    pub(super) fall: Fall,
    /// Friction deceleration mu g, m/s^2.
    pub deceleration: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value.
    pub friction: f64,
    /// Vertical extent, metres.
    pub height: f64,
    /// Heights above the table between which it is, metres.
    pub span: (f64, f64),
    /// What the table carries of it, and of parts above the table, as a share of its own weight.
    pub carried: f64,
    /// How far the load moves when it is pressed as hard as friction resists, metres.
    pub lean: f64,
    /// Mean height of where the tool can press on it, metres; zero where it passes over.
    pub face_height: f64,
}

impl Movable {
    /// Largest friction of the table, N.
    pub fn load(&self) -> f64 {
        self.mass * self.deceleration * self.carried
    }

    /// Whether what is between these two heights is as high as some of it.
    pub fn meets(&self, (low, high): (f64, f64)) -> bool {
        low < self.span.1 && self.span.0 < high
    }
}

/// A body whose motion is given: a tool part or an obstacle.
#[derive(Clone, Copy, Debug)]
pub struct Given {
    /// Which part of the tool, or which obstacle of the scene.
    pub index: usize,
    /// What it covers on the table.
    pub footprint: Footprint,
    /// Tool parts: pose in the tool frame. Obstacles: pose in the world.
    pub pose: Pose,
    /// The turn by that pose's heading.
    pub turn: Turn,
    /// Friction value.
    pub friction: f64,
    /// Heights above the table between which it is, metres.
    pub span: (f64, f64),
}

/// A joint between two objects.
#[derive(Clone, Copy, Debug)]
pub struct Jointed {
    /// Indices of the two objects.
    pub between: [usize; 2],
    /// What it allows.
    pub kind: JointKind,
    /// The joint's frame as seen from each of the two, see [`crate::scene::Joint::frames`].
    pub frames: [Pose; 2],
    /// The turn by the heading of the first of these.
    pub turn: Turn,
    /// Range of turns (radians) or shifts (metres) against the start, where limited.
    pub limits: Option<Span>,
    /// Whether anchor or axis is only a guess.
    pub guessed: bool,
}

impl Jointed {
    /// How its two sides stand when the objects are at `poses`.
    pub fn separation(&self, poses: &[Pose]) -> Separation {
        Separation::of(&self.frames, self.between.map(|object| poses[object]))
    }

    /// The same where the turns by the objects' headings are known, and where the first side's axis x
    /// then points.
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
    /// What it allows.
    pub kind: JointKind,
    /// The joint's frame in the world, and as seen from the object, see [`crate::scene::Mount::frames`].
    pub frames: [Pose; 2],
    /// Range of turns (radians) or shifts (metres) against the start, where limited.
    pub limits: Option<Span>,
}

impl Mounted {
    /// How its two sides stand when the object is at `pose`.
    pub fn separation(&self, pose: &Pose) -> Separation {
        Separation { ends: [self.frames[0], *pose * self.frames[1]] }
    }
}

/// Which objects move as one, because fixed joints hold them together.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// The group of every object.
    pub of: Vec<GroupIndex>,
    /// The objects of every group, in order.
    pub members: Vec<Vec<usize>>,
    /// Every object's pose in the frame of the first object of its group.
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

/// All bodies of a scene with a tool in it.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Objects, in the order of the scene.
    pub objects: Vec<Movable>,
    /// The pieces of the tool's outline.
    pub parts: Vec<Given>,
    /// What all pieces of the outline cover, with their poses in the tool frame, whether here or not.
    pub outline: Arc<[(Footprint, Pose)]>,
    /// Where every piece of the outline can be touched.
    pub rims: Arc<[Option<Rim>]>,
    /// Obstacles.
    pub obstacles: Vec<Given>,
    /// Joints between objects.
    pub joints: Vec<Jointed>,
    /// Joints between objects and the world.
    pub mounts: Vec<Mounted>,
    /// What every object of the scene stands on.
    pub feet: Arc<[Arc<Feet>]>,
    /// Whether that is known.
    pub supports_known: bool,
    /// Whether it is known how high the tool presses.
    pub push_height_known: bool,
    /// Objects that fixed joints make one rigid body, single ones included.
    pub groups: Groups,
    /// For every object the lowest one that joints of any kind connect it with.
    pub mechanisms: Vec<usize>,
    /// All pairs of the scene and the tool, whether here or not.
    pub pairs: Pairs,
    /// Those whose friction is not the mean of the two values, by the scene's numbers.
    pub frictions: Arc<[PairFriction]>,
}

/// The other body of a contact, by its number in the bodies at hand.
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
    /// Whether the tool can be touched where a body meets number `part` of its pieces, placed there:
    /// not at a seam between pieces.
    pub fn shows(&self, part: usize, placed: &Placed, point: &ContactPoint) -> bool {
        self.rims[self.parts[part].index].as_ref().is_none_or(|rim| {
            rim.shows(placed.local_point(point.on_second), placed.local_vector(point.normal))
        })
    }

    /// Coefficient of friction of an object and another body.
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

    /// What the object with that number here stands on.
    pub fn feet(&self, object: usize) -> &Feet {
        &self.feet[self.objects[object].index.0]
    }

    /// The bodies of `scene` and a `tool` whose underside is `lift` metres above the table,
    /// under `physics`.
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
        let parts = tool
            .outline()
            .iter()
            .enumerate()
            .map(|(index, piece)| Given {
                index,
                footprint: piece.footprint(),
                pose: piece.pose,
                turn: piece.pose.turn(),
                friction: tool.friction,
                span: (lift, lift + piece.shape.height()),
            })
            .collect();
        let outline = tool.outline().iter().map(|piece| (piece.footprint(), piece.pose)).collect();
        let rims = tool.outline().iter().map(|piece| piece.rim.clone()).collect();
        let obstacles = scene
            .obstacles
            .iter()
            .enumerate()
            .map(|(index, obstacle)| Given {
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
            outline,
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

    /// The lasting id of an object and another body.
    pub fn pair(&self, object: usize, with: Partner) -> PairId {
        let with = match with {
            Partner::Object(other) => Body::Object(self.objects[other].index.0),
            Partner::Obstacle(index) => Body::Obstacle(self.obstacles[index].index),
            Partner::Part(index) => Body::Part(self.parts[index].index),
        };
        self.pairs.id(self.objects[object].index, with)
    }
}
