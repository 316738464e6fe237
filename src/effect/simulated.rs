//! An effect model that simulates.

use rayon::prelude::*;

use crate::scene::{Engine, Record, Scene, ToolMotion, Trajectory, Warning};
use crate::sim::Simulator;

use super::{EffectModel, Job};

/// A simulator as an effect model: the dearest level of the ladder, and the truth of the others.
#[derive(Clone, Debug)]
pub struct Simulated {
    simulator: Simulator,
}

impl Simulated {
    /// The effects that `simulator` computes.
    pub fn new(simulator: Simulator) -> Self {
        Self { simulator }
    }
}

impl EffectModel for Simulated {
    fn name(&self) -> &str {
        match self.simulator.engine() {
            Engine::Planar => "planar",
            Engine::Spatial => "3d",
        }
    }

    fn warnings(&self, _scene: &Scene, _motion: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    fn error_p95(&self) -> f64 {
        0.0
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_iter()
            .map(|job| {
                let hypothesis = job.hypothesis.as_deref();
                self.simulator.run(scene, &job.start, hypothesis, &job.motion, record)
            })
            .collect()
    }
}
