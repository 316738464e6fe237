//! Execution of tool actions in both engines; repeated choices are executed once.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use pushplan::{
    geometry::Vector,
    outcome::{Record, Trajectory},
    scene::Engine,
    sim::Simulator,
    task::{Job, Push, PushForm, Task, ToolMotion},
};

use super::setup::{LIFT, ReferenceSetup};

/// Tool action: a tool pose and its pushes; without pushes the tool stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Index of the tool pose.
    pub pose: usize,
    /// Start rule of the pushes.
    pub form: PushForm,
    /// Pushes in order.
    pub pushes: Vec<Push>,
}

/// Final position of the cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Position, metres.
    pub at: Vector,
    /// Whether the cylinder is at rest at this position, without failures.
    pub sound: bool,
}

/// Results of executed actions on one scene.
#[derive(Debug, Default)]
pub struct Executions {
    known: HashMap<Vec<u64>, Landing>,
}

impl Action {
    /// Returns the travel of the tool, metres.
    pub fn travel(&self) -> f64 {
        self.pushes.iter().fold(0.0, |sum, push| sum + push.length)
    }

    /// Returns the motion of the tool.
    pub fn motion(&self, setup: &ReferenceSetup) -> ToolMotion {
        let tool = Arc::clone(&setup.poses[self.pose]);
        ToolMotion::pushes(tool, LIFT, 0.0, &self.pushes, self.form == PushForm::Placed)
    }

    fn key(&self, engine: Engine) -> Vec<u64> {
        let numbers = |push: &Push| {
            [push.start.x, push.start.y, push.direction, push.length, push.speed].map(f64::to_bits)
        };
        let head = [engine as u64, self.pose as u64, self.form as u64];
        head.into_iter().chain(self.pushes.iter().flat_map(numbers)).collect()
    }
}

impl Executions {
    /// Returns the results of `actions` in `engine`, in their order; new actions are executed in
    /// parallel. The scene of `task` must be the same in every call.
    pub fn run(
        &mut self,
        setup: &ReferenceSetup,
        task: &Task,
        engine: Engine,
        actions: &[&Action],
    ) -> Vec<Landing> {
        let mut new: Vec<(Vec<u64>, &Action)> = Vec::new();
        for action in actions {
            let key = action.key(engine);
            if !self.known.contains_key(&key) && !new.iter().any(|(other, _)| *other == key) {
                new.push((key, action));
            }
        }
        let played: Vec<Landing> =
            new.par_iter().map(|(_, action)| play(setup, task, engine, action)).collect();
        self.known.extend(new.into_iter().map(|(key, _)| key).zip(played));
        actions.iter().map(|action| self.known[&action.key(engine)]).collect()
    }
}

/// Executes an action in `engine`.
pub(super) fn play(
    setup: &ReferenceSetup,
    task: &Task,
    engine: Engine,
    action: &Action,
) -> Landing {
    let scene = &task.scene;
    if action.pushes.is_empty() {
        return Landing { at: scene.objects[task.goals[0].object].pose.position, sound: true };
    }
    let simulator = match engine {
        Engine::Planar => Simulator::planar(),
        Engine::Spatial => Simulator::spatial(),
        Engine::Upright => Simulator::upright(),
    };
    let job = Job::stated(scene, action.motion(setup));
    landing(&simulator.run(scene, &job, Record::Outcome))
}

/// Returns the final position of the cylinder in a trajectory.
fn landing(trajectory: &Trajectory) -> Landing {
    let state = trajectory.outcome();
    let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
    Landing { at: state.poses[0].position, sound: sound && state.is_finite() }
}
