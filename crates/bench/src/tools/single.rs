//! The single-push benchmark: one push of 20 cm, with random start and goal.
//!
//! The cylinder stands anywhere in 3 m^2 in front of the robot (1.5 m deep, 2 m wide). The goal
//! lies anywhere in 16 m^2 around it (a square of 4 m), and a task is solved within 10 cm. Most of
//! these tasks have no solution, so the number of solvable tasks is reported with the successes.

use rand::Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use pushplan::{
    effect::{EffectModel, Simulated},
    geometry::Vector,
    scene::Engine,
    seeded::generator,
    sim::Simulator,
    task::Task,
};

use super::{
    choose::rested,
    execute::{Action, Executions},
    sequences::Rolling,
    setup::{COARSE, Layout, ReferenceSetup, TRAVEL},
};

/// Depth and width of the area of starts, and side of the goal's square, metres.
const DEPTH: f64 = 1.5;
const WIDTH: f64 = 2.0;
const SQUARE: f64 = 4.0;

/// Bound on the cylinder's displacement beyond the travel of a push, metres; the measured value at
/// this speed is two millimetres.
const GLIDE: f64 = 0.05;

/// Salt that separates these tasks from other uses of a seed.
const SALT: u64 = 0x0051;

/// Result of the single-push benchmark for all tasks of a seed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SinglePushes {
    /// Name of the effect model.
    pub model: String,
    /// Seed of the tasks.
    pub seed: u64,
    /// Number of tasks.
    pub tasks: usize,
    /// Number of tasks whose goal is within reach of a push.
    pub near: usize,
    /// Number of tasks that are solved without pushing.
    pub nothing: usize,
    /// Number of tasks that some push, or none, solves in the 2-D engine.
    pub solvable: usize,
    /// Number of tasks that the model predicts to solve.
    pub predicted: usize,
    /// Number of tasks that the model's choice solves in the 2-D engine.
    pub planar: usize,
    /// Number of tasks that the model's choice solves in the 3-D engine.
    pub spatial: usize,
    /// Number of solvable tasks that the model's choice does not solve in the 2-D engine.
    pub missed: usize,
}

/// Result of one task, in the order of [`SinglePushes`].
struct One {
    nothing: bool,
    solvable: bool,
    predicted: bool,
    planar: bool,
    spatial: bool,
}

/// Measures `tasks` random tasks of `seed` with `model`, in parallel on the current rayon pool.
pub fn single_pushes(model: &dyn EffectModel, seed: u64, tasks: usize) -> SinglePushes {
    let setup = ReferenceSetup::new(Layout::Grid);
    let done: Vec<Option<One>> =
        (0..tasks).into_par_iter().map(|index| one(&setup, model, seed, index)).collect();
    let near: Vec<&One> = done.iter().flatten().collect();
    let count = |solved: &dyn Fn(&One) -> bool| near.iter().filter(|one| solved(one)).count();
    SinglePushes {
        model: model.spec().to_string(),
        seed,
        tasks,
        near: near.len(),
        nothing: count(&|one| one.nothing),
        solvable: count(&|one| one.solvable),
        predicted: count(&|one| one.predicted),
        planar: count(&|one| one.planar),
        spatial: count(&|one| one.spatial),
        missed: count(&|one| one.solvable && !one.planar),
    }
}

/// Measures one task; returns `None` if the goal is out of reach of any push.
fn one(setup: &ReferenceSetup, model: &dyn EffectModel, seed: u64, index: usize) -> Option<One> {
    let mut random = generator(seed ^ SALT, index as u64);
    let mut within = |low: f64, size: f64| low + size * random.random::<f64>();
    let start = Vector::new(within(0.0, DEPTH), within(-WIDTH / 2.0, WIDTH));
    let goal = start + Vector::new(within(-SQUARE / 2.0, SQUARE), within(-SQUARE / 2.0, SQUARE));
    if (goal - start).norm() > TRAVEL + GLIDE + COARSE {
        return None;
    }
    let mut task = setup.task(start, goal);
    task.pushes.max_count = 1;
    task.goals[0].set_tolerance(COARSE);
    let nothing = (goal - start).norm() <= COARSE;
    let choice = choose(setup, model, &task);
    let mut executions = Executions::default();
    let mut solved = |engine| match &choice {
        Some((action, _)) => {
            let landing = executions.run(setup, &task, engine, &[action])[0];
            landing.sound && (landing.at - goal).norm() <= COARSE
        }
        None => nothing,
    };
    let (planar, spatial) = (solved(Engine::Planar), solved(Engine::Spatial));
    let truth = Simulated::new(Simulator::planar());
    let best = choose(setup, &truth, &task).map(|(_, error)| error);
    Some(One {
        nothing,
        solvable: nothing || best.is_some_and(|error| error <= COARSE),
        predicted: choice.as_ref().map_or(nothing, |(_, error)| *error <= COARSE),
        planar,
        spatial,
    })
}

/// Returns the whole push that `model` predicts to end nearest to the goal, and its error; `None`
/// if not pushing is nearest.
fn choose(setup: &ReferenceSetup, model: &dyn EffectModel, task: &Task) -> Option<(Action, f64)> {
    let goal = &task.goals[0];
    let start = task.scene.objects[goal.object].pose.position;
    let poses = setup.free_poses(start);
    let sequences = Rolling { setup, task, model, poses: &poses, steps: 1 }.shared();
    let (_, nearest) = sequences.best(goal, 1, &poses).pop()?;
    let best = rested(setup, model, task, vec![nearest]).pop()?;
    let error = best.predicted.filter(|error| *error < goal.error(&task.scene.start()))?;
    Some((best.action, error))
}
