//! The base scene, from which one factor at a time departs, and the pushes drawn for it.

use std::sync::Arc;

use rand_pcg::Pcg64;

use pushplan::{
    asset::ToolLibrary,
    geometry::Vector,
    scene::{Object, Physics, Scene, Tool},
    seeded::generator,
    task::ToolMotion,
};
use pushplan_lab::bench::Case;
use pushplan_learn::dataset::{Aim, aimed_stroke, random_direction, random_heading};

/// Number of tries to aim a push before a scene is given up: nearly all succeed within ten.
const TRIES: usize = 1000;

/// Height of the tools' underside above the table, metres.
pub const LIFT: f64 = 0.002;

/// Source of pushes.
pub struct Draw<'a> {
    /// Shipped tools, which alternate.
    pub library: &'a ToolLibrary,
    /// Number of pushes per cell.
    pub pushes: usize,
    /// Seed of scenes and pushes, which are equal in every cell as far as its extreme allows.
    pub seed: u64,
}

/// Geometry and speed of a push.
#[derive(Clone)]
pub struct Way {
    /// Travel, metres.
    pub travel: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Gap at the start, metres.
    pub gap: f64,
    /// Tool, if it is not a shipped one.
    pub tool: Option<Arc<Tool>>,
}

impl Default for Way {
    fn default() -> Self {
        Self { travel: 0.20, speed: 0.10, gap: 0.005, tool: None }
    }
}

impl Draw<'_> {
    /// Draws a push for each scene of `scene`. The random generator is equal in every cell.
    pub fn pushes(&self, way: &Way, scene: impl Fn(&mut Pcg64) -> Scene) -> Vec<Case> {
        let tools: Vec<_> = self.library.iter().collect();
        let case = |index: usize| {
            let mut rng = generator(self.seed ^ 0xE57E, index as u64);
            // Models receive the push height of the 2-D engine, their reference.
            let scene = Scene { push_height: Some(Physics::PUSH_HEIGHT), ..scene(&mut rng) };
            let state = scene.start();
            let tool = match &way.tool {
                Some(tool) => Arc::clone(tool),
                None => Arc::clone(tools.get(index % tools.len().max(1))?),
            };
            let stroke = (0..TRIES).find_map(|_| {
                let direction = random_direction(&mut rng, &scene.objects, &state);
                let heading = random_heading(&mut rng, direction);
                let Way { travel, speed, gap, .. } = *way;
                let aim = Aim { direction, heading, gap, travel, speed };
                aimed_stroke(&mut rng, &tool, &scene, &state, &aim)
            })?;
            Some(Case { scene, motion: ToolMotion { tool, lift: LIFT, strokes: vec![stroke] } })
        };
        (0..self.pushes).filter_map(case).collect()
    }

    /// Returns the source with another number of pushes.
    pub fn with(&self, pushes: usize) -> Self {
        Self { pushes: pushes.min(self.pushes), ..*self }
    }
}

/// The two solids of single pushes.
#[derive(Clone, Copy)]
pub enum Solid {
    Cylinder,
    Cuboid,
}

impl Solid {
    pub const BOTH: [Self; 2] = [Self::Cylinder, Self::Cuboid];

    /// Returns the base object: 10 cm across, 400 g, of wood.
    pub fn object(self) -> Object {
        self.sized(0.10)
    }

    /// Returns the base object with a longest horizontal extent of `size` metres.
    pub fn sized(self, size: f64) -> Object {
        match self {
            Self::Cylinder => Object::cylinder("object", 0.5 * size, 0.1),
            Self::Cuboid => Object::cuboid("object", [size, 0.7 * size, 0.1]),
        }
    }
}

/// Returns a scene and its motion, shifted by `shift` metres.
pub fn shifted(mut case: Case, shift: Vector) -> Case {
    use pushplan::scene::JointKind;
    let objects = case.scene.objects.iter_mut().map(|object| &mut object.pose);
    let obstacles = case.scene.obstacles.iter_mut().map(|obstacle| &mut obstacle.pose);
    let strokes = case.motion.strokes.iter_mut().flat_map(|s| [&mut s.from, &mut s.to]);
    for pose in objects.chain(obstacles).chain(strokes) {
        pose.position += shift;
    }
    for joint in &mut case.scene.joints {
        if let JointKind::Revolute { at, .. } = &mut joint.kind {
            *at += shift;
        }
    }
    case
}

/// Returns a scene and its motion with `turn` radians, a multiple of a full rotation, added to
/// every heading.
pub fn wound(mut case: Case, turn: f64) -> Case {
    for object in &mut case.scene.objects {
        object.pose.heading += turn;
    }
    for stroke in &mut case.motion.strokes {
        stroke.from.heading += turn;
        stroke.to.heading += turn;
    }
    case
}
