//! What the graph needs to know of every body, computed once per rollout.

use crate::{
    geometry::{Footprint, Pose, Vector},
    scene::{GRAVITY, Hypothesis, Scene, Tool},
};

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

/// All bodies of a scene with a tool in it.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// Objects, in the order of the scene.
    pub objects: Vec<Movable>,
    /// Parts of the tool.
    pub parts: Vec<Given>,
    /// Obstacles.
    pub obstacles: Vec<Given>,
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
    /// with the physical parameters of `hypothesis` where one is given.
    pub fn new(scene: &Scene, tool: &Tool, lift: f64, hypothesis: Option<&Hypothesis>) -> Self {
        let nominal;
        let physics = match hypothesis {
            Some(hypothesis) => hypothesis,
            None => {
                nominal = Hypothesis::nominal(scene, tool);
                &nominal
            }
        };
        let objects = scene
            .objects
            .iter()
            .enumerate()
            .map(|(k, object)| {
                let footprint = object.shape.footprint();
                let support = footprint.mean_radius();
                let friction = Scene::pair_friction(physics.frictions[k], physics.table_friction);
                Movable {
                    footprint,
                    radius: footprint.bounding_radius(),
                    support,
                    spin: (support / footprint.gyration_radius()).powi(2),
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
                friction: physics.tool_friction,
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
        Self { objects, parts, obstacles }
    }
}
