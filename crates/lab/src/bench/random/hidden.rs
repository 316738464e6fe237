//! Random tasks with unknown scenes.

use pushplan::internals::seeded::generator;
use pushplan::internals::{
    scene::{Engine, Scene, Support, Unknowns},
    task::{Task, Truth},
};
use pushplan_act::belief::normal;
use rand::Rng;
use serde::{Deserialize, Serialize};

use super::kind::TaskKind;
use super::layout::round;
use super::suite::{NoTask, RandomSuite};

/// A task whose joints, masses, frictions and supports are unknown, with their true values.
#[derive(Clone, Debug)]
pub struct HiddenTask {
    /// Kind of the task.
    pub kind: TaskKind,
    /// Task with initial guesses.
    pub task: Task,
    /// Task with full knowledge.
    pub known: Task,
    /// World of the task, in the 2-D engine by default.
    pub truth: Truth,
}

/// Engine of the world and tolerance of the goals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HiddenWorld {
    /// Engine that simulates the world.
    pub engine: Engine,
    /// Tolerance of the goals as a share of the usual one.
    pub tolerance: f64,
}

impl HiddenTask {
    /// Returns the task in another world.
    pub fn in_world(mut self, world: HiddenWorld) -> Self {
        self.truth.engine = world.engine;
        for task in [&mut self.task, &mut self.known] {
            let tolerance = world.tolerance * task.goals[0].tolerance();
            task.goals[0].set_tolerance(tolerance);
        }
        self
    }
}

impl RandomSuite {
    /// Returns task `index` with everything hidden except shapes and poses. Its masses and friction
    /// values are the true ones times a random factor with the spread of [`Unknowns`]. Supports are
    /// drawn anew, so that the plan behind the goal may miss it slightly.
    ///
    /// # Errors
    /// Returns an error if no task could be made with these tools.
    pub fn hidden(&self, index: usize) -> Result<HiddenTask, NoTask> {
        let made = self.task(index)?;
        let mut rng = generator(self.seed() ^ 0x41_DDE2, index as u64);
        let mut known = made.task;
        for object in &mut known.scene.objects {
            let spread = Unknowns::SPREADS;
            let share = rng.random_range(spread.low..spread.high);
            object.support = Support::Spread(round(share, 1e3));
        }
        // Nine in ten lie within the factor.
        let mut off = |most: f64| (most.ln() / 1.645 * normal(&mut rng)).exp();
        let friction = |value: f64, off: f64| round((value * off).clamp(0.05, 2.0), 1e3);
        let mut scene = Scene { joints: Vec::new(), ..known.scene.clone() };
        scene.table_friction = friction(scene.table_friction, off(Unknowns::FRICTION_FACTOR));
        for object in &mut scene.objects {
            object.mass = round(object.mass * off(Unknowns::MASS_FACTOR), 1e3).max(1e-3);
            object.friction = friction(object.friction, off(Unknowns::FRICTION_FACTOR));
            object.support = Support::Even;
        }
        let task = Task { scene, ..known.clone() }.with_unknowns(Unknowns::ALL);
        let truth = Truth::stated(&known.scene, self.seed() ^ index as u64);
        Ok(HiddenTask { kind: made.kind, task, known, truth })
    }
}
