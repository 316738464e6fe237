//! An effect model that simulates.

use rayon::prelude::*;

use crate::scene::{Engine, Record, Scene, ToolMotion, Trajectory, Warning};
use crate::sim::{DEFAULT_STEP, Simulator};

use super::{EffectModel, Job};

/// A simulator as an effect model: the dearest level of the ladder, and the truth of the others.
#[derive(Clone, Debug)]
pub struct Simulated {
    name: String,
    simulator: Simulator,
}

impl Simulated {
    /// The effects that `simulator` computes. The name says the step where it is not the
    /// default: `planar, 1/60 s`.
    pub fn new(simulator: Simulator) -> Self {
        let engine = match simulator.engine() {
            Engine::Planar => "planar",
            Engine::Spatial => "3d",
        };
        let name = match simulator.step() {
            step if step == DEFAULT_STEP => engine.to_owned(),
            step => format!("{engine}, 1/{:.0} s", 1.0 / step),
        };
        Self { name, simulator }
    }
}

impl EffectModel for Simulated {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, _scene: &Scene, _motion: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    fn error_p95(&self) -> f64 {
        0.0
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_iter().map(|job| self.simulator.run(scene, job, record)).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::geometry::{Pose, Vector};
    use crate::scene::{Object, Part, Push, Tool, ToolMotion};

    use super::*;

    #[test]
    fn trajectories_come_in_the_order_of_the_jobs_each_under_its_physics() {
        let puck = Object::cylinder("puck", 0.03, 0.05).mass(0.2).friction(0.3).at(0.05, 0.0, 0.0);
        let scene = Scene::new([puck]).on_table(0.3);
        let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
        let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece").friction(0.3));
        let jobs: Vec<Job> = (0..6)
            .map(|k| {
                let length = 0.04 + 0.02 * f64::from(k);
                let push = Push { start: Vector::zeros(), direction: 0.0, length, speed: 0.1 };
                let motion = ToolMotion::pushes(tool.clone(), 0.002, 0.0, &[push], true);
                let mut job = Job::stated(&scene, motion);
                if k % 2 == 1 {
                    Arc::make_mut(&mut job.physics).table_friction = 0.9;
                }
                job
            })
            .collect();
        let simulator = Simulator::planar();
        let model = Simulated::new(simulator.clone());
        assert_eq!((model.name(), model.error_p95()), ("planar", 0.0));
        let coarse = Simulated::new(Simulator::spatial_with_step(1.0 / 120.0));
        assert_eq!(coarse.name(), "3d, 1/120 s");
        let trajectories = model.rollout(&scene, &jobs, Record::Frames);
        for (job, trajectory) in jobs.iter().zip(&trajectories) {
            let alone = simulator.run(&scene, job, Record::Frames);
            assert_eq!(trajectory, &alone);
        }
        assert!(model.rollout(&scene, &[], Record::Frames).is_empty());
    }
}
