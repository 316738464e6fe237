//! Plans as executed in both engines; one that is chosen twice is played once.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use crate::{
    geometry::Vector,
    scene::{Engine, Job, Push, PushForm, Record, Task, ToolMotion, Trajectory},
    sim::Simulator,
};

use super::setup::ReferenceSetup;

/// What the tool does: a tool pose and its pushes; none is standing still.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Tool and grip yaw.
    pub grip: (usize, f64),
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
    /// Whether it stands, at rest, where it is said to be.
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
    pub fn motion(&self, setup: &ReferenceSetup, lift: f64) -> ToolMotion {
        let tool = Arc::clone(&setup.tools[self.grip.0]);
        let placed = self.form == PushForm::Placed;
        ToolMotion::pushes(tool, lift, self.grip.1, &self.pushes, placed)
    }

    fn key(&self, engine: Engine) -> Vec<u64> {
        let numbers = |push: &Push| {
            [push.start.x, push.start.y, push.direction, push.length, push.speed].map(f64::to_bits)
        };
        let head = [engine as u64, self.grip.0 as u64, self.grip.1.to_bits(), self.form as u64];
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
        return Landing { at: scene.objects[task.goal.object].pose.position, sound: true };
    }
    let simulator = match engine {
        Engine::Planar => Simulator::planar(),
        Engine::Spatial => Simulator::spatial(),
    };
    let motion = action.motion(setup, task.pushes.lift);
    landing(&simulator.run(scene, &Job::stated(scene, motion.clone()), Record::Outcome))
}

/// Where a trajectory leaves the cylinder.
fn landing(trajectory: &Trajectory) -> Landing {
    let state = trajectory.outcome();
    let sound = trajectory.warnings.iter().all(|warning| !warning.forbids_success());
    Landing { at: state.poses[0].position, sound: sound && state.is_finite() }
}
