//! A smaller time step changes little.

use std::num::NonZeroU16;

use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{Engine, Job, Rate, Record, Scene};
use pushplan::sim::Simulator;

use crate::fixtures::{brick, can, push};

#[test]
fn a_quarter_of_the_step_moves_a_planar_outcome_by_less_than_half_a_millimetre() {
    for object in [can(), brick()] {
        for k in 0..6 {
            let mut object = object.clone();
            object.pose = Pose::new(0.0, 0.0, 0.5 * k as f64 + 0.2);
            let scene = Scene::new([object]);
            let motion = push(Vector::new(-0.07, -0.02 + 0.01 * k as f64), 0.0, 0.2, 0.1);
            let end = |rate: u16| {
                let rate = Rate(NonZeroU16::new(rate).unwrap());
                let simulator = Simulator::new(Engine::Planar, rate);
                let run =
                    simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
                run.outcome().poses[0]
            };
            let (coarse, fine) = (end(240), end(960));
            let error = (coarse.position - fine.position).norm();
            assert!(error < 0.5e-3, "{} {k}: {error}", scene.objects[0].name);
        }
    }
}
