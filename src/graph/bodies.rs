//! What the graph needs to know of every body, computed once per rollout.

use crate::{
    geometry::{Footprint, Pose, Vector},
    scene::{GRAVITY, JointKind, Physics, Scene, Span, Tool},
};

use super::coast::Fall;

/// A movable body as the graph sees it.
#[derive(Clone, Copy, Debug)]
pub struct Movable {
    /// What it covers on the table.
    pub footprint: Footprint,
    /// Radius of a circle about the centre that holds it, metres.
    pub radius: f64,
    /// Length c of the support's limit surface, metres.
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
}

/// A body whose motion is given: a tool part or an obstacle.
#[derive(Clone, Copy, Debug)]
pub struct Given {
    /// What it covers on the table.
    pub footprint: Footprint,
    /// Tool parts: pose in the tool frame. Obstacles: pose in the world.
    pub pose: Pose,
    /// Friction value.
    pub friction: f64,
    /// Heights above the table between which it stands, metres.
    pub span: (f64, f64),
}

/// A joint as the graph sees it.
#[derive(Clone, Copy, Debug)]
pub struct Jointed {
    /// Indices of the two objects.
    pub between: [usize; 2],
    /// What it allows.
    pub kind: JointKind,
    /// The joint's frame as seen from each of the two, see [`crate::scene::Joint::frames`].
    pub frames: [Pose; 2],
    /// Range of turns (radians) or shifts (metres) against the start, where limited.
    pub limits: Option<Span>,
    /// Whether anchor or axis is only a guess.
    pub guessed: bool,
}

/// Which objects move as one, because fixed joints hold them together.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// The group of every object.
    pub of: Vec<usize>,
    /// The objects of every group, in order.
    pub members: Vec<Vec<usize>>,
    /// Every object's pose in the frame of the first object of its group.
    pub places: Vec<Pose>,
}

impl Groups {
    fn new(scene: &Scene, physics: &Physics) -> Self {
        let mut groups = Self::default();
        let lowest = physics.groups(|joint| joint.kind == JointKind::Fixed);
        for (object, first) in lowest.into_iter().enumerate() {
            if first == object {
                groups.of.push(groups.members.len());
                groups.members.push(vec![object]);
            } else {
                let group = groups.of[first];
                groups.of.push(group);
                groups.members[group].push(object);
            }
            let [base, own] = [first, object].map(|index| scene.objects[index].pose);
            groups.places.push(base.inverse() * own);
        }
        groups
    }
}

/// All bodies of a scene with a tool in it.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Objects, in the order of the scene.
    pub objects: Vec<Movable>,
    /// Parts of the tool.
    pub parts: Vec<Given>,
    /// Obstacles.
    pub obstacles: Vec<Given>,
    /// Joints between objects.
    pub joints: Vec<Jointed>,
    /// Objects that fixed joints make one rigid body, single ones included.
    pub groups: Groups,
    /// For every object the lowest one that joints of any kind connect it with.
    pub mechanisms: Vec<usize>,
}

/// A planar displacement and the velocity at its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacement of the centre, metres.
    pub shift: Vector,
    /// Turn, radians.
    pub turn: f64,
    /// Velocity of the centre at the end, m/s.
    pub velocity: Vector,
    /// Angular velocity at the end, rad/s.
    pub spin: f64,
}

impl Motion {
    /// Displacement of the body's point `arm` metres from its centre, to first order, metres.
    pub fn at(&self, arm: Vector) -> Vector {
        self.shift + self.turn * Vector::new(-arm.y, arm.x)
    }

    /// Velocity of the body's point `arm` metres from its centre at the end, m/s.
    pub fn velocity_at(&self, arm: Vector) -> Vector {
        self.velocity + self.spin * Vector::new(-arm.y, arm.x)
    }
}

impl Bodies {
    /// The bodies of `scene` and a `tool` whose underside is `lift` metres above the table,
    /// under `physics`.
    pub fn new(scene: &Scene, tool: &Tool, lift: f64, physics: &Physics) -> Self {
        let objects = scene
            .objects
            .iter()
            .enumerate()
            .map(|(k, object)| {
                let footprint = object.shape.footprint();
                let support = footprint.mean_radius();
                let friction = physics.support_friction(k);
                let spin = (support / footprint.gyration_radius()).powi(2);
                Movable {
                    footprint,
                    radius: footprint.bounding_radius(),
                    support,
                    spin,
                    fall: Fall::new(spin),
                    deceleration: friction * GRAVITY,
                    mass: physics.masses[k],
                    friction: physics.frictions[k],
                    height: object.shape.height(),
                }
            })
            .collect();
        let parts = tool
            .parts
            .iter()
            .map(|part| Given {
                footprint: part.footprint(),
                pose: part.pose,
                friction: tool.friction,
                span: (lift, lift + part.shape.height()),
            })
            .collect();
        let obstacles = scene
            .obstacles
            .iter()
            .map(|obstacle| Given {
                footprint: obstacle.shape().footprint(),
                pose: obstacle.pose,
                friction: obstacle.friction,
                span: (0.0, obstacle.size[2]),
            })
            .collect();
        let joints = physics
            .joints
            .iter()
            .map(|joint| Jointed {
                between: joint.between,
                kind: joint.kind,
                frames: joint.frames(&scene.objects),
                limits: joint.limits(),
                guessed: joint.guessed,
            })
            .collect();
        let groups = Groups::new(scene, physics);
        let mechanisms = physics.groups(|_| true);
        Self { objects, parts, obstacles, joints, groups, mechanisms }
    }
}
