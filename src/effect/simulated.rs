//! An effect model that simulates with a physics engine.

use rayon::prelude::*;

use crate::rollout::reachable;
use crate::sim::Simulator;
use crate::{
    outcome::{Record, Trajectory},
    scene::{ModelSpec, Scene},
    task::Job,
};

use super::{EffectModel, Trust, measured::measured};

/// A simulator as an effect model: the most expensive model, and the ground truth of the others.
#[derive(Clone, Debug)]
pub struct Simulated {
    spec: ModelSpec,
    simulator: Simulator,
}

impl Simulated {
    /// Creates the effect model of `simulator`.
    pub fn new(simulator: Simulator) -> Self {
        Self { spec: simulator.spec(), simulator }
    }
}

impl EffectModel for Simulated {
    fn spec(&self) -> &ModelSpec {
        &self.spec
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return match self.simulator.takes(job) {
                true => Trust::Mine { error: None, warnings: Vec::new() },
                false => Trust::NotMine,
            };
        }
        let error = measured(&self.spec.first().kind, || reachable(scene, job).len());
        Trust::Mine { error, warnings: Vec::new() }
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_iter().map(|job| self.simulator.run(scene, job, record)).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::geometry::{Pose, Vector};
    use crate::{
        scene::{Object, Part, Tool},
        task::{Push, ToolMotion},
    };

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
        let model = Simulated::new(simulator);
        assert_eq!(model.spec().to_string(), "planar");
        let trajectories = model.rollout(&scene, &jobs, Record::Frames);
        for (job, trajectory) in jobs.iter().zip(&trajectories) {
            let alone = simulator.run(&scene, job, Record::Frames);
            assert_eq!(trajectory, &alone);
        }
        assert!(model.rollout(&scene, &[], Record::Frames).is_empty());
    }
}
