//! What the tool does, as executed in both engines; a choice that occurs twice is played once.

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

/// What the tool does: a tool pose and its pushes; without one it stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Index of the tool pose.
    pub pose: usize,
    /// How the pushes start.
    pub form: PushForm,
    /// In order.
    pub pushes: Vec<Push>,
}

/// Where the cylinder comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Metres.
    pub at: Vector,
    /// Whether it is at rest where it is said to be.
    pub sound: bool,
}

/// What actions did on one scene, remembered.
#[derive(Debug, Default)]
pub struct Executions {
    known: HashMap<Vec<u64>, Landing>,
}

impl Action {
    /// Travel of the tool, metres.
    pub fn travel(&self) -> f64 {
        self.pushes.iter().fold(0.0, |sum, push| sum + push.length)
    }

    /// The tool's motion.
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
    /// What each of `actions` does in `engine`, in their order; those not known yet are played
    /// in parallel. The scene of `task` must be the same in every call.
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

fn play(setup: &ReferenceSetup, task: &Task, engine: Engine, action: &Action) -> Landing {
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

/// Where a trajectory leaves the cylinder.
fn landing(trajectory: &Trajectory) -> Landing {
    let state = trajectory.outcome();
    let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
    Landing { at: state.poses[0].position, sound: sound && state.is_finite() }
}
