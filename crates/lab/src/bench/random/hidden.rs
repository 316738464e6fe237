//! Random tasks that do not know their scene.

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

/// A task whose joints, masses, frictions and supports are unknown, and what they are.
#[derive(Clone, Debug)]
pub struct HiddenTask {
    /// What kind.
    pub kind: TaskKind,
    /// The task with guesses.
    pub task: Task,
    /// The same task with everything known.
    pub known: Task,
    /// The world, in the planar engine unless said otherwise.
    pub truth: Truth,
}

/// What is asked for, and of what kind of world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HiddenWorld {
    /// What moves it.
    pub engine: Engine,
    /// Tolerance of the goals as a share of the usual one.
    pub tolerance: f64,
}

impl HiddenTask {
    /// The same in another world.
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
    /// Task `index` with everything but shapes and places hidden. Its masses and friction values
    /// are the true ones, times a factor as likely as [`Unknowns`] says; supports are drawn anew, so
    /// that the plan that made the goal may miss it by a little.
    ///
    /// # Errors
    /// If no task could be made with these tools.
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
        let task = Task { scene, ..known.clone() }.guessing(Unknowns::ALL);
        let truth = Truth::stated(&known.scene, self.seed() ^ index as u64);
        Ok(HiddenTask { kind: made.kind, task, known, truth })
    }
}
